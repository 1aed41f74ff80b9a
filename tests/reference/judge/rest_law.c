/// @file
/// Points h = g = 0 at which a law of rest leaves no future: any, and those
/// that motions reach.
#include <stdio.h>

#include "classes.h"

static count_t *none[2][REF_RESTS];

static void begin(const class_t *class) {
  static const char *const points[2] = {"random points", "points reached"};
  static const char *const laws[REF_RESTS] = {"bow tie", "square", "hexagon"};
  (void)class;
  for (int i = 0; i < 2 * REF_RESTS; ++i) {
    const int kind = i / REF_RESTS, law = i % REF_RESTS;
    char what[96];
    snprintf(what, sizeof what, "%s: none under the %s", points[kind],
             laws[law]);
    none[kind][law] = count_add(law != REF_BOW_TIE, what);
  }
}

// A wheel at rest at r: whether it may stay or something leaves it.
static void judge_point(const trial_t *trial, const ref_consistent_t *f,
                        real_t r, int kind) {
  trial_t at = *trial;
  at.machine.r = (double)r;
  at.machine.v = 0;
  at.machine.omega = at.machine.omega0;
  at.machine.on_surface = false;
  for (int law = 0; law < REF_RESTS; ++law) {
    count_try(none[kind][law], &at,
              f->count == 0 && !f->spiral && !f->rests[law]);
  }
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

const class_t class_rest_law = {.name = "rest-law",
                                .about = "laws of rest that leave no future",
                                .machines = 2000,
                                .t_end = 3,
                                .begin = begin,
                                .judge = judge};
