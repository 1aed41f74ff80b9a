/// @file
/// One machine by the reference under each law of rest: its events, the
/// consistent modes at each h = g = 0, and its end.
#include <stdio.h>

#include "classes.h"

static const char *const modes[] = {"slip+",  "slip-",  "stick+",
                                    "stick-", "pinned", "none"};

static void print_modes(const ref_consistent_t *f) {
  for (int i = 0; i < f->count; ++i) {
    const ref_way_t *a = &f->list[i];
    printf("      %-7s rate %-11.5Lg angle %9.4Lf %s%s\n", modes[a->mode],
           a->rate, a->angle * 180 / acosl(-1),
           a->attracting ? "attracting" : "repelling",
           a->family ? ", a family" : "");
  }
  printf("      rest F %.6Lg M %.6Lg: bow tie %d, square %d, hexagon %d%s\n",
         f->resting.F, f->resting.M, f->rests[0], f->rests[1], f->rests[2],
         f->spiral ? "; spirals out" : "");
}

static void on_event(const ref_orbit_t *orbit, ref_event_t event) {
  static const char *const names[] = {"crosses", "sticks", "leaves",
                                      "turns",   "codim2", "two-fold"};
  const ref_machine_t *q = orbit->machine;
  if (orbit->events > 40) {
    return;
  }
  printf("  %-8s t %.9Lf r %.9Lf v %.9Lf w %.9Lf g %.3Lg, goes on %s\n",
         names[event], orbit->x.t, orbit->x.r, ref_v(q, orbit->x),
         ref_w(q, orbit->x), ref_slip(q, orbit->x).g, modes[orbit->mode]);
  if (event == REF_CODIM2) {
    print_modes(&orbit->consistent);
  }
}

const lib_machine_t replay_machine = {.m = 1,
                                      .d = 1,
                                      .beta = 0.05,
                                      .k2 = 2.2270992253886014,
                                      .c1 = 1e-3,
                                      .c2 = 1e-3,
                                      .r0 = 0.1,
                                      .omega0 = -1,
                                      .mu = 1,
                                      .kappa = 0.27241153714062028,
                                      .gamma = -2.3561944901923448,
                                      .r = 0.18,
                                      .omega = -1.037,
                                      .on_surface = true,
                                      .dt = 1e-4};

static int finish(const options_t *options) {
  const lib_machine_t machine = options->machine;
  const double end = options->t_end > 0 ? options->t_end : 3;
  ref_machine_t q = draw_reference(&machine, &lib_f64);
  for (int law = 0; law < REF_RESTS; ++law) {
    static const char *const names[] = {"bow tie", "square", "hexagon"};
    ref_orbit_t orbit = {
        .tolerance = 1e-12L, .law = (ref_rest_t)law, .watch = on_event};
    printf("%s\n", names[law]);
    ref_begin(&orbit, &q, draw_start(&machine, &q, &lib_f64), REF_MODES);
    printf("  starts %s\n", modes[orbit.mode]);
    ref_run(&orbit, (real_t)end);
    printf("  %s: t %.9Lf r %.9Lf v %.9Lf w %.9Lf %s\n",
           ref_stop_name(orbit.stop), orbit.x.t, orbit.x.r, ref_v(&q, orbit.x),
           ref_w(&q, orbit.x), modes[orbit.mode]);
  }
  return 0;
}

const class_t class_replay = {
    .name = "replay", .about = "one machine, event by event", .finish = finish};
