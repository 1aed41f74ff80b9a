/// @file
/// Class (b): points h = g = 0 at which a law of rest leaves no future, and
/// what tf_step does there.
#include <math.h>
#include <stdio.h>

#include "classes.h"

static const runs_t coarse = {1, 1, {1e-4}, "", NULL},
                    fine = {1, 1, {1e-5}, "", NULL};
static count_t *none[2][REF_RESTS], *rests[2][REF_RESTS];
static count_t *spirals, *quiet_ok, *drifts;

static void begin(void) {
  static const char *const points[2] = {"random points", "points reached"};
  static const char *const laws[REF_RESTS] = {"bow tie", "square", "hexagon"};
  char what[96];
  for (int i = 0; i < 2 * REF_RESTS; ++i) {
    const int kind = i / REF_RESTS, law = i % REF_RESTS;
    snprintf(what, sizeof what, "%s: none under the %s", points[kind],
             laws[law]);
    none[kind][law] = count_add(law != REF_BOW_TIE, what);
    snprintf(what, sizeof what, "%s: rest under the %s", points[kind],
             laws[law]);
    rests[kind][law] = count_add(false, what);
  }
  spirals = count_add(false, "points that only a spiral leaves");
  quiet_ok = count_add(true, "no future, 0.1 s of moreau all OK");
  drifts = count_add(false, "and its drift hangs on dt");
}

// A wheel at rest at r: what leaves it, and tf_step from there.
static void judge_point(const trial_t *trial, const ref_consistent_t *f,
                        real_t r, int kind) {
  trial_t at = *trial;
  lib_row_t row[2];
  at.t_end = 0.1;
  at.machine.r = (double)r;
  at.machine.v = 0;
  at.machine.omega = at.machine.omega0;
  at.machine.on_surface = false;
  const bool moves = f->count > 0 || f->spiral;
  for (int law = 0; law < REF_RESTS; ++law) {
    count_try(none[kind][law], &at, !moves && !f->rests[law]);
    count_try(rests[kind][law], &at, f->rests[law]);
  }
  count_try(spirals, &at, f->count == 0 && f->spiral);
  if (moves || f->rests[REF_BOW_TIE]) {
    return;
  }
  const double dt = at.machine.dt;
  const bool ok = trial_run(&at, &coarse, 0, &row[0]) == 0;
  const bool fine_ok = trial_run(&at, &fine, 0, &row[1]) == 0;
  const double a = row[0].r - at.machine.r, b = row[1].r - at.machine.r;
  at.machine.dt = dt;
  count_try(quiet_ok, &at, ok && fine_ok);
  count_try(drifts, &at, fabs(a - b) > 1e-7 && fabs(a) > 2 * fabs(b));
}

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  if (event == REF_CODIM2) {
    judge_point(orbit->context, &orbit->consistent, orbit->at.r, 1);
  }
}

static void judge(trial_t *trial) {
  if (trial->machine.coulomb) {
    return;
  }
  ref_machine_t q;
  ref_orbit_t orbit = class_orbit(&trial->machine, &q, &lib_f64);
  ref_consistent_t consistent;
  const ref_state_t point = {.r = (real_t)draw_uniform(&trial->draw, -1, 1)};
  ref_consistent_codim2(&q, point, &consistent);
  judge_point(trial, &consistent, point.r, 0);
  orbit.watch = on_event;
  orbit.context = trial;
  orbit.limit = 2000000;
  ref_run(&orbit, (real_t)trial->t_end);
}

const class_t class_rest_law = {
    "rest-law", "(b) laws of rest that leave no future", 2000, 3, begin, judge,
    NULL};
