/// One step within a mode. An event is a sign change of a watched function; the
/// step is taken again with a smaller length to end on it, which costs no
/// accuracy.
///
/// A step runs in a time of its own, in which all that is singular is regular:
/// next to h = g = 0, where the direction of slip decides the force, dt is
/// proportional to the slip, so that the point is reached and left at a steady
/// pace; in stick it is proportional to A, which makes the two-fold an ordinary
/// point.
#include "flow.h"

#include "extrapolate.h"

typedef ref_real_t real_t;

enum { WATCHED = 5 };

typedef struct {
  int count;
  ref_at_t at[WATCHED];
  real_t value[WATCHED]; ///< positive where the mode goes on
} watched_t;

/// A / scale of A at which the straight line into a two-fold begins.
static const real_t near_fold = 1e-9L;

/// Of a time: less than that many are not stepped, for a substep would be lost.
static const real_t roundings = 256 * REF_EPSILON;

ref_force_t ref_force(const ref_orbit_t *orbit, ref_state_t x) {
  const ref_machine_t *q = orbit->machine;
  if (ref_slips(orbit)) return ref_slip_force(q, ref_slip(q, x), orbit->piece);
  if (orbit->mode == REF_PINNED) return orbit->consistent.resting;
  const ref_edge_t edge = ref_edge(q, x, orbit->piece.roll);
  return ref_stick_force(q, orbit->piece.roll, edge.N / edge.A);
}

// Whether time is stretched in stick. The law COULOMB has A > 0 throughout, and
// a wheel along the slot has A = N = 0 on the axis, which is no two-fold: there
// lambda = N / A goes on.
static bool stretches(const ref_machine_t *machine) {
  return machine->law == REF_JUMP && ref_abs(machine->sine) > (real_t)1e-9L;
}

// x' = |A| f(x, 0) + sign(A) N f_lambda, over the scale of A.
static ref_state_t stick_slope(const ref_orbit_t *orbit, ref_state_t x) {
  const ref_machine_t *q = orbit->machine;
  const ref_rate_t f = ref_rate(q, x, (ref_force_t){0, 0});
  const ref_force_t unit = ref_stick_force(q, orbit->piece.roll, 1);
  const real_t J = q->m * (q->beta * q->beta + x.r * x.r);
  const real_t in_p = q->sine / q->m, in_z = (x.r * q->cosine + unit.M) / J;
  const real_t A = q->sine * in_p + x.r * q->cosine * in_z;
  const real_t scale = stretches(q) ? orbit->piece.side / orbit->pace_A : 1 / A;
  return (ref_state_t){.r = scale * A * f.r,
                       .p = scale * (A * f.p + f.h * in_p),
                       .z = scale * (A * f.z + f.h * in_z),
                       .t = scale * A};
}

static real_t slip_pace(const ref_orbit_t *orbit, ref_slip_t slip) {
  if (!ref_by_angle(orbit->machine)) return 1;
  const real_t rho = ref_hypot(slip.h, slip.g);
  return rho / (orbit->pace_slip + rho);
}

ref_state_t ref_slope(ref_orbit_t *orbit, ref_state_t x) {
  const ref_machine_t *q = orbit->machine;
  ++orbit->evaluations;
  if (orbit->mode == REF_PINNED) return (ref_state_t){.t = 1};
  if (!ref_slips(orbit)) return stick_slope(orbit, x);
  const ref_slip_t slip = ref_slip(q, x);
  const ref_rate_t f = ref_rate(q, x, ref_slip_force(q, slip, orbit->piece));
  const real_t pace = slip_pace(orbit, slip);
  return (ref_state_t){
      .r = pace * f.r, .p = pace * f.p, .z = pace * f.z, .t = pace};
}

// Error against what h, g and r are at both ends: where the angle in the
// (h, g) plane decides the force, the smaller slip counts.
static real_t error(const ref_orbit_t *orbit, ref_state_t a, ref_state_t end) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t before = ref_slip(q, orbit->x), after = ref_slip(q, end);
  const real_t rho0 = ref_hypot(before.h, before.g);
  const real_t rho1 = ref_hypot(after.h, after.g);
  real_t rho = ref_larger(rho0, rho1);
  if (!ref_by_angle(q))
    rho += ref_speed_scale(q, end);
  else if (ref_slips(orbit) && rho0 > 0)
    rho = ref_smaller(rho0, rho1);
  const real_t reach = ref_abs(end.r) + q->beta;
  const real_t in_r = ref_abs(a.r - end.r) / reach;
  const real_t in_p = ref_abs(a.p - end.p) / rho;
  const real_t in_z = ref_abs(a.z - end.z) * ref_abs(end.r) / rho;
  const real_t alone = ref_abs(a.z - end.z) / (ref_abs(end.z) + rho / reach);
  const real_t e = ref_larger(ref_larger(in_r, in_p), ref_larger(in_z, alone));
  return e >= 0 ? e / orbit->tolerance : (real_t)HUGE_VALL;
}

