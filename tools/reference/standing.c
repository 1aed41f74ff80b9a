/// @file
/// Class (h): a scheme whose state does not change any more although the
/// reference, started from it, moves; and class (e): a stick that tends to
/// h = g = 0 for ever, restarted by rounding.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "classes.h"

enum { REALS = 2, DTS = 2, RUNS = LIB_SCHEMES * REALS * DTS };
static const double dts[DTS] = {1e-4, 1e-5};
static const double rest_dts[DTS] = {1e-3, 1e-4};

static count_t stands[RUNS], leaves[RUNS];
static count_t tends = {.what = "stick tends to h = g = 0 for ever"};

static const lib_table_t *real_of(int k) {
  return k / DTS % REALS ? &lib_f32 : &lib_f64;
}

static void name_counts(count_t counts[RUNS], const char *kind,
                        const double steps[DTS]) {
  static char names[2][RUNS][64];
  static int used;
  for (int k = 0; k < RUNS; ++k) {
    snprintf(names[used][k], sizeof names[used][k], "%-11s %-6s %.0e: %s",
             lib_scheme_names[k / DTS / REALS], real_of(k)->name,
             steps[k % DTS], kind);
    counts[k].what = names[used][k];
  }
  ++used;
}

// Steps until r has not changed for 500 of them; false where it does not come
// to that, or the scheme says that something is wrong.
static bool stops(const lib_table_t *real, const lib_machine_t *machine,
                  lib_scheme_t scheme, double end, lib_row_t *row) {
  lib_t lib;
  long still = 0;
  if (real->open(&lib, machine, scheme, row) < 0) {
    return false;
  }
  const long steps = lround(end / machine->dt);
  for (long i = 0; i < steps && still < 500; ++i) {
    const lib_row_t before = *row;
    const int status = real->step(&lib, row);
    if (status != 0) {
      return false;
    }
    still = before.r == row->r ? still + 1 : 0;
  }
  return still == 500;
}

// Whether the reference moves r within 500 steps by more than 50 roundings,
// and no law of rest would hold it.
static bool moves_on(const lib_machine_t *machine, const lib_table_t *real,
                     const lib_row_t *row) {
  const ref_machine_t q = draw_reference(machine, real);
  ref_state_t x = ref_state(&q, (real_t)row->r, (real_t)row->v, (real_t)row->w);
  const real_t coarse = 64 * (real_t)real->epsilon;
  const ref_slip_t slip = ref_slip(&q, x);
  const real_t size = fabsl(q.omega0) * (fabsl(x.r) + q.d) + fabsl(x.p);
  if (fabsl(slip.h) < coarse * size) {
    x = ref_on_surface(&q, x);
  }
  if (hypotl(slip.h, slip.g) < coarse * size) {
    x.p = 0;
    x.z = 0;
  }
  ref_orbit_t orbit = {.tolerance = 1e-9L, .limit = 200000};
  ref_begin(&orbit, &q, x, (ref_mode_t)row->mode);
  if (orbit.consistent.rests[REF_HEXAGON]) {
    return false;
  }
  ref_run(&orbit, 500 * (real_t)machine->dt);
  return fabsl(orbit.x.r - row->r) > 50 * (real_t)real->epsilon * fabsl(x.r);
}

int class_standing(const options_t *options) {
  const double end = options->t_end > 0 ? options->t_end : 1;
  name_counts(stands, "stands still where it moves", dts);
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    lib_machine_t machine = draw_machine(&draw, options->range);
    if (draw_uniform(&draw, 0, 2) < 1) { // from rest, as after a pinned wheel
      machine.omega = machine.omega0;
      machine.v = 0;
      machine.on_surface = false;
    }
    for (int k = 0; k < RUNS; ++k) {
      const lib_table_t *real = real_of(k);
      const lib_scheme_t scheme = (lib_scheme_t)(k / DTS / REALS);
      lib_row_t row;
      machine.dt = dts[k % DTS];
      const bool hit = stops(real, &machine, scheme, end, &row) &&
                       moves_on(&machine, real, &row);
      count_try(&stands[k], hit, options, i, &machine, end,
                lib_scheme_names[scheme]);
    }
  }
  for (int k = 0; k < RUNS; ++k) {
    count_print(&stands[k]);
  }
  return 0;
}

// A stick near its end: slow, on h = 0, and to all appearance for ever.
static bool settles(const lib_machine_t *machine, ref_machine_t *q,
                    ref_state_t *near) {
  ref_orbit_t orbit = class_orbit(machine, q, &lib_f64);
  orbit.limit = 300000;
  bool close = false;
  for (int i = 1; i <= 300 && orbit.stop == REF_REACHED; ++i) {
    ref_run(&orbit, (real_t)i / 10);
    const bool sticks =
        orbit.mode == REF_STICK_PLUS || orbit.mode == REF_STICK_MINUS;
    const real_t g = fabsl(ref_slip(q, orbit.x).g);
    if (!sticks || (close && g > 1e-4L)) {
      close = false;
    } else if (!close && g < 1e-5L) {
      close = true;
      *near = orbit.x;
    } else if (close && g < 1e-12L) {
      return true;
    }
  }
  return false;
}

// Whether the reference, started as the schemes are, rests for all the time.
static bool stays(const lib_machine_t *machine, double end) {
  ref_machine_t q;
  ref_orbit_t orbit = class_orbit(machine, &q, &lib_f64);
  orbit.limit = 300000;
  ref_run(&orbit, (real_t)end);
  return orbit.stop == REF_REACHED && orbit.codim2_count == 0 &&
         fabsl(orbit.x.r - machine->r) < 1e-4L * (fabsl(orbit.x.r) + 1);
}

int class_rounding(const options_t *options) {
  const double end = options->t_end > 0 ? options->t_end : 20;
  options_t hushed = *options;
  hushed.show = 0;
  name_counts(leaves, "leaves the rest", rest_dts);
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    lib_machine_t machine = draw_machine(&draw, options->range);
    ref_machine_t q;
    ref_state_t near = {0, 0, 0};
    const bool rests = settles(&machine, &q, &near);
    if (rests) {
      machine.r = (double)near.r;
      machine.v = (double)ref_v(&q, near);
      machine.omega = (double)ref_w(&q, near);
      machine.on_surface = fabsl(q.sine) > 1e-3L;
    }
    const bool counts = rests && stays(&machine, end);
    count_try(&tends, counts, &hushed, i, &machine, end, "moreau");
    if (!counts) {
      continue;
    }
    for (int k = 0; k < RUNS; ++k) {
      lib_row_t row;
      machine.dt = rest_dts[k % DTS];
      const lib_scheme_t scheme = (lib_scheme_t)(k / DTS / REALS);
      const long others = class_run(real_of(k), &machine, scheme, end, &row);
      const bool left = fabs(row.r - machine.r) > 1e-3 * (fabs(machine.r) + 1);
      count_try(&leaves[k], others >= 0 && left, options, i, &machine, end,
                lib_scheme_names[scheme]);
    }
  }
  count_print(&tends);
  for (int k = 0; k < RUNS; ++k) {
    count_print(&leaves[k]);
  }
  return 0;
}
