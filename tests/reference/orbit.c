/// The motion from event to event: what each switch leads to; see reference.h.
#include "flow.h"

typedef ref_real_t real_t;

// Slip over its scale below which the rest of a fall into h = g = 0 is one
// straight line, and at which a slip that leaves begins.
static const real_t falls = (real_t)1e-19L, leaves = (real_t)1e-18L;

// A force of rest that leaves its law leads to a slip whose acceleration grows
// from nothing, in a field that is the stiffer the less there is of it. How
// long such a slip is taken as grown with the square of time [s].
static const real_t shortly = (real_t)1e-5L;

const char *ref_stop_name(ref_stop_t stop) {
  static const char *const names[] = {"reached", "two-fold", "no future",
                                      "spirals out", "too long"};
  return names[stop];
}

static void announce(ref_orbit_t *orbit, ref_event_t event) {
  ++orbit->events;
  orbit->codim2_count += event == REF_CODIM2;
  if (orbit->watch) orbit->watch(orbit, event);
}

static void enter(ref_orbit_t *orbit, ref_mode_t mode) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, orbit->x);
  orbit->mode = mode;
  orbit->step = (real_t)1e-5L;
  orbit->piece = ref_piece_at(q, slip, mode == REF_SLIP_MINUS ? -1 : 1);
  if (ref_in_stick(orbit)) {
    orbit->piece.roll = mode == REF_STICK_PLUS ? 1 : -1;
    orbit->piece.side = ref_sign(ref_edge(q, orbit->x, orbit->piece.roll).A);
  } else if (mode == REF_PINNED) {
    ref_state_t later = orbit->x;
    later.t += shortly;
    orbit->piece.side = ref_sign(ref_bow_margin(q, later));
  }
}

static void leave(ref_orbit_t *orbit, int index, real_t delay) {
  const ref_machine_t *q = orbit->machine;
  ref_state_t *x = &orbit->x;
  orbit->chosen = index;
  if (index == REF_REST) {
    enter(orbit, REF_PINNED);
    return;
  }
  if (index == REF_NONE) {
    orbit->stop = orbit->consistent.spiral ? REF_SPIRALS_OUT : REF_NO_MODE;
    return;
  }
  const ref_way_t *f = &orbit->consistent.list[index];
  if (f->mode <= REF_SLIP_MINUS) {
    const real_t z = x->z;
    const real_t rho =
        delay > 0 ? f->rate * delay / 2 : leaves * ref_speed_scale(q, *x);
    const ref_slip_t slip = {rho * ref_sin(f->angle), rho * ref_cos(f->angle)};
    if (z == 0) {
      *x = ref_from_slip(q, *x, slip);
    } else { // on the axis: r z is what p and z are elsewhere
      x->r = 1;
      *x = ref_from_slip(q, *x, slip);
      x->r = x->z / z;
      x->z = z;
    }
    x->t += delay > 0 ? delay : rho / f->rate;
  } else if (delay > 0) { // with g = 0 it would end where it begins
    const real_t g = f->rate * delay / 2;
    *x = ref_from_slip(q, *x,
                       (ref_slip_t){0, f->mode == REF_STICK_PLUS ? g : -g});
    x->t += delay;
  }
  enter(orbit, f->mode);
}

// Whether a slip that ends a rest has its acceleration from the start, as under
// a law of rest that leaves out a part of the hull, and need not grow.
static bool starts_at_once(const ref_orbit_t *orbit, ref_state_t x, int index,
                           real_t delay) {
  ref_consistent_t sooner;
  x.t += delay / 2;
  ref_consistent_codim2(orbit->machine, x, &sooner);
  bool at_once = delay == 0;
  for (int i = 0; index >= 0 && i < sooner.count; ++i) {
    const ref_way_t *way = &orbit->consistent.list[index];
    at_once |= sooner.list[i].mode == way->mode &&
               sooner.list[i].rate > (real_t)0.75L * way->rate;
  }
  return at_once;
}

// At h = g = 0, where either the wheel stands against the turntable (z = 0) or
// passes the axis (r = 0).
static void reach_codim2(ref_orbit_t *orbit, real_t delay) {
  ref_state_t *x = &orbit->x;
  const ref_mode_t from = orbit->mode;
  x->p = 0;
  if (ref_abs(x->r) < (real_t)1e-12L * orbit->machine->beta &&
      ref_abs(x->z) > (real_t)1e-9L * ref_abs(ref_w(orbit->machine, *x) - x->z))
    x->r = 0;
  else
    x->z = 0;
  ref_state_t later = *x;
  later.t += delay;
  ref_consistent_codim2(orbit->machine, later, &orbit->consistent);
  const int index = ref_choose(&orbit->consistent, orbit->law, from);
  const bool stands = x->z == 0;
  orbit->arrived = from;
  orbit->at = *x;
  leave(orbit, index, starts_at_once(orbit, *x, index, delay) ? 0 : delay);
  if (from != REF_PINNED || orbit->mode != REF_PINNED)
    announce(orbit, stands ? REF_CODIM2 : REF_TURNS);
}

