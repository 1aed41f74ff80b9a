/// @file
/// Of what a step has by itself, what tells its error? Steps of tf_step in
/// double that say TF_OK, from random states of random machines at random dt,
/// beside the located step at 1e-12: how often each estimate lies within a
/// factor of 10 of the error, by decades of it, and how often it is silent or
/// alarms by a factor of 100.
#include <math.h>
#include <stdio.h>

#include "classes.h"
#include "params.h"

enum { TURN, CHANGE, ENERGY, HALVES, ESTIMATES, DECADES = 8, STEPS = 20 };
static const char *const names[ESTIMATES] = {"force, start to mean",
                                             "force, start to end",
                                             "energy it creates", "two halves"};
static const double lowest = 1e-8; // of the decades

static count_t *within[ESTIMATES][DECADES], *silent[ESTIMATES],
    *alarms[ESTIMATES];

static void begin(const class_t *class) {
  (void)class;
  char what[96];
  for (int e = 0; e < ESTIMATES; ++e) {
    for (int i = 0; i < DECADES; ++i) {
      snprintf(what, sizeof what, "%-21s within 10, error from %.0e", names[e],
               lowest * pow(10, i));
      within[e][i] = count_add(false, what);
    }
    snprintf(what, sizeof what, "%-21s < 1e-4, error > 1e-2", names[e]);
    silent[e] = count_add(e == HALVES, what);
    snprintf(what, sizeof what, "%-21s > 1e-3, error < 1e-5", names[e]);
    alarms[e] = count_add(e == HALVES, what);
  }
}

typedef struct {
  double p, z, r;
} change_t;

// |p| + R |z| + |r| / dt.
static double size_of(const tf_machine_t *k, double R, change_t by) {
  return fabs(by.p) + R * fabs(by.z) + fabs(by.r) / k->dt;
}

static change_t between(const tf_machine_t *k, const tf_state_t *a,
                        const tf_state_t *b) {
  return (change_t){b->v - a->v - k->d * (b->w - a->w), b->w - a->w,
                    b->r - a->r};
}

// What one step has: estimates of its error, as a share of `size`.
static void estimate(const tf_machine_t *k, const tf_state_t *from,
                     const tf_state_t *to, const tf_input_t *u,
                     const tf_report_t *report, double size,
                     double error[ESTIMATES]) {
  const double R2 = k->beta2 + to->r * to->r, R = sqrt(R2);
  const tf_slip_t now =
      tf_slip(k, from->r, from->v, from->w, u->omega0 - u->alpha * k->dt);
  const tf_force_t first =
      tf_tyre_force(&k->tyre, now.h < 0 ? -1 : 1, now.h, now.g);
  const tf_force_t last = tf_tyre_force(&k->tyre, report->slip.h < 0 ? -1 : 1,
                                        report->slip.h, report->slip.g);
  for (int e = TURN; e <= CHANGE; ++e) {
    const tf_force_t then = e == TURN ? report->force : last;
    const double F = then.F - first.F, M = then.M - first.M;
    const change_t by = {k->dt * F * k->sin_gamma / k->m,
                         k->dt * (F * from->r * k->cos_gamma + M) / (k->m * R2),
                         0};
    error[e] = size_of(k, R, by) / size;
  }
  const double theta = k->theta, v = from->v + theta * (to->v - from->v);
  const double w = from->w + theta * (to->w - from->w);
  const double F = report->force.F, M = report->force.M, r = from->r;
  const double arm = r * k->cos_gamma - k->d * k->sin_gamma;
  const double work =
      k->dt * (u->force * v + u->torque * w - k->c1 * w * w - k->c2 * v * v +
               F * (v * k->sin_gamma + w * arm) + M * w);
  const double before = tf_energy(k, from, u->r0),
               after = tf_energy(k, to, u->r0);
  error[ENERGY] = sqrt(fabs(after - before - work) / (before + after));
}

static void judge_step(const trial_t *trial, const tf_machine_t *k,
                       const tf_input_t *u, tf_state_t *x) {
  const tf_state_t from = *x;
  tf_state_t exact = from;
  tf_report_t report, other;
  double halves;
  if (tf_step_estimated(k, x, u, TF_REAL_MAX, &report, &halves) != TF_OK ||
      tf_step_located(k, &exact, u, &other) != TF_OK) {
    return;
  }
  const double R = sqrt(k->beta2 + exact.r * exact.r);
  const change_t moved = between(k, &from, &exact);
  const double z = from.w - u->omega0, p = from.v - k->d * z;
  const double size = fabs(p) + R * fabs(z) + fabs(moved.p) + R * fabs(moved.z);
  const double error = size_of(k, R, between(k, x, &exact)) / size;
  double by[ESTIMATES];
  estimate(k, &from, x, u, &report, size, by);
  by[HALVES] = halves;
  const double above = floor(log10(error / lowest));
  const int decade = (int)above;
  for (int e = 0; e < ESTIMATES; ++e) {
    if (decade >= 0) {
      count_try(within[e][decade < DECADES ? decade : DECADES - 1], trial,
                by[e] > error / 10 && by[e] < error * 10);
    }
    if (error > 1e-2) {
      count_try(silent[e], trial, by[e] < 1e-4);
    } else if (error < 1e-5) {
      count_try(alarms[e], trial, by[e] > 1e-3);
    }
  }
}

// Inputs are held; dt is drawn over four decades, kappa to 100.
static void judge(trial_t *trial) {
  lib_machine_t *q = &trial->machine;
  *q = draw_machine(&trial->draw, draw_uniform(&trial->draw, 0, 2) < 1);
  q->dt = draw_log(&trial->draw, 1e-5, 0.1);
  if (draw_uniform(&trial->draw, 0, 4) < 1) {
    q->kappa = draw_log(&trial->draw, 1, 100);
  }
  tf_params_t params = params_of(q);
  params.law = TF_TYRE_JUMP;
  params.tolerance = 1e-12;
  tf_machine_t k;
  if (tf_prepare(&k, &params, NULL) != TF_OK) {
    return;
  }
  const tf_input_t u = tf_input_default(&k);
  tf_report_t report;
  tf_state_t x = {.r = q->r, .v = q->v, .w = q->omega, .mode = TF_NO_MODE};
  if (tf_begin(&k, &x, &u, &report) != TF_OK) {
    return;
  }
  for (int n = 0; n < STEPS; ++n) {
    judge_step(trial, &k, &u, &x);
  }
}

const class_t class_estimates = {.name = "estimates",
                                 .about = "what tells the error of a step",
                                 .machines = 20000,
                                 .begin = begin,
                                 .judge = judge};
