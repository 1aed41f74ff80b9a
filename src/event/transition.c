// Which contact comes next. On h = 0 (Filippov 1988) and at h = g = 0, where
// Filippov's convex combination does not suffice (Antali and Stepan 2018),
// several modes may be consistent: they are listed as in tf_step, the largest
// set of the step is kept for the report, and the declared rule takes one.
#include "../friction/mode_set.h"
#include "trajectory.h"

static void keep_largest_set(trajectory_t *path, unsigned set) {
  path->here = set;
  if (size_of(set) >= size_of(path->set)) path->set = set;
}

// Begins a segment in a mode; slip: its kind if the mode is a slip.
static void enter_mode(trajectory_t *path, unsigned mode, segment_kind_t slip,
                       segment_t segment) {
  segment.kind = mode == TF_PINNED ? SEGMENT_PINNED
                 : is_slip(mode)   ? slip
                                   : SEGMENT_STICK;
  path->mode = mode;
  path->segment = segment;
}

// One of the consistent modes, by the declared rule, or TF_NO_MODE.
static unsigned selected_mode(trajectory_t *path,
                              const tf_contact_modes_t *solutions) {
  const tf_machine_t *k = path->motion.machine;
  keep_largest_set(path, solutions->set);
  return tf_contact_choose(&k->contact, solutions, path->mode,
                           path->state->tick, path->state->seed);
}

// From h = 0, g != 0. A slip that crosses h = 0 is left where it is: where h
// vanishes with r, at gamma = 0, an impulse that sets h to 0 would stop the
// disc.
static bool leave_h_zero(trajectory_t *path) {
  const sign_t sign_g = sign_of(trajectory_slip(path).g);
  const rates_t rates = tf_trajectory_rates(path);
  consistent_modes_t consistent;
  surface_modes(path->motion.machine, &rates, sign_g, &consistent);
  const unsigned mode = selected_mode(path, &consistent.solutions);
  if (mode == TF_NO_MODE) return false;
  if (!is_slip(mode)) tf_project(path);
  enter_mode(path, mode, SEGMENT_SLIP,
             (segment_t){.sign_h = mode == TF_SLIP_MINUS ? MINUS : PLUS,
                         .sign_g = sign_g,
                         .h_zero_order = 1});
  return true;
}

// Whether a slip that comes to h = g = 0 within the error may have stuck just
// before, and that decides what follows: an attracting stick leads there, which
// would rest where the slip goes on, and no limit direction of the quadrant of
// the slip does, which costs most to see.
static bool may_have_stuck(const trajectory_t *path,
                           const codim2_field_t *field,
                           const consistent_modes_t *consistent,
                           unsigned mode) {
  const tf_contact_t *contact = &path->motion.machine->contact;
  tf_real_t T;
  bool sticks = false;
  for (int n = 0; n < 2; n++) {
    const stick_t stick = stick_at(field, n == 0 ? PLUS : MINUS);
    sticks |= stick.attracts && stick.rate < 0 && within(stick.x, 1);
  }
  return sticks &&
         mode != tf_leave_codim2(contact, field, TF_STICK_PLUS, true,
                                 path->state->tick, path->state->seed,
                                 consistent) &&
         !tf_codim2_attractor(contact, field, path->segment.sign_g,
                              path->segment.sign_h, &T);
}

static bool leave_codim2(trajectory_t *path, bool arrives) {
  const tf_machine_t *k = path->motion.machine;
  const rates_t before = tf_trajectory_rates(path);
  place_at_codim2(&before, &path->now.r, &path->now.z);
  path->now.p = 0;
  const rates_t rates = tf_trajectory_rates(path);
  const codim2_field_t field = tf_codim2_field_of(k, &rates);
  consistent_modes_t consistent;
  tf_codim2_modes(&k->contact, &field, &consistent);
  const unsigned mode =
      tf_leave_codim2(&k->contact, &field, path->mode, arrives,
                      path->state->tick, path->state->seed, &consistent);
  if (arrives && is_slip(path->mode))
    path->is_unsure |= may_have_stuck(path, &field, &consistent, mode);
  keep_largest_set(path, consistent.solutions.set);
  if (mode == TF_NO_MODE) return false;
  segment_t segment = {.h_zero_order = 1, .g_starts_at_zero = true};
  if (is_slip(mode)) {
    segment.sign_h = sign_in(mode);
    segment.sign_g = consistent.sign_g[mode];
    segment.T = consistent.T[mode];
  } else {
    segment.sign_g = sign_in(mode);
  }
  enter_mode(path, mode, SEGMENT_CODIM2_SLIP, segment);
  return true;
}

