/// @file
/// Class (a), first half: a mode and the signs of h and g that go with it,
/// after single steps from h = 0 and after every step of short runs.
#include <math.h>
#include <stdio.h>

#include "classes.h"

enum { REALS = 2, DTS = 2, RUNS = LIB_SCHEMES * REALS * DTS, STARTS = 100 };
static const double dts[DTS] = {1e-4, 1e-3};

static count_t counts[2][RUNS];
static count_t label[LIB_SCHEMES] = {
    {.what = "moreau, COULOMB: stick on the wrong side of g"},
    {.what = "located, COULOMB: stick on the wrong side of g"},
    {.what = "compensated, COULOMB: stick on the wrong side of g"}};

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

static void one(const options_t *options, long index, const lib_machine_t *q,
                int k, int steps) {
  const lib_table_t *real = k / DTS % REALS ? &lib_f32 : &lib_f64;
  const lib_scheme_t scheme = (lib_scheme_t)(k / DTS / REALS);
  lib_t lib;
  lib_row_t row;
  lib_machine_t machine = *q;
  machine.dt = dts[k % DTS];
  if (real->open(&lib, &machine, scheme, &row) != 0) {
    return;
  }
  for (int i = 0; i < steps && real->step(&lib, &row) >= 0; ++i) {
    const bool hit = row.status == 0 && !agrees(&machine, &row, real->epsilon);
    count_t *count = q->coulomb ? &label[scheme] : &counts[steps > 1][k];
    count_try(count, hit, options, index, &machine, (i + 1) * machine.dt,
              lib_scheme_names[scheme]);
  }
}

static void name_counts(void) {
  static char names[2][RUNS][64];
  for (int k = 0; k < RUNS; ++k) {
    for (int i = 0; i < 2; ++i) {
      snprintf(names[i][k], sizeof names[i][k], "%-11s %-6s %.0e: %s",
               lib_scheme_names[k / DTS / REALS],
               k / DTS % REALS ? "float" : "double", dts[k % DTS],
               i ? "steps of runs" : "first steps from h = 0");
      counts[i][k].what = names[i][k];
    }
  }
}

int class_signs(const options_t *options) {
  name_counts();
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    lib_machine_t machine = draw_machine(&draw, options->range);
    for (int n = 0; n < STARTS; ++n) {
      start(&draw, &machine);
      machine.on_surface = fabs(sin(machine.gamma)) > 1e-3;
      for (int k = 0; k < RUNS; ++k) {
        one(options, i, &machine, k, 1);
      }
    }
    for (int k = 0; k < RUNS; ++k) {
      one(options, i, &machine, k, 200);
    }
  }
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < RUNS; ++k) {
      count_print(&counts[i][k]);
    }
  }
  for (int k = 0; k < LIB_SCHEMES; ++k) {
    count_print(&label[k]);
  }
  return 0;
}