static ref_state_t slope_of(void *orbit, ref_state_t x) {
  return ref_slope(orbit, x);
}

// One step of length H. Returns the error over the tolerance.
static real_t trial(ref_orbit_t *orbit, real_t H, ref_state_t *end) {
  if (orbit->mode == REF_PINNED) {
    ++orbit->evaluations;
    *end = orbit->x;
    end->t += H;
    return 0;
  }
  ref_state_t coarser;
  *end = ref_extrapolate(slope_of, orbit, orbit->x, H,
                         ref_columns(orbit->tolerance), &coarser);
  return error(orbit, coarser, *end);
}

real_t ref_bow_margin(const ref_machine_t *machine, ref_state_t x) {
  const ref_affine_t field = ref_affine(machine, x);
  const ref_force_t by = ref_rest_force(&field);
  return machine->kappa * ref_abs(by.F) - ref_abs(by.M);
}

static void watch(watched_t *out, ref_at_t at, real_t value) {
  out->at[out->count] = at;
  out->value[out->count++] = value;
}

static void watch_slip(const ref_orbit_t *orbit, ref_state_t x,
                       watched_t *out) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, x);
  const real_t H = orbit->piece.side * slip.h, G = orbit->piece.roll * slip.g;
  const int zone = orbit->piece.zone;
  watch(out, REF_AT_H, H);
  if (ref_has_kink(q)) watch(out, REF_AT_G, G);
  if (q->law == REF_STRING) {
    const real_t none = q->delta * G - q->k * (2 * q->a + q->sigma) * H;
    const real_t full = q->k * q->sigma * H - q->delta * G;
    watch(out, REF_AT_ZONE,
          zone == 0   ? none
          : zone == 2 ? full
                      : ref_smaller(-none, -full));
  }
}

static void watch_stick(const ref_orbit_t *orbit, ref_state_t x,
                        watched_t *out) {
  const ref_machine_t *q = orbit->machine;
  const int roll = orbit->piece.roll;
  const ref_edge_t edge = ref_edge(q, x, roll);
  const int side = stretches(q) ? orbit->piece.side : ref_sign(edge.A);
  watch(out, REF_AT_G, roll * ref_slip(q, x).g);
  if (stretches(q))
    watch(out, REF_AT_FOLD, side * edge.A - near_fold * orbit->pace_A);
  watch(out, REF_AT_PLUS, -side * edge.plus);
  watch(out, REF_AT_MINUS, side * edge.minus);
}

// The force of rest within its law, and within |M| = kappa |F|.
static void watch_rest(const ref_orbit_t *orbit, ref_state_t x,
                       watched_t *out) {
  const ref_affine_t field = ref_affine(orbit->machine, x);
  watch(out, REF_AT_HULL,
        ref_rest_margin(orbit->machine, ref_rest_force(&field), orbit->law));
  watch(out, REF_AT_BOW, orbit->piece.side * ref_bow_margin(orbit->machine, x));
}

static watched_t watched(const ref_orbit_t *orbit, ref_state_t x,
                         real_t until) {
  watched_t out = {.count = 0};
  watch(&out, REF_AT_TIME, until - x.t);
  if (ref_slips(orbit))
    watch_slip(orbit, x, &out);
  else if (orbit->mode != REF_PINNED)
    watch_stick(orbit, x, &out);
  else if (orbit->machine->knots > 0)
    watch_rest(orbit, x, &out);
  return out;
}

// A function that is watched, in a step to a time.
typedef struct {
  ref_orbit_t *orbit;
  real_t until;
  int which;
} watching_t;

static real_t value_after(void *context, real_t length, ref_state_t *end) {
  const watching_t *at = context;
  trial(at->orbit, length, end);
  return watched(at->orbit, *end, at->until).value[at->which];
}

// A step may start on a zero and has to come off it first: a length at which
// the function is positive, or next to nothing.
static real_t off_zero(watching_t *at, real_t length) {
  ref_state_t near;
  for (int k = 0; k < 60; ++k) {
    length /= 2;
    if (value_after(at, length, &near) > 0) break;
  }
  return length;
}

// Whether a function that is positive at both ends dips below 0 between, by
// the cubic through its values and slopes.
static bool dips(real_t f0, real_t d0, real_t f1, real_t d1, real_t H) {
  for (int i = 1; f1 > 0 && i < 16; ++i) {
    const real_t u = i / (real_t)16, w = 1 - u;
    const real_t f = w * w * (f0 * (1 + 2 * u) + H * d0 * u) +
                     u * u * (f1 * (1 + 2 * w) - H * d1 * w);
    if (f < 0) return true;
  }
  return false;
}

