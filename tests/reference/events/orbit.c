/// @file
/// The motion from event to event; see orbit.h.
///
/// An event is a sign change of a watched function: in slip h, and g, where
/// the force has a kink; in stick g and h' at lambda = mu and -mu, whose zeros
/// are |lambda| = mu. A step that holds one is shortened to end on it.
#include "orbit.h"

#include <float.h>
#include <math.h>

enum { WATCHED = 3 };

const char *ref_stop_name(ref_stop_t stop) {
  static const char *const names[] = {"reached", "two-fold", "no future",
                                      "spirals out", "too long"};
  return names[stop];
}

static bool slips(const ref_orbit_t *orbit) {
  return orbit->mode <= REF_SLIP_MINUS;
}

static int side_of(const ref_orbit_t *orbit) {
  return orbit->mode == REF_SLIP_PLUS ? 1 : -1;
}

// The watched functions, each positive where the mode goes on.
static void watched(const ref_orbit_t *orbit, ref_state_t x,
                    real_t out[WATCHED]) {
  const ref_slip_t slip = ref_slip(orbit->machine, x);
  out[0] = orbit->sign_g * slip.g;
  if (slips(orbit)) {
    out[1] = side_of(orbit) * slip.h;
    out[2] = 1;
    return;
  }
  const ref_edge_t edge = ref_edge(orbit->machine, x, orbit->sign_g);
  const int sign = edge.A > 0 ? 1 : -1;
  out[1] = -sign * edge.plus;
  out[2] = sign * edge.minus;
}

// Length of the step that ends where function `which` crosses 0, by the
// Illinois form of false position; `low` has it positive.
static real_t locate(ref_orbit_t *orbit, int which, real_t low, real_t high,
                     ref_state_t *at) {
  real_t f[WATCHED], f_low, f_high;
  ref_trial(orbit, low, at);
  watched(orbit, *at, f);
  f_low = f[which];
  ref_trial(orbit, high, at);
  watched(orbit, *at, f);
  f_high = f[which];
  for (int i = 0; i < 60 && high - low > 1e-17L * high; ++i) {
    real_t mid = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(mid > low && mid < high) || i > 30) {
      mid = (low + high) / 2;
    }
    ref_trial(orbit, mid, at);
    watched(orbit, *at, f);
    if (f[which] > 0) {
      low = mid;
      f_low = f[which];
      f_high /= 2;
    } else {
      high = mid;
      f_high = f[which];
      f_low /= 2;
      if (f[which] == 0) {
        break;
      }
    }
  }
  ref_trial(orbit, high, at);
  return high;
}

// Whether a function that is positive at both ends dips below 0 between, by
// the cubic through its values and slopes.
static bool dips(real_t f0, real_t d0, real_t f1, real_t d1, real_t H) {
  for (int i = 1; i < 16; ++i) {
    const real_t u = i / 16.0L, w = 1 - u;
    const real_t f = w * w * (f0 * (1 + 2 * u) + H * d0 * u) +
                     u * u * (f1 * (1 + 2 * w) - H * d1 * w);
    if (f < 0) {
      return true;
    }
  }
  return false;
}

static bool hides_an_event(ref_orbit_t *orbit, real_t H, ref_state_t end) {
  real_t f0[WATCHED], f1[WATCHED], mid[WATCHED];
  watched(orbit, orbit->x, f0);
  watched(orbit, end, f1);
  if (!slips(orbit)) {
    ref_state_t half;
    ref_trial(orbit, H / 2, &half);
    watched(orbit, half, mid);
    return (f1[0] > 0 && mid[0] < 0) || (f1[1] > 0 && mid[1] < 0) ||
           (f1[2] > 0 && mid[2] < 0);
  }
  const ref_machine_t *q = orbit->machine;
  const ref_rate_t a = ref_rate(q, orbit->x, ref_force(orbit, orbit->x));
  const ref_rate_t b = ref_rate(q, end, ref_force(orbit, end));
  const int side = side_of(orbit), sign_g = orbit->sign_g;
  return (f1[1] > 0 && dips(f0[1], side * a.h, f1[1], side * b.h, H)) ||
         (f1[0] > 0 && dips(f0[0], sign_g * a.g, f1[0], sign_g * b.g, H));
}

// Longest step that is safe to try: in slip a part of the time in which h and
// g change by themselves.
static real_t cap(const ref_orbit_t *orbit, real_t left) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, orbit->x);
  const ref_rate_t rate = ref_rate(q, orbit->x, ref_force(orbit, orbit->x));
  const real_t rho = hypotl(slip.h, slip.g), X = hypotl(rate.h, rate.g);
  real_t longest = fminl(left, 0.05L);
  if (slips(orbit) && rho > 0 && X > 0) {
    longest = fminl(longest, rho / X / 2);
  }
  return longest;
}

