/// @file
/// Class (g): extreme machines whose end state is wrong with all steps OK,
/// among them those with a slip shorter than the step.
#include <math.h>
#include <stdio.h>

#include "classes.h"

enum { DTS = 2, RUNS = LIB_SCHEMES * DTS };
static const double dts[DTS] = {1e-4, 1e-5};

typedef struct {
  real_t last, shortest; ///< time of the last event, shortest slip [s]
  bool open;             ///< h = g = 0 was passed, or the start has a choice
} slips_t;

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  slips_t *slips = orbit->context;
  if (event == REF_ENTERS || event == REF_CROSSES) {
    slips->shortest = fminl(slips->shortest, orbit->x.t - slips->last);
  }
  slips->open = slips->open || event == REF_CODIM2;
  slips->last = orbit->x.t;
}

static count_t judged = {.what = "judged: the reference is sure of the end"};
static count_t brief = {.what = "of them a slip shorter than 1e-5 s"};
static count_t wrong[RUNS], warned[RUNS], impulsive[RUNS];

static void name_counts(void) {
  static char names[RUNS][3][80];
  for (int k = 0; k < RUNS; ++k) {
    static const char *const kinds[3] = {"10 % off, all OK",
                                         "10 % off, some not OK or refused",
                                         "short slip: 10 % off, all OK"};
    count_t *const counts[3] = {&wrong[k], &warned[k], &impulsive[k]};
    for (int i = 0; i < 3; ++i) {
      snprintf(names[k][i], sizeof names[k][i], "%-11s %.0e: %s",
               lib_scheme_names[k / DTS], dts[k % DTS], kinds[i]);
      counts[i]->what = names[k][i];
    }
  }
}

// End of the motion at two tolerances; false where they part, where the point
// h = g = 0 is passed or the motion is too fast for the smaller step.
static bool sure(const lib_machine_t *machine, ref_machine_t *q, real_t end,
                 ref_orbit_t *orbit, slips_t *slips) {
  *slips = (slips_t){.shortest = end};
  *orbit = class_orbit(machine, q, &lib_f64);
  slips->open = orbit->consistent.count > 1;
  orbit->watch = on_event;
  orbit->context = slips;
  orbit->limit = 300000;
  ref_orbit_t coarse = *orbit;
  coarse.watch = NULL;
  coarse.tolerance = 1e-8L;
  ref_run(orbit, end);
  ref_run(&coarse, end);
  const lib_row_t row = {.r = (double)coarse.x.r,
                         .v = (double)ref_v(q, coarse.x),
                         .w = (double)ref_w(q, coarse.x)};
  return orbit->stop == REF_REACHED && coarse.stop == REF_REACHED &&
         !slips->open && q->k2 / q->m < 1e6L &&
         class_difference(q, orbit->x, &row) < 1e-3;
}

int class_impulses(const options_t *options) {
  const double end = options->t_end > 0 ? options->t_end : 0.1;
  options_t hushed = *options;
  hushed.show = 0;
  name_counts();
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    lib_machine_t machine = draw_machine(&draw, DRAW_EXTREME);
    ref_machine_t q;
    ref_orbit_t orbit;
    slips_t slips;
    const bool is_sure = sure(&machine, &q, (real_t)end, &orbit, &slips);
    count_try(&judged, is_sure, &hushed, i, &machine, end, "moreau");
    if (!is_sure) {
      continue;
    }
    const bool is_brief = slips.shortest < 1e-5L;
    count_try(&brief, is_brief, &hushed, i, &machine, end, "moreau");
    for (int k = 0; k < RUNS; ++k) {
      lib_row_t row;
      machine.dt = dts[k % DTS];
      const lib_scheme_t scheme = (lib_scheme_t)(k / DTS);
      const long others = class_run(&lib_f64, &machine, scheme, end, &row);
      const bool is_off = class_difference(&q, orbit.x, &row) > 0.1;
      count_try(&wrong[k], is_off && others == 0, options, i, &machine, end,
                lib_scheme_names[scheme]);
      count_try(&warned[k], is_off && others != 0, &hushed, i, &machine, end,
                lib_scheme_names[scheme]);
      if (is_brief) {
        count_try(&impulsive[k], is_off && others == 0, &hushed, i, &machine,
                  end, lib_scheme_names[scheme]);
      }
    }
  }
  count_print(&judged);
  count_print(&brief);
  for (int k = 0; k < RUNS; ++k) {
    count_print(&wrong[k]);
    count_print(&warned[k]);
    count_print(&impulsive[k]);
  }
  return 0;
}