// Whether a function that is positive at both ends may be negative between: the
// parabola through it and its middle comes close to 0.
static bool touches(real_t f0, real_t middle, real_t f1) {
  if (f1 <= 0) return false;
  const real_t bend = f0 - 2 * middle + f1, slope = f1 - f0;
  if (middle <= 0) return true;
  if (ref_abs(slope) >= 2 * bend) return false;
  return middle - slope * slope / (8 * bend) < ref_larger(f0, f1) / 16;
}

// Change of (h, g) in stretched time.
static ref_slip_t slip_slope(const ref_orbit_t *orbit, ref_state_t x) {
  const ref_machine_t *q = orbit->machine;
  const ref_slip_t slip = ref_slip(q, x);
  const ref_rate_t f = ref_rate(q, x, ref_slip_force(q, slip, orbit->piece));
  const real_t pace = slip_pace(orbit, slip);
  return (ref_slip_t){pace * f.h, pace * f.g};
}

static bool hides_an_event(ref_orbit_t *orbit, real_t until, real_t H,
                           ref_state_t end) {
  const watched_t at_end = watched(orbit, end, until);
  if (!ref_slips(orbit)) {
    ref_state_t half;
    trial(orbit, H / 2, &half);
    const watched_t mid = watched(orbit, half, until);
    const watched_t start = watched(orbit, orbit->x, until);
    for (int i = 0; i < mid.count; ++i)
      if (touches(start.value[i], mid.value[i], at_end.value[i])) return true;
    return false;
  }
  const int side = orbit->piece.side, roll = orbit->piece.roll;
  const ref_slip_t from = ref_slip(orbit->machine, orbit->x);
  const ref_slip_t to = ref_slip(orbit->machine, end);
  const ref_slip_t a = slip_slope(orbit, orbit->x), b = slip_slope(orbit, end);
  return dips(side * from.h, side * a.h, side * to.h, side * b.h, H) ||
         dips(roll * from.g, roll * a.g, roll * to.g, roll * b.g, H);
}

// Sets the scales of the step's time and returns the longest step that is safe
// to try: a few hundredths of a second; at rest a millisecond, for there may be
// a stick for a short time; next to h = g = 0, in slip, a part of the time in
// which h and g change by themselves.
static real_t longest(ref_orbit_t *orbit, real_t until) {
  const ref_machine_t *q = orbit->machine;
  const real_t J = q->m * (q->beta * q->beta + orbit->x.r * orbit->x.r);
  const real_t arm = ref_abs(orbit->x.r * q->cosine);
  const real_t kappa = q->law == REF_JUMP ? q->kappa : 0;
  orbit->pace_A = q->sine * q->sine / q->m + arm * (arm + kappa) / J;
  if (ref_slips(orbit)) {
    const ref_rate_t f = ref_rate(q, orbit->x, ref_force(orbit, orbit->x));
    orbit->pace_slip = ref_hypot(f.h, f.g);
  }
  const real_t pace = ref_slope(orbit, orbit->x).t;
  const real_t left = (until - orbit->x.t) / pace;
  const real_t part = ref_slips(orbit) && ref_by_angle(q) ? (real_t)0.5L : 4;
  const real_t most = orbit->mode == REF_PINNED ? (real_t)1e-3L : (real_t)0.05L;
  return ref_smaller(ref_smaller(most / pace, part),
                     pace == 1 ? left : left * (real_t)1.1L);
}

ref_at_t ref_advance(ref_orbit_t *orbit, real_t until) {
  const int columns = ref_columns(orbit->tolerance);
  if (until - orbit->x.t <= roundings * until) {
    orbit->x.t = until;
    return REF_AT_TIME;
  }
  real_t H = ref_smaller(orbit->step, longest(orbit, until)), e = 0;
  ref_state_t end;
  for (int tries = 0;; ++tries) {
    e = trial(orbit, H, &end);
    if (e > 1)
      H *= ref_step_factor(e, columns);
    else if (tries < 40 && hides_an_event(orbit, until, H, end))
      H /= 2;
    else
      break;
    if (orbit->evaluations > orbit->limit) return REF_AT_NONE;
  }
  orbit->step = H * ref_step_factor(e, columns);
  const watched_t start = watched(orbit, orbit->x, until);
  ref_at_t event = REF_AT_NONE;
  for (int i = 0; i < start.count; ++i) {
    const real_t f = watched(orbit, end, until).value[i];
    if (start.at[i] == REF_AT_TIME && ref_abs(f) <= roundings * until)
      event = REF_AT_TIME;
    if (f >= 0 || event == start.at[i]) continue;
    watching_t at = {orbit, until, i};
    const real_t low = start.value[i] > 0 ? 0 : off_zero(&at, H);
    H = ref_locate(value_after, &at, low, H, &end);
    event = start.at[i];
  }
  orbit->x = ref_in_stick(orbit) ? ref_on_surface(orbit->machine, end) : end;
  if (event == REF_AT_TIME) orbit->x.t = until;
  return event;
}