// Takes one step, up to the first event in it. Returns the function that
// crossed 0, or -1.
static int advance(ref_orbit_t *orbit, real_t left) {
  real_t H = fminl(orbit->step, cap(orbit, left)), e = 0;
  ref_state_t end;
  for (int tries = 0;; ++tries) {
    e = ref_trial(orbit, H, &end);
    if (e > 1) {
      H *= fmaxl(0.1L, 0.9L * powl(e, -1.0L / 11));
    } else if (tries < 40 && hides_an_event(orbit, H, end)) {
      H /= 2;
    } else {
      break;
    }
    if (orbit->evaluations > orbit->limit) {
      return -1;
    }
  }
  orbit->step = H * fminl(4, 0.9L * powl(fmaxl(e, 1e-12L), -1.0L / 11));
  real_t f0[WATCHED], f1[WATCHED], taken = H;
  int event = -1;
  watched(orbit, orbit->x, f0);
  for (int i = 0; i < WATCHED; ++i) {
    watched(orbit, end, f1);
    if (f1[i] >= 0) {
      continue;
    }
    real_t low = 0;
    if (f0[i] <= 0) { // it starts on the zero and has to come off it first
      ref_state_t near;
      real_t f[WATCHED];
      low = taken / 2;
      for (int k = 0; k < 60; ++k, low /= 2) {
        ref_trial(orbit, low, &near);
        watched(orbit, near, f);
        if (f[i] > 0) {
          break;
        }
      }
    }
    taken = locate(orbit, i, low, taken, &end);
    event = i;
  }
  orbit->x = slips(orbit) ? end : ref_on_surface(orbit->machine, end);
  orbit->t += taken;
  return event;
}

static void announce(ref_orbit_t *orbit, ref_event_t event) {
  ++orbit->events;
  orbit->codim2_count += event == REF_CODIM2;
  if (orbit->watch) {
    orbit->watch(orbit, event);
  }
}

static void enter(ref_orbit_t *orbit, ref_mode_t mode) {
  orbit->mode = mode;
  const real_t g = ref_slip(orbit->machine, orbit->x).g;
  orbit->sign_g = mode == REF_STICK_PLUS    ? 1
                  : mode == REF_STICK_MINUS ? -1
                  : g >= 0                  ? 1
                                            : -1;
  orbit->step = 1e-5L;
}

void ref_leave(ref_orbit_t *orbit, int index) {
  const ref_machine_t *q = orbit->machine;
  orbit->chosen = index;
  if (index == REF_REST) {
    enter(orbit, REF_PINNED);
    return;
  }
  if (index == REF_NONE) {
    orbit->stop = orbit->consistent.spiral ? REF_SPIRALS_OUT : REF_NO_MODE;
    return;
  }
  const ref_consistent_mode_t *f = &orbit->consistent.list[index];
  if (f->mode <= REF_SLIP_MINUS) {
    const real_t rho = 1e-12L * ref_speed_scale(q, orbit->x.r);
    const ref_slip_t slip = {rho * sinl(f->angle), rho * cosl(f->angle)};
    if (orbit->x.z == 0) {
      orbit->x = ref_from_slip(q, orbit->x.r, slip);
    } else {
      const real_t rz = -slip.h * q->cosine + slip.g * q->sine;
      orbit->x.p = -slip.h * q->sine - slip.g * q->cosine;
      orbit->x.r = rz / orbit->x.z;
    }
    orbit->t += rho / f->rate;
  }
  enter(orbit, f->mode);
}

// At h = g = 0, where either the wheel stands against the turntable (z = 0) or
// passes the axis (r = 0).
static void reach_codim2(ref_orbit_t *orbit) {
  ref_state_t *x = &orbit->x;
  x->p = 0;
  if (fabsl(x->r) < 1e-12L * orbit->machine->beta &&
      fabsl(x->z) > 1e-9L * fabsl(orbit->machine->omega0)) {
    x->r = 0;
  } else {
    x->z = 0;
  }
  ref_consistent_codim2(orbit->machine, *x, &orbit->consistent);
  const int index = orbit->forced != REF_BY_RULE
                        ? orbit->forced
                        : ref_choose(&orbit->consistent, orbit->law,
                                     orbit->mode >= REF_STICK_PLUS);
  const bool stands = x->z == 0;
  orbit->forced = REF_BY_RULE;
  orbit->arrived = orbit->mode;
  orbit->at = *x;
  ref_leave(orbit, index);
  announce(orbit, stands ? REF_CODIM2 : REF_TURNS);
}

