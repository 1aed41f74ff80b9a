/// @file
/// Class (f): steps with status OK that end with more energy than the inputs,
/// the dampers and friction can account for. Two measures: the balance over
/// the step by the midpoint rule with the reported force, which is the mean of
/// the step (not for located, which reports the force at its end), and the
/// most that any force within the law could have done.
#include <math.h>
#include <stdio.h>

#include "classes.h"

enum { KINDS = 2 };
static const runs_t runs[KINDS] = {{2, 1, {0}, "", "k2  "},
                                   {2, 1, {0}, "", "r=0 "}};

typedef struct {
  count_t *balance, *bound, *doubled, *run;
  double worst, sum; ///< worst step, largest run: created over energy
} tally_t;

static tally_t tallies[KINDS][RUNS];

static double energy_of(const lib_machine_t *q, const lib_row_t *x) {
  const double p = x->v - q->d * x->w, stretch = x->r - q->r0;
  return q->m * p * p / 2 +
         q->m * (q->beta * q->beta + x->r * x->r) * x->w * x->w / 2 +
         q->k2 * stretch * stretch / 2;
}

// Work of dampers and friction by the means of both ends.
static double work(const lib_machine_t *q, const lib_row_t *a,
                   const lib_row_t *b) {
  const double r = (a->r + b->r) / 2, v = (a->v + b->v) / 2;
  const double w = (a->w + b->w) / 2, s = sin(q->gamma), c = cos(q->gamma);
  return q->dt * (-q->c2 * v * v - q->c1 * w * w + b->F * s * v +
                  (b->F * (r * c - q->d * s) + b->M) * w);
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

static lib_machine_t machine_of(draw_t *draw, int kind, draw_range_t range) {
  lib_machine_t q = draw_machine(draw, range);
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

static void begin(void) {
  for (int kind = 0; kind < KINDS; ++kind) {
    for (int k = 0; k < runs_count(&runs[kind]); ++k) {
      const runs_t *of = &runs[kind];
      tally_t *tally = &tallies[kind][k];
      const bool shows = k == 0;
      // The force that located reports is no mean of the step.
      if (runs_at(of, k).scheme != LIB_LOCATED) {
        tally->balance = count_run(of, k, shows, "balance off by 1e-3");
      }
      tally->bound = count_run(of, k, shows, "1e-3 more than friction could");
      tally->doubled = count_run(of, k, shows, "twice what it could be");
      tally->run = count_run(of, k, shows, "runs: 1e-2 in all");
    }
  }
}

static void steps(trial_t *trial, tally_t *tally, run_t run) {
  enum { STEPS = 200 };
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
    const double E = energy_of(machine, &before),
                 after = energy_of(machine, &row);
    const double rounding = noise(machine, &row, run.real->epsilon) +
                            noise(machine, &before, run.real->epsilon);
    const double left = after - E - work(machine, &before, &row);
    const double over = after - E - most(machine, &before, &row);
    const double size = E + most(machine, &before, &row) + 1e-12;
    const bool ok = status == 0;
    trial->t_end = (i + 1) * machine->dt;
    count_try(tally->balance, trial, ok && left > 1e-3 * size + rounding);
    count_try(tally->bound, trial, ok && over > 1e-3 * size + rounding);
    count_try(tally->doubled, trial, ok && over > size + rounding);
    if (ok && over > rounding) {
      tally->worst = fmax(tally->worst, over / size);
      sum += over / size;
    }
  }
  tally->sum = fmax(tally->sum, sum);
  trial->t_end = STEPS * machine->dt;
  count_try(tally->run, trial, sum > 1e-2);
}

static void judge(trial_t *trial) {
  for (int kind = 0; kind < KINDS; ++kind) {
    trial->draw =
        draw_begin(trial->options->seed, (uint64_t)(2 * trial->index + kind));
    trial->machine = machine_of(&trial->draw, kind, trial->options->range);
    for (int k = 0; k < runs_count(&runs[kind]); ++k) {
      steps(trial, &tallies[kind][k], runs_at(&runs[kind], k));
    }
  }
}

static int finish(const options_t *options) {
  (void)options;
  for (int kind = 0; kind < KINDS; ++kind) {
    for (int k = 0; k < runs_count(&runs[kind]); ++k) {
      const tally_t *t = &tallies[kind][k];
      snprintf(t->run->note, sizeof t->run->note,
               "worst step %.3g, worst run %.3g of its energy", t->worst,
               t->sum);
    }
  }
  return 0;
}

const class_t class_energy = {
    "energy", "(f) energy from nothing", 2000, 0, begin, judge, finish};