// A stick whose g is still within its rounding after it left h = g = 0,
// and may have the wrong sign: it goes on where its own force moves g to its
// side. Placed at h = g = 0 in every step, it would never get away.
static bool keep_leaving(trajectory_t *path) {
  const tf_machine_t *k = path->motion.machine;
  const sign_t sign_g = sign_in(path->mode);
  if (!is_stick(path->mode)) return false;
  const rates_t rates = tf_trajectory_rates(path);
  consistent_modes_t consistent;
  surface_modes(k, &rates, sign_g, &consistent);
  const tf_contact_modes_t *solutions = &consistent.solutions;
  const tf_real_t g_rate =
      g_rate_in_stick(k, &rates, sign_g, consistent.lambda[sign_g]);
  if (!has(solutions->set, path->mode) || !(with_sign(sign_g, g_rate) > 0) ||
      tf_contact_choose(&k->contact, solutions, path->mode, path->state->tick,
                        path->state->seed) != path->mode)
    return false;
  tf_project(path);
  keep_largest_set(path, solutions->set);
  enter_mode(
      path, path->mode, SEGMENT_SLIP,
      (segment_t){
          .sign_g = sign_g, .h_zero_order = 1, .g_starts_at_zero = true});
  return true;
}

// A stick to which both slips lead, |N| < A mu, is the only mode there: most
// are. At g = 0 this does not apply.
static bool keep_stick(trajectory_t *path, sign_t sign_g) {
  const tf_machine_t *k = path->motion.machine;
  const rates_t rates = tf_trajectory_rates(path);
  const slip_limits_t h_rate = slip_limits(k, &rates, sign_g);
  if (!(h_rate.plus < 0 && h_rate.minus > 0)) return false;
  path->segment =
      (segment_t){.kind = SEGMENT_STICK, .sign_g = sign_g, .h_zero_order = 1};
  keep_largest_set(path, TF_MODE_BIT(path->mode));
  return true;
}

static void begin_without_contact(trajectory_t *path, tf_real_t h) {
  path->mode = slip_of_sign(h, path->mode);
  path->segment = (segment_t){.kind = SEGMENT_FREE};
  keep_largest_set(path, TF_MODE_BIT(path->mode));
}

static void begin_in_slip(trajectory_t *path, tf_slip_t slip) {
  const sign_t sign_h = sign_of(slip.h);
  path->mode = slip_with(sign_h);
  path->segment = (segment_t){
      .kind = SEGMENT_SLIP, .sign_h = sign_h, .sign_g = sign_of(slip.g)};
  keep_largest_set(path, TF_MODE_BIT(path->mode));
}

// A wheel at rest follows the turntable. So it is as far from that as the speed
// at the end of the step before is from the speed at the start of this one, by
// the inputs of both. A share of the change that the tolerance admits is no
// jump.
static tf_real_t rounding_at_start(const trajectory_t *path) {
  const tf_machine_t *k = path->motion.machine;
  const tf_state_t *x = path->state;
  const tf_real_t rounding =
      step_rounding(path, (end_state_t){x->r, x->v, x->w}, path->omega);
  if (path->mode != TF_PINNED) return rounding;
  return rounding +
         k->tolerance * (magnitude(k->d) + magnitude(x->r)) * path->turn;
}

TF_API bool tf_first_segment(trajectory_t *path) {
  const tf_machine_t *k = path->motion.machine;
  const tf_slip_t slip = trajectory_slip(path);
  const tf_real_t rounding = rounding_at_start(path);
  if (k->contact.tyre.law == TF_TYRE_NONE) {
    begin_without_contact(path, slip.h);
    return true;
  }
  // Where the sign of h or g agrees with the mode it is taken as it is, even
  // below the rounding: otherwise a motion that leaves h = 0 or g = 0 slowly
  // would be put back there in every step.
  const sign_t sign = sign_in(path->mode);
  const bool slips = is_slip(path->mode) && with_sign(sign, slip.h) > 0;
  const bool rolls = is_stick(path->mode) && with_sign(sign, slip.g) > 0;
  if (slips || !within(slip.h, rounding)) {
    begin_in_slip(path, slip);
    return true;
  }
  if (k->contact.stick_kappa > 0 && !rolls && within(slip.g, rounding))
    return keep_leaving(path) || leave_codim2(path, false);
  return (rolls && keep_stick(path, sign)) || leave_h_zero(path);
}

