/// @file
/// Class (b): points h = g = 0 at which a law of rest leaves no future, and
/// what tf_step does there.
#include <math.h>
#include <stdio.h>

#include "classes.h"

static count_t none[2][REF_RESTS] = {
    {{.what = "random points: none under the bow tie"},
     {.what = "random points: none under the square"},
     {.what = "random points: none under the hexagon"}},
    {{.what = "points reached: none under the bow tie"},
     {.what = "points reached: none under the square"},
     {.what = "points reached: none under the hexagon"}}};
static count_t rests[2][REF_RESTS] = {
    {{.what = "random points: rest under the bow tie"},
     {.what = "random points: rest under the square"},
     {.what = "random points: rest under the hexagon"}},
    {{.what = "points reached: rest under the bow tie"},
     {.what = "points reached: rest under the square"},
     {.what = "points reached: rest under the hexagon"}}};
static count_t spirals = {.what = "points that only a spiral leaves"};
static count_t quiet_ok = {.what = "no future, 0.1 s of moreau all OK"};
static count_t drifts = {.what = "and its drift hangs on dt"};

typedef struct {
  const options_t *options;
  lib_machine_t machine;
  long index;
} place_t;

// Drift of the scheme in 0.1 s from a wheel at rest at r, and its complaints.
static double drift(const lib_machine_t *machine, double dt, long *others) {
  lib_machine_t q = *machine;
  lib_row_t row;
  q.dt = dt;
  *others = class_run(&lib_f64, &q, LIB_STEP, 0.1, &row);
  return row.r - machine->r;
}

static void judge(const place_t *place, const ref_consistent_t *f, real_t r,
                  int kind) {
  options_t hushed = *place->options;
  hushed.show = 0;
  lib_machine_t machine = place->machine;
  machine.r = (double)r;
  machine.v = 0;
  machine.omega = machine.omega0;
  machine.on_surface = false;
  const bool moves = f->count > 0 || f->spiral;
  for (int law = 0; law < REF_RESTS; ++law) {
    count_try(&none[kind][law], !moves && !f->rests[law],
              law == REF_BOW_TIE ? &hushed : place->options, place->index,
              &machine, 0.1, "moreau");
    count_try(&rests[kind][law], f->rests[law], &hushed, place->index, &machine,
              0.1, "moreau");
  }
  count_try(&spirals, f->count == 0 && f->spiral, &hushed, place->index,
            &machine, 0.1, "moreau");
  if (moves || f->rests[REF_BOW_TIE]) {
    return;
  }
  long coarse = 0, fine = 0;
  const double a = drift(&machine, 1e-4, &coarse);
  const double b = drift(&machine, 1e-5, &fine);
  count_try(&quiet_ok, coarse == 0 && fine == 0, place->options, place->index,
            &machine, 0.1, "moreau");
  count_try(&drifts, fabs(a - b) > 1e-7 && fabs(a) > 2 * fabs(b), &hushed,
            place->index, &machine, 0.1, "moreau");
}

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  if (event == REF_CODIM2) {
    judge(orbit->context, &orbit->consistent, orbit->at.r, 1);
  }
}

int class_rest_law(const options_t *options) {
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    place_t place = {options, draw_machine(&draw, options->range), i};
    if (place.machine.coulomb) {
      continue;
    }
    ref_machine_t q;
    ref_orbit_t orbit = class_orbit(&place.machine, &q, &lib_f64);
    ref_consistent_t consistent;
    const ref_state_t point = {.r = (real_t)draw_uniform(&draw, -1, 1)};
    ref_consistent_codim2(&q, point, &consistent);
    judge(&place, &consistent, point.r, 0);
    orbit.watch = on_event;
    orbit.context = &place;
    orbit.limit = 2000000;
    ref_run(&orbit, options->t_end > 0 ? (real_t)options->t_end : 3);
  }
  for (int kind = 0; kind < 2; ++kind) {
    for (int law = 0; law < REF_RESTS; ++law) {
      count_print(&none[kind][law]);
      count_print(&rests[kind][law]);
    }
  }
  count_print(&spirals);
  count_print(&quiet_ok);
  count_print(&drifts);
  return 0;
}