// A slip that has reached h = 0 crosses it, or sticks where the other side
// leads back. An escaping stick cannot be reached.
static void surface_from_slip(ref_orbit_t *orbit) {
  orbit->x = ref_on_surface(orbit->machine, orbit->x);
  ref_consistent_edge(orbit->machine, orbit->x, &orbit->consistent);
  const int s = ref_slip(orbit->machine, orbit->x).g > 0 ? 1 : -1;
  const ref_edge_t edge = ref_edge(orbit->machine, orbit->x, s);
  const bool up = orbit->mode == REF_SLIP_MINUS;
  if (up ? edge.plus > 0 : edge.minus < 0) {
    enter(orbit, up ? REF_SLIP_PLUS : REF_SLIP_MINUS);
    announce(orbit, REF_CROSSES);
  } else {
    enter(orbit, s > 0 ? REF_STICK_PLUS : REF_STICK_MINUS);
    announce(orbit, REF_STICKS);
  }
}

// Stick ends at |lambda| = mu: to the side on which slip leads away.
static void surface_from_stick(ref_orbit_t *orbit, int event) {
  const ref_edge_t edge = ref_edge(orbit->machine, orbit->x, orbit->sign_g);
  const bool plus = edge.A > 0 ? event == 1 : event == 2;
  ref_consistent_edge(orbit->machine, orbit->x, &orbit->consistent);
  enter(orbit, plus ? REF_SLIP_PLUS : REF_SLIP_MINUS);
  announce(orbit, REF_LEAVES);
}

// Close enough to the two-fold, A = N = 0: goes there along the tangent.
static bool at_two_fold(ref_orbit_t *orbit) {
  const ref_machine_t *q = orbit->machine;
  const ref_edge_t edge = ref_edge(q, orbit->x, orbit->sign_g);
  const ref_affine_t f = ref_affine(q, orbit->x);
  const real_t size = fabsl(f.h_F) + q->kappa * fabsl(f.h_M);
  if (q->coulomb || fabsl(edge.A) > 1e-7L * size) {
    return false;
  }
  const ref_force_t force = ref_stick_force(q, orbit->sign_g, edge.N / edge.A);
  const ref_rate_t rate = ref_rate(q, orbit->x, force);
  const ref_state_t ahead = {orbit->x.r + rate.r * 1e-9L,
                             orbit->x.p + rate.p * 1e-9L,
                             orbit->x.z + rate.z * 1e-9L};
  const real_t gain = ref_edge(q, ahead, orbit->sign_g).A - edge.A;
  const real_t wait = -edge.A / gain * 1e-9L;
  if (wait < 0) {
    return false;
  }
  orbit->x =
      (ref_state_t){orbit->x.r + rate.r * wait, orbit->x.p + rate.p * wait,
                    orbit->x.z + rate.z * wait};
  orbit->t += wait;
  return true;
}

static void react(ref_orbit_t *orbit, int event) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, orbit->x);
  const real_t scale = ref_speed_scale(q, orbit->x.r);
  const bool in_codim2 = hypotl(slip.h, slip.g) < 1e-15L * scale;
  if (slips(orbit) ? in_codim2 : event == 0) {
    reach_codim2(orbit);
  } else if (slips(orbit) && event == 0) {
    orbit->sign_g = -orbit->sign_g;
  } else if (slips(orbit) && event == 1) {
    surface_from_slip(orbit);
  } else if (event > 0) {
    surface_from_stick(orbit, event);
  } else if (!slips(orbit) && at_two_fold(orbit)) {
    orbit->stop = REF_TWO_FOLD;
  }
}

void ref_begin(ref_orbit_t *orbit, const ref_machine_t *machine, ref_state_t x,
               ref_mode_t mode) {
  orbit->machine = machine;
  orbit->x = x;
  orbit->forced = REF_BY_RULE;
  orbit->stop = REF_REACHED;
  const ref_slip_t slip = ref_slip(machine, x);
  const real_t terms = fabsl(x.p) + fabsl(x.r * x.z);
  if (fabsl(slip.h) > 8 * LDBL_EPSILON * terms) {
    enter(orbit, slip.h > 0 ? REF_SLIP_PLUS : REF_SLIP_MINUS);
    return;
  }
  if (slip.g == 0) {
    reach_codim2(orbit);
    return;
  }
  ref_consistent_edge(machine, x, &orbit->consistent);
  int index = ref_choose(&orbit->consistent, orbit->law, 0);
  for (int i = 0; i < orbit->consistent.count; ++i) {
    const ref_mode_t one = orbit->consistent.list[i].mode;
    index = mode < REF_MODES        ? (one == mode ? i : index)
            : one >= REF_STICK_PLUS ? i
                                    : index;
  }
  enter(orbit, orbit->consistent.list[index].mode);
}

ref_stop_t ref_run(ref_orbit_t *orbit, real_t end) {
  if (orbit->limit == 0) {
    orbit->limit = 20000000;
  }
  while (orbit->stop == REF_REACHED && orbit->t < end) {
    if (orbit->mode == REF_PINNED) {
      orbit->t = end;
      break;
    }
    const int event = advance(orbit, end - orbit->t);
    if (orbit->evaluations > orbit->limit || orbit->events > 100000) {
      orbit->stop = REF_TOO_LONG;
      break;
    }
    react(orbit, event);
  }
  return orbit->stop;
}