// Without an event the same contact goes on, now away from where it began.
static bool continue_segment(segment_t *segment) {
  if (segment->kind == SEGMENT_CODIM2_SLIP) segment->kind = SEGMENT_SLIP;
  if (segment->kind == SEGMENT_TWO_FOLD_STICK) segment->kind = SEGMENT_STICK;
  segment->h_zero_order = 0;
  segment->g_starts_at_zero = segment->A_starts_at_zero = false;
  return true;
}

// Slip at g = 0: the angle and with it M change their signs.
static bool pass_g_zero(segment_t *segment) {
  segment->kind = SEGMENT_SLIP;
  segment->sign_g = opposite(segment->sign_g);
  segment->h_zero_order = 0;
  segment->g_starts_at_zero = true;
  return true;
}

// |lambda| = mu. An attracting stick is released to the side whose slip has
// this force, h > 0 for F = mu, where h begins with t^2; an escaping one to the
// other side, with t.
static bool release_stick(trajectory_t *path) {
  const segment_t *segment = &path->segment;
  const bool up = path->force.F > 0;
  const bool attracting = tf_trajectory_rates(path).A[segment->sign_g] > 0;
  const sign_t sign_h = up == attracting ? PLUS : MINUS;
  const unsigned mode = slip_with(sign_h);
  tf_project(path);
  keep_largest_set(path, TF_MODE_BIT(mode));
  enter_mode(path, mode, SEGMENT_SLIP,
             (segment_t){.sign_h = sign_h,
                         .sign_g = segment->sign_g,
                         .h_zero_order = attracting ? 2 : 1});
  return true;
}

// Both slips leave a two-fold as well (Teixeira 1990). The stick goes on into
// the escaping region, where the rule may end it.
static bool pass_two_fold(trajectory_t *path) {
  segment_t *segment = &path->segment;
  tf_project(path);
  keep_largest_set(path, SLIPS | TF_MODE_BIT(path->mode));
  segment->kind = SEGMENT_TWO_FOLD_STICK;
  segment->A_starts_at_zero = true;
  segment->g_starts_at_zero = false;
  return true;
}

TF_API bool tf_next_segment(trajectory_t *path, event_t event) {
  path->here = TF_MODE_BIT(path->mode);
  switch (event) {
    case EVENT_NONE:
      return continue_segment(&path->segment);
    case EVENT_G_ZERO:
      return pass_g_zero(&path->segment);
    case EVENT_H_ZERO:
      return leave_h_zero(path);
    case EVENT_CODIM2:
      return leave_codim2(path, true);
    case EVENT_RELEASE:
      return release_stick(path);
    case EVENT_TWO_FOLD:
      return pass_two_fold(path);
    case EVENT_UNPINNED:
    default:
      return leave_codim2(path, false);
  }
}

// Slip near h = g = 0. The field depends there on the angle of the slip alone,
// which may turn to a limit direction (Antali and Stepan 2018) much faster than
// the slip moves along it: that is stiff, and the series of the slip is short.
// But soon the slip is as good as the one solution that begins or ends in h = g
// = 0 along the limit direction, whose series from there is long.

// The solution along a limit direction.
typedef struct {
  taylor_t motion; // of its own: a try that fails leaves that of the slip
  segment_t segment;
  tf_real_t r;        // where it has h = g = 0 [m]
  tf_real_t time;     // since then; negative before [s]
  tf_real_t friction; // at most, as acceleration of p and q [m/s^2]
} limit_solution_t;

// The motion to h = g = 0 takes about speed/acceleration. The search is worth
// its cost where that is much longer than the series reaches, but not many
// steps, and where the slip goes straight to or from there, but for what a
// curved limit solution turns: where (p, q) and (p', q') are at most atan(1/2)
// apart.
TF_API bool tf_may_be_stiff(const trajectory_t *path, tf_real_t length) {
  const taylor_t *motion = &path->motion;
  const tf_real_t speed = magnitude(motion->p.c[0]) + magnitude(motion->q.c[0]);
  const tf_real_t acceleration =
      magnitude(motion->p.c[1]) + magnitude(motion->q.c[1]);
  const tf_real_t p0 = motion->p.c[0], q0 = motion->q.c[0];
  const tf_real_t p1 = motion->p.c[1], q1 = motion->q.c[1];
  const bool is_straight =
      2 * magnitude(p0 * q1 - q0 * p1) <= magnitude(p0 * p1 + q0 * q1);
  return path->segment.kind == SEGMENT_SLIP && is_straight &&
         motion->machine->contact.stick_kappa > 0 &&
         speed > 8 * acceleration * length &&
         speed < 16 * acceleration * motion->machine->dt;
}

