/// @file
/// Class (d), second half: motions whose reference never stands at h = g = 0,
/// so that their future is unique: ends that are far off, and near misses,
/// which are far off at a long step only.
#include <math.h>
#include <stdio.h>

#include "classes.h"

enum { DTS = 3, RUNS = LIB_SCHEMES * DTS };
static const double dts[DTS] = {1e-4, 3e-5, 1e-5};

static count_t alone = {.what = "judged: one future, reference sure"};
static count_t off[RUNS];
static count_t shrinks = {.what = "moreau off at 1e-4, right at 1e-5"};
static count_t stays = {.what = "moreau off at 1e-5"};

// The end of the reference; false where it is not unique or not sure.
static bool sure(const lib_machine_t *machine, ref_machine_t *q, real_t end,
                 ref_state_t *x) {
  ref_orbit_t fine = class_orbit(machine, q, &lib_f64);
  if (fine.consistent.count > 1) {
    return false;
  }
  fine.limit = 2000000;
  ref_orbit_t coarse = fine;
  coarse.tolerance = 1e-8L;
  ref_run(&fine, end);
  if (fine.stop != REF_REACHED || fine.codim2_count > 0) {
    return false;
  }
  ref_run(&coarse, end);
  const lib_row_t row = {.r = (double)coarse.x.r,
                         .v = (double)ref_v(q, coarse.x),
                         .w = (double)ref_w(q, coarse.x)};
  *x = fine.x;
  return class_difference(q, fine.x, &row) < 1e-4;
}

int class_path(const options_t *options) {
  const double end = options->t_end > 0 ? options->t_end : 0.9;
  static char names[RUNS][64];
  for (int k = 0; k < RUNS; ++k) {
    snprintf(names[k], sizeof names[k], "%-11s dt %.0e: 5 %% off, all OK",
             lib_scheme_names[k / DTS], dts[k % DTS]);
    off[k].what = names[k];
  }
  options_t hushed = *options;
  hushed.show = 0;
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    lib_machine_t machine = draw_machine(&draw, options->range);
    ref_machine_t q;
    ref_state_t x;
    const bool judged = sure(&machine, &q, (real_t)end, &x);
    count_try(&alone, judged, &hushed, i, &machine, end, "moreau");
    bool is_off[RUNS];
    for (int k = 0; k < RUNS && judged; ++k) {
      lib_row_t row;
      machine.dt = dts[k % DTS];
      const lib_scheme_t scheme = (lib_scheme_t)(k / DTS);
      const long others = class_run(&lib_f64, &machine, scheme, end, &row);
      is_off[k] = class_difference(&q, x, &row) > 0.05;
      count_try(&off[k], is_off[k] && others == 0, options, i, &machine, end,
                lib_scheme_names[scheme]);
    }
    if (judged) {
      count_try(&shrinks, is_off[0] && !is_off[2], &hushed, i, &machine, end,
                "moreau");
      count_try(&stays, is_off[2], &hushed, i, &machine, end, "moreau");
    }
  }
  count_print(&alone);
  for (int k = 0; k < RUNS; ++k) {
    count_print(&off[k]);
  }
  count_print(&shrinks);
  count_print(&stays);
  return 0;
}