// The rest of the way to h = g = 0 along a straight line. False where the slip
// is not that small yet, or grows.
static bool fall(ref_orbit_t *orbit) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, orbit->x);
  const real_t rho = ref_hypot(slip.h, slip.g);
  if (!ref_by_angle(q) || rho > falls * ref_speed_scale(q, orbit->x))
    return false;
  if (rho > 0) {
    const ref_rate_t f = ref_rate(q, orbit->x, ref_force(orbit, orbit->x));
    const real_t speed = (slip.h * f.h + slip.g * f.g) / rho;
    if (speed > 0) return false;
    orbit->x.t -= rho / speed;
  }
  reach_codim2(orbit, 0);
  return true;
}

// A slip that has reached h = 0 crosses it, or sticks where the other side
// leads back. An escaping stick cannot be reached.
static void meet_surface(ref_orbit_t *orbit) {
  const ref_machine_t *q = orbit->machine;
  const bool up = orbit->mode == REF_SLIP_MINUS;
  orbit->x = ref_on_surface(q, orbit->x);
  const int s = ref_sign(ref_slip(q, orbit->x).g);
  bool crosses = true;
  if (ref_sticks(q)) {
    const ref_edge_t edge = ref_edge(q, orbit->x, s);
    ref_consistent_edge(q, orbit->x, &orbit->consistent);
    crosses = up ? edge.plus > 0 : edge.minus < 0;
  }
  if (crosses) {
    enter(orbit, up ? REF_SLIP_PLUS : REF_SLIP_MINUS);
    announce(orbit, REF_CROSSES);
  } else {
    enter(orbit, s > 0 ? REF_STICK_PLUS : REF_STICK_MINUS);
    announce(orbit, REF_ENTERS);
  }
}

// Stick ends at |lambda| = mu: to the side on which slip leads away.
static void leave_stick(ref_orbit_t *orbit, ref_at_t at) {
  const ref_machine_t *q = orbit->machine;
  const ref_edge_t edge = ref_edge(q, orbit->x, orbit->piece.roll);
  const bool plus = (edge.A > 0) == (at == REF_AT_PLUS);
  ref_consistent_edge(q, orbit->x, &orbit->consistent);
  enter(orbit, plus ? REF_SLIP_PLUS : REF_SLIP_MINUS);
  announce(orbit, REF_LEAVES);
}

// g = 0: in slip another piece of the law, in stick h = g = 0, where the law
// COULOMB has nothing to decide.
static void meet_g(ref_orbit_t *orbit) {
  if (ref_slips(orbit)) {
    orbit->piece.roll = -orbit->piece.roll;
  } else if (orbit->machine->law == REF_COULOMB) {
    enter(orbit,
          orbit->mode == REF_STICK_PLUS ? REF_STICK_MINUS : REF_STICK_PLUS);
    announce(orbit, REF_TURNS);
  } else {
    reach_codim2(orbit, 0);
  }
}

// The rest of the way into the two-fold, A = N = 0, along a straight line: A
// depends on r alone.
static void arrive(ref_orbit_t *orbit) {
  const ref_machine_t *q = orbit->machine;
  const real_t by = (real_t)1e-6L;
  const int roll = orbit->piece.roll;
  const ref_state_t f = ref_slope(orbit, orbit->x);
  ref_state_t below = orbit->x, above = orbit->x;
  below.r -= by;
  above.r += by;
  const real_t A_r =
      (ref_edge(q, above, roll).A - ref_edge(q, below, roll).A) / (2 * by);
  const real_t way = -ref_edge(q, orbit->x, roll).A / A_r / f.r;
  orbit->at = orbit->x;
  orbit->x.r += way * f.r;
  orbit->x.p += way * f.p;
  orbit->x.z += way * f.z;
  orbit->x.t += way * f.t;
  orbit->stop = REF_TWO_FOLD;
  announce(orbit, REF_ARRIVES);
}

// Partial slip borders on both other zones, which border on no other.
static void change_zone(ref_orbit_t *orbit) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, orbit->x);
  const bool more =
      q->delta * ref_abs(slip.g) < q->k * ref_abs(slip.h) * (q->a + q->sigma);
  orbit->piece.zone = orbit->piece.zone != 1 ? 1 : more ? 2 : 0;
}

