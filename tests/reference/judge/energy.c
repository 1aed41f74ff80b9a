/// @file
/// Class (f): steps with status OK that end with more energy than the inputs,
/// the dampers and friction can account for. Two measures: the balance over
/// the step by the midpoint rule with the reported force, which is the mean of
/// the step (not for located, which reports the force at its end), and the
/// most that any force within the law could have done.
#include <math.h>
#include <stdio.h>

#include "classes.h"

enum { REALS = 2, RUNS = LIB_SCHEMES * REALS };

typedef struct {
  count_t balance, bound, doubled, run;
  double worst, sum; ///< worst step, largest run: created over energy
} tally_t;

static tally_t tallies[2][RUNS];

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

static void one(const options_t *options, const lib_machine_t *machine,
                long index, int kind, int k) {
  const lib_table_t *real = k % REALS ? &lib_f32 : &lib_f64;
  const lib_scheme_t scheme = (lib_scheme_t)(k / REALS);
  tally_t *tally = &tallies[kind][k];
  const char *name = lib_scheme_names[scheme];
  enum { STEPS = 200 };
  lib_t lib;
  lib_row_t before, row;
  double sum = 0, scale = 0;
  if (real->open(&lib, machine, scheme, &row) < 0) {
    return;
  }
  for (int i = 0; i < STEPS; ++i) {
    before = row;
    const int status = real->step(&lib, &row);
    if (status < 0) {
      break;
    }
    const double E = energy_of(machine, &before),
                 after = energy_of(machine, &row);
    const double rounding = noise(machine, &row, real->epsilon) +
                            noise(machine, &before, real->epsilon);
    const double left = after - E - work(machine, &before, &row);
    const double over = after - E - most(machine, &before, &row);
    const double size = E + most(machine, &before, &row) + 1e-12;
    scale = fmax(scale, size);
    const bool ok = status == 0;
    const double end = (i + 1) * machine->dt;
    count_try(&tally->balance, ok && left > 1e-3 * size + rounding, options,
              index, machine, end, name);
    count_try(&tally->bound, ok && over > 1e-3 * size + rounding, options,
              index, machine, end, name);
    count_try(&tally->doubled, ok && over > size + rounding, options, index,
              machine, end, name);
    if (ok && over > rounding) {
      tally->worst = fmax(tally->worst, over / size);
      sum += over / size;
    }
  }
  tally->sum = fmax(tally->sum, sum);
  count_try(&tally->run, sum > 1e-2, options, index, machine,
            STEPS * machine->dt, name);
}

static void name_counts(void) {
  static char names[2][RUNS][4][96];
  for (int j = 0; j < 2 * RUNS; ++j) {
    tally_t *t = &tallies[j / RUNS][j % RUNS];
    count_t *const counts[4] = {&t->balance, &t->bound, &t->doubled, &t->run};
    static const char *const kinds[4] = {
        "balance off by 1e-3", "1e-3 more than friction could",
        "twice what it could be", "runs: 1e-2 in all"};
    for (int i = 0; i < 4; ++i) {
      char *name = names[j / RUNS][j % RUNS][i];
      snprintf(name, 96, "%s %-11s %-6s %s", j < RUNS ? "k2 " : "r=0",
               lib_scheme_names[j % RUNS / REALS], j % 2 ? "float" : "double",
               kinds[i]);
      counts[i]->what = name;
    }
  }
}

int class_energy(const options_t *options) {
  name_counts();
  options_t shown = *options;
  for (long i = options->first; i < options->first + options->machines; ++i) {
    for (int kind = 0; kind < 2; ++kind) {
      draw_t draw = draw_begin(options->seed, (uint64_t)(2 * i + kind));
      const lib_machine_t machine = machine_of(&draw, kind, options->range);
      for (int k = 0; k < RUNS; ++k) {
        shown.show = k == 0 ? options->show : 0;
        one(&shown, &machine, i, kind, k);
      }
    }
  }
  for (int j = 0; j < 2 * RUNS; ++j) {
    const tally_t *t = &tallies[j / RUNS][j % RUNS];
    if (j % RUNS / REALS != LIB_LOCATED) {
      count_print(&t->balance);
    }
    count_print(&t->bound);
    count_print(&t->doubled);
    count_print(&t->run);
    printf("%-50s worst step %.3g, worst run %.3g of its energy\n", "",
           t->worst, t->sum);
  }
  return 0;
}
