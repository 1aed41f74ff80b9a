/// @file
/// Class (a), first half: a mode and the signs of h and g that go with it,
/// after single steps from h = 0 and after every step of short runs.
#include <math.h>
#include <stdio.h>

#include "classes.h"

enum { STARTS = 100 };
static const runs_t runs = {2, 2, {1e-4, 1e-3}, "", NULL};

static count_t *counts[2][RUNS], *label[LIB_SCHEMES];

static void begin(void) {
  count_runs(counts[0], &runs, true, "first steps from h = 0");
  count_runs(counts[1], &runs, true, "steps of runs");
  for (int k = 0; k < LIB_SCHEMES; ++k) {
    char what[96];
    snprintf(what, sizeof what, "%s, COULOMB: stick on the wrong side of g",
             lib_scheme_names[k]);
    label[k] = count_add(true, what);
    label[k]->scheme = lib_scheme_names[k];
  }
}

// Whether h and g have the signs of the mode, but for rounding. The law COULOMB
// does not ask for the sign of g; it is counted apart.
static bool agrees(const lib_machine_t *q, const lib_row_t *x, double epsilon) {
  const double z = fabs(x->w) + fabs(q->omega0);
  const double tiny =
      64 * epsilon * (fabs(x->v) + (fabs(q->d) + fabs(x->r)) * z);
  switch (x->mode) {
    case REF_SLIP_PLUS:
      return x->h > -tiny;
    case REF_SLIP_MINUS:
      return x->h < tiny;
    case REF_STICK_PLUS:
      return fabs(x->h) <= tiny && x->g > -tiny;
    case REF_STICK_MINUS:
      return fabs(x->h) <= tiny && x->g < tiny;
    default:
      return fabs(x->h) <= tiny && fabs(x->g) <= tiny;
  }
}

// Another start of the same machine, near r = 0 in one case of three.
static void start(draw_t *draw, lib_machine_t *q) {
  const double near = draw_log(draw, 1e-3, 1);
  const bool axis = draw_uniform(draw, 0, 3) < 1;
  q->r = (float)(draw_uniform(draw, -0.5, 0.5) *
                 (axis ? draw_log(draw, 1e-4, 1) : 1));
  q->omega = (float)(q->omega0 * (1 + near * draw_uniform(draw, -1, 1)));
  q->v = (float)(near * draw_uniform(draw, -1, 1));
}

static void steps(trial_t *trial, int k, int count) {
  const run_t run = runs_at(&runs, k);
  lib_t lib;
  lib_row_t row;
  lib_machine_t *machine = &trial->machine;
  machine->dt = run.dt;
  if (run.real->open(&lib, machine, run.scheme, &row) != 0) {
    return;
  }
  count_t *into = machine->coulomb ? label[run.scheme] : counts[count > 1][k];
  for (int i = 0; i < count && run.real->step(&lib, &row) >= 0; ++i) {
    trial->t_end = (i + 1) * machine->dt;
    count_try(into, trial,
              row.status == 0 && !agrees(machine, &row, run.real->epsilon));
  }
}

static void judge(trial_t *trial) {
  for (int n = 0; n < STARTS; ++n) {
    start(&trial->draw, &trial->machine);
    trial->machine.on_surface = fabs(sin(trial->machine.gamma)) > 1e-3;
    for (int k = 0; k < runs_count(&runs); ++k) {
      steps(trial, k, 1);
    }
  }
  for (int k = 0; k < runs_count(&runs); ++k) {
    steps(trial, k, 200);
  }
}

const class_t class_signs = {
    "signs", "(a) mode and signs of h and g", 2000, 0, begin, judge, NULL};