static void react(ref_orbit_t *orbit, ref_at_t at) {
  if (ref_slips(orbit) && fall(orbit)) return;
  switch (at) {
    case REF_AT_G:
      meet_g(orbit);
      break;
    case REF_AT_H:
      meet_surface(orbit);
      break;
    case REF_AT_PLUS:
    case REF_AT_MINUS:
      leave_stick(orbit, at);
      break;
    case REF_AT_FOLD:
      arrive(orbit);
      break;
    case REF_AT_ZONE:
      change_zone(orbit);
      break;
    case REF_AT_HULL:
    case REF_AT_BOW:
      reach_codim2(orbit, shortly);
      break;
    case REF_AT_TIME:
    case REF_AT_NONE:
      break;
  }
}

// The mode of a state that no motion has led to: `mode` where it is
// consistent, else stick where that is, else what the rule takes.
static void settle(ref_orbit_t *orbit, ref_mode_t mode) {
  const ref_machine_t *q = orbit->machine;
  const ref_state_t x = orbit->x;
  const ref_slip_t slip = ref_slip(q, x);
  const real_t terms = ref_abs(x.p) + ref_abs(x.r * x.z);
  if (!ref_sticks(q) || ref_abs(slip.h) > 8 * REF_EPSILON * terms) {
    enter(orbit, slip.h < 0 ? REF_SLIP_MINUS : REF_SLIP_PLUS);
    return;
  }
  if (slip.g == 0) {
    reach_codim2(orbit, 0);
    return;
  }
  ref_consistent_edge(q, x, &orbit->consistent);
  int index = ref_choose(&orbit->consistent, orbit->law, REF_MODES);
  for (int i = 0; i < orbit->consistent.count; ++i) {
    const ref_mode_t one = orbit->consistent.list[i].mode;
    index = mode < REF_MODES        ? (one == mode ? i : index)
            : one >= REF_STICK_PLUS ? i
                                    : index;
  }
  enter(orbit, orbit->consistent.list[index].mode);
}

void ref_begin(ref_orbit_t *orbit, const ref_machine_t *machine, ref_state_t x,
               ref_mode_t mode) {
  orbit->machine = machine;
  orbit->x = x;
  orbit->stop = REF_REACHED;
  settle(orbit, mode);
}

// The next piece of the inputs. A jump of the turntable's speed is a new state:
// v and w stay. A bend may end stick or rest.
static void pass_break(ref_orbit_t *orbit) {
  const ref_machine_t *q = orbit->machine;
  const ref_mode_t before = orbit->mode;
  ref_state_t *x = &orbit->x;
  const real_t was = ref_input(q, x->t, x->piece).omega0;
  const real_t from = ref_knot(q, x->piece > 0 ? x->piece - 1 : 0)->omega0;
  const real_t at = ref_knot(q, x->piece)->t;
  while (x->piece < q->knots && ref_knot(q, x->piece)->t <= at) {
    ++x->piece; // one of no length has no slope
  }
  const real_t jump = ref_input(q, x->t, x->piece).omega0 - was;
  if (ref_abs(jump) > 64 * REF_EPSILON * (ref_abs(from) + ref_abs(was))) {
    x->p += q->d * jump;
    x->z -= jump;
    settle(orbit, orbit->mode);
    orbit->step = (real_t)1e-5L;
  } else if (before == REF_PINNED) {
    reach_codim2(orbit, 0);
  } else if (ref_in_stick(orbit)) {
    settle(orbit, orbit->mode);
  }
  if (before != orbit->mode && before != REF_PINNED &&
      orbit->mode != REF_PINNED)
    announce(orbit, ref_slips(orbit)
                        ? before <= REF_SLIP_MINUS ? REF_CROSSES : REF_LEAVES
                        : REF_ENTERS);
}

ref_stop_t ref_run(ref_orbit_t *orbit, real_t end) {
  const ref_machine_t *q = orbit->machine;
  if (orbit->limit == 0) orbit->limit = 20000000;
  while (orbit->stop == REF_REACHED && orbit->x.t < end) {
    const bool breaks =
        orbit->x.piece < q->knots && ref_knot(q, orbit->x.piece)->t <= end;
    const real_t until = breaks ? ref_knot(q, orbit->x.piece)->t : end;
    if (orbit->x.t < until) {
      if (orbit->mode == REF_PINNED && q->knots == 0) {
        orbit->x.t = end;
        break;
      }
      const ref_at_t at = ref_advance(orbit, until);
      if (orbit->evaluations > orbit->limit || orbit->events > 100000) {
        orbit->stop = REF_TOO_LONG;
        break;
      }
      react(orbit, at);
    }
    if (breaks && orbit->stop == REF_REACHED && orbit->x.t >= until)
      pass_break(orbit);
  }
  return orbit->stop;
}
