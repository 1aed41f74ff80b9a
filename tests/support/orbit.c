/* orbit.c - the reference orbit of orbit.h. */
#include "orbit.h"

static orbit_point_t point_of(const ref_orbit_t *orbit, ref_state_t x) {
  const ref_machine_t *q = orbit->machine;
  return (orbit_point_t){
      x.t, {x.r, ref_v(q, x), ref_w(q, x)}, orbit->consistent};
}

static void note(const ref_orbit_t *orbit, ref_event_t event) {
  orbit_events_t *ev = orbit->context;
  if (event == REF_CODIM2 && orbit->arrived == REF_SLIP_PLUS) {
    ev->fall = point_of(orbit, orbit->at);
    ev->fall_angle = orbit->angle;
  } else if (event == REF_CODIM2) {
    ev->leave = point_of(orbit, orbit->at);
    ev->leave_angle = orbit->consistent.list[orbit->chosen].angle - 2 * REF_PI;
  } else if (event == REF_ENTERS) {
    ev->land = point_of(orbit, orbit->x);
  } else if (event == REF_ARRIVES) {
    ev->near = point_of(orbit, orbit->at);
    ev->twofold = point_of(orbit, orbit->x);
  }
}

ref_machine_t orbit_machine(const paper_t *p) {
  ref_machine_t q = {PARAMETERS_OF(ref_real_t, p)};
  ref_prepare(&q);
  return q;
}

static void chaos(long double end, orbit_events_t *ev, long double x[3]) {
  paper_t p;
  paper_default(&p);
  const ref_machine_t q = orbit_machine(&p);
  const ref_state_t start = ref_with_h(
      &q, ref_state(&q, ORBIT_R_START, 0, ORBIT_W_START), ORBIT_H_START);
  ref_orbit_t orbit = {.tolerance = 1e-17L,
                       .law = REF_HEXAGON,
                       .watch = ev ? note : 0,
                       .context = ev};
  ref_begin(&orbit, &q, start, REF_MODES);
  ref_run(&orbit, end);
  x[0] = orbit.x.r;
  x[1] = ref_v(&q, orbit.x);
  x[2] = ref_w(&q, orbit.x);
}

void orbit_chaos(orbit_events_t *ev) {
  long double x[3];
  *ev = (orbit_events_t){.leave_angle = 0.0L}; /* and all else */
  chaos(3.0L, ev, x);
}

void orbit_chaos_state(long double t, long double x[3]) { chaos(t, 0, x); }