// Expands the solution that has h = g = 0 at limit->r, limit->time ago; false
// where no limit direction attracts the slip.
static bool series_of_limit_solution(const trajectory_t *path,
                                     limit_solution_t *limit) {
  const tf_machine_t *k = path->motion.machine;
  const tf_input_t *input = path->motion.input;
  segment_t *segment = &limit->segment;
  const tf_real_t omega = path->omega - input->alpha * limit->time;
  const rates_t rates = rates_at(k, input, limit->r, 0, 0, omega);
  const codim2_field_t field = tf_codim2_field_of(k, &rates);
  if (!tf_codim2_attractor(&k->contact, &field, segment->sign_g,
                           segment->sign_h, &segment->T))
    return false;
  begin_taylor(&limit->motion, k, input, omega,
               (phase_point_t){limit->r, 0, 0});
  // This contact always has a series.
  (void)tf_taylor_coefficients(&limit->motion, segment, 0);
  limit->friction =
      k->contact.tyre.mu * (magnitude(rates.Fp) + magnitude(rates.Fq));
  return true;
}

// The time at which the solution is as far along its direction (p1, q1) as
// (p, q), by three steps of a simplified Newton iteration.
static tf_real_t time_along(const taylor_t *motion, tf_real_t p, tf_real_t q) {
  const tf_real_t p1 = motion->p.c[1], q1 = motion->q.c[1];
  const tf_real_t a2 = p1 * p1 + q1 * q1;
  const tf_real_t ahead = p * p1 + q * q1;
  tf_real_t t = ahead / a2;
  for (int i = 0; i < 3; i++)
    t -= (value_at(&motion->p, motion->order, t) * p1 +
          value_at(&motion->q, motion->order, t) * q1 - ahead) /
         a2;
  return t;
}

// Finds the limit solution next to the slip and returns whether it is near
// enough to take its place. Its r and time are exact to second order in the
// slip after the first expansion and to fourth after the second.
static bool is_on_limit_solution(const trajectory_t *path, tf_real_t allowed,
                                 limit_solution_t *limit) {
  const taylor_t *motion = &limit->motion;
  const phase_point_t now = path->now;
  const tf_real_t q = now.r * now.z;
  tf_real_t missed = 0, growth = 0;
  for (int i = 0; i < 2; i++) {
    if (!series_of_limit_solution(path, limit)) return false;
    const tf_real_t t = time_along(motion, now.p, q);
    // A distance from the solution changes as t^exponent: it has to decay.
    if (!(t * motion->exponent < 0)) return false;
    limit->time = t;
    limit->r += now.r - value_at(&motion->r, motion->order, t);
    missed = magnitude(value_at(&motion->p, motion->order, t) - now.p) +
             magnitude(value_at(&motion->q, motion->order, t) - q);
    const tf_real_t p1 = motion->p.c[1], q1 = motion->q.c[1];
    growth = 1 + limit->friction / (square_root(p1 * p1 + q1 * q1) *
                                    (1 + magnitude(motion->exponent)));
  }
  return missed * growth <= allowed &&
         tf_segment_length(motion, limit->time, (series_error_t){allowed, 0}) ==
             limit->time;
}

TF_API bool tf_follow_limit_direction(trajectory_t *path, tf_real_t allowed) {
  limit_solution_t limit = {.segment = path->segment, .r = path->now.r};
  limit.motion.speed = path->motion.speed;
  limit.segment.kind = SEGMENT_CODIM2_SLIP;
  limit.segment.h_zero_order = 1;
  limit.segment.g_starts_at_zero = true;
  if (!is_on_limit_solution(path, allowed, &limit)) return false;
  const taylor_t *motion = &limit.motion;
  tf_real_t end = limit.time + path->remaining, event_time;
  if (limit.time < 0 && end > 0) end = 0;
  if (limit.time > 0) {
    end = tf_segment_length(motion, end, (series_error_t){allowed, 0});
    if (!(end > limit.time) ||
        tf_next_event(motion, &limit.segment, end, &event_time))
      return false;
  }
  path->motion = *motion;
  tf_advance(path, limit.time, end);
  tf_take_force(path, end);
  return true;
}
