/// @file
/// Runs whose steps with status OK end with more energy than the most that any
/// force within the law, and the inputs, can account for: springs as stiff as
/// they may be, and passages of r = 0.
#include <math.h>

#include "classes.h"

enum { KINDS = 2, STEPS = 200 };
static const runs_t runs[KINDS] = {{2, 1, 1, {0}, "k2  "},
                                   {2, 1, 1, {0}, "r=0 "}};
static count_t *creates[KINDS][RUNS];

static double energy_of(const lib_machine_t *q, const lib_row_t *x) {
  const ref_machine_t k = {PARAMETERS_OF(long double, q)};
  return (double)ref_energy(&k, x->r, x->v - q->d * x->w, x->w, x->r - q->r0);
}

// The most that friction can put in: |F| <= 4 mu/3, |M| <= kappa mu, at the
// larger of the speeds of both ends.
static double most(const lib_machine_t *q, const lib_row_t *a,
                   const lib_row_t *b) {
  const double v = fmax(fabs(a->v), fabs(b->v));
  const double w = fmax(fabs(a->w), fabs(b->w));
  const double r = fmax(fabs(a->r), fabs(b->r));
  const double s = fabs(sin(q->gamma)), c = fabs(cos(q->gamma));
  return q->dt * q->mu *
         (4 * (s * v + (r * c + q->d * s) * w) / 3 + q->kappa * w);
}

// Noise of the energy in the numbers of the state, and of its differences.
static double noise(const lib_machine_t *q, const lib_row_t *x, double e) {
  const double p = fabs(x->v) + fabs(q->d * x->w);
  return 32 * e *
         (q->m * p * p +
          q->k2 * (fabs(x->r) + fabs(q->r0)) * (fabs(x->r) + fabs(q->r0)) +
          energy_of(q, x));
}

static lib_machine_t machine_of(draw_t *draw, int kind) {
  lib_machine_t q = draw_machine(draw, false);
  q.dt = (float)draw_log(draw, 1e-5, 0.1);
  if (kind == 0) {
    q.k2 = (float)draw_log(draw, 1, 1e10);
  } else { // past r = 0 within about one step
    q.beta = (float)draw_log(draw, 1e-3, 0.1);
    q.v = (float)(draw_uniform(draw, 0.2, 2) * q.beta / q.dt);
    q.r = (float)(-draw_uniform(draw, 0.5, 3) * q.v * q.dt);
    q.on_surface = false;
  }
  return q;
}

static void begin(const class_t *class) {
  (void)class;
  for (int kind = 0; kind < KINDS; ++kind) {
    count_runs(creates[kind], &runs[kind], "runs: 1e-2 in all");
  }
}

static void steps(trial_t *trial, count_t *count, run_t run) {
  const lib_machine_t *machine = &trial->machine;
  lib_t lib;
  lib_row_t before, row;
  double sum = 0;
  if (run.real->open(&lib, machine, run.scheme, &row) < 0) {
    return;
  }
  for (int i = 0; i < STEPS; ++i) {
    before = row;
    const int status = run.real->step(&lib, &row);
    if (status < 0) {
      break;
    }
    const double E = energy_of(machine, &before);
    const double put_in = most(machine, &before, &row);
    const double rounding = noise(machine, &row, run.real->epsilon) +
                            noise(machine, &before, run.real->epsilon);
    const double over = energy_of(machine, &row) - E - put_in;
    if (status == 0 && over > rounding) {
      sum += over / (E + put_in + 1e-12);
    }
  }
  trial->t_end = STEPS * machine->dt;
  count_try(count, trial, sum > 1e-2);
}

static void judge(trial_t *trial) {
  for (int kind = 0; kind < KINDS; ++kind) {
    trial->draw =
        draw_begin(trial->options->seed, (uint64_t)(2 * trial->index + kind));
    trial->machine = machine_of(&trial->draw, kind);
    for (int k = 0; k < runs_count(&runs[kind]); ++k) {
      steps(trial, creates[kind][k], runs_at(&runs[kind], k));
    }
  }
}

const class_t class_energy = {.name = "energy",
                              .about = "energy from nothing",
                              .machines = 2000,
                              .begin = begin,
                              .judge = judge};
