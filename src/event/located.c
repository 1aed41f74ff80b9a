// One step with its events located, as an event-driven scheme for Filippov
// systems (Piiroinen and Kuznetsov 2008) by Taylor series: segment after
// segment until the step is over, each up to its first event.
#include "twofold/located.h"

#include "../friction/slip_residual.h"
#include "../moreau/balance.h"
#include "../moreau/outcome.h"
#include "../moreau/standing.h"
#include "limit_direction.h"
#include "pace.h"
#include "transition.h"

// A slip below so many errors of a segment, and so much smaller than it was at
// the start of the segment, has reached h = g = 0.
#define CAPTURE_ERRORS 256
#define CLOSE_SHARE TF_R(0x1p-6)
// Every so many segments it is asked whether the slip near h = g = 0 is stiff.
#define STIFFNESS_EVERY 5

static tf_status_t validate_located(const tf_machine_t *k,
                                    const tf_state_t *state,
                                    const tf_input_t *input) {
  const tf_tyre_law_t law = k->tyre.law;
  if (!tf_tyre_is_set_valued(law) && law != TF_TYRE_NONE)
    return TF_BAD_PARAMETER;
  if (state->mode >= TF_MODES || !in_range(state, input)) return TF_BAD_STATE;
  return TF_OK;
}

static void begin_trajectory(trajectory_t *path, const tf_machine_t *k,
                             const tf_state_t *state, const tf_input_t *input) {
  path->state = state;
  path->motion.machine = k;
  path->motion.input = input;
  path->omega = input->omega0 - input->alpha * k->dt;
  path->now.r = state->r;
  path->now.z = state->w - path->omega;
  path->now.p = state->v - k->d * path->now.z;
  path->remaining = k->dt;
  path->angle = 0;
  path->tolerance = k->tolerance;
  path->is_coarse = path->is_over = false;
  path->mode = state->mode;
  path->set = 0;
  path->force = (tf_force_t){0, 0};
}

// After an event at the very end of the step the force is that of the contact
// that follows.
static bool end_in_new_segment(trajectory_t *path) {
  path->force = (tf_force_t){path->motion.F.c[0], path->motion.M.c[0]};
  path->is_over = true;
  return true;
}

static bool next_after_limit_direction(trajectory_t *path) {
  const bool at_codim2 = magnitude(path->now.p) + magnitude(path->now.z) == 0;
  path->is_over = !at_codim2 && !(path->remaining > 0);
  return !at_codim2 || tf_next_segment(path, EVENT_CODIM2);
}

// The time at which a stick reaches the two-fold A = 0, if the velocities
// change less on the way than they may be off by, else 0. So near to it
// lambda = N/A is a quotient of two errors, which ever shorter segments follow.
static tf_real_t time_of_near_two_fold(const trajectory_t *path, span_t span) {
  const taylor_t *motion = &path->motion;
  const tf_machine_t *k = motion->machine;
  if (path->segment.contact != CONTACT_STICK || k->stick_kappa == 0) return 0;
  const delassus_quadratic_t at =
      delassus_quadratic(k, (tf_real_t)path->segment.sign_g);
  const tf_real_t A = delassus_quadratic_at(at, motion->r.c[0]);
  const tf_real_t rate =
      delassus_quadratic_rate(at, motion->r.c[0], motion->r.c[1]);
  const tf_real_t time = A * rate < 0 ? -A / rate : 0;
  const bool near =
      time > span.length && time <= path->remaining &&
      tf_term_size(motion, 1) * time <= CAPTURE_ERRORS * span.error;
  return near && magnitude(motion->F.c[1]) * time <= CLOSE_SHARE * k->tyre.mu
             ? time
             : 0;
}

static event_t first_event(const trajectory_t *path, span_t span,
                           tf_real_t *time) {
  const tf_slip_t slip = trajectory_slip(path);
  const tf_real_t close = CLOSE_SHARE * (magnitude(slip.h) + magnitude(slip.g));
  const tf_real_t missed = CAPTURE_ERRORS * span.error;
  const tf_real_t capture =
      (missed < close ? missed : close) + trajectory_rounding(path);
  return tf_next_event(&path->motion, &path->segment, span.length, capture,
                       time);
}

// One segment, up to its first event, and the choice of the next one; false
// where there is none.
static bool integrate_segment(trajectory_t *path, bool ask_for_stiffness) {
  // Expand: (13), (14) with (15) or (16).
  if (!tf_expand(path)) return false;
  if (!(path->remaining > 0)) return end_in_new_segment(path);

  // Length, by the last terms of the series.
  const span_t span = tf_segment_span(path);
  if (!(span.length > 0)) return tf_lengthen_segments(path, LARGEST_FACTOR);

  // Next to a singular point the series are short, and the motion is near to
  // one through that point: slip to h = g = 0, stick to a two-fold.
  if (ask_for_stiffness && tf_may_be_stiff(path, span.length)) {
    const tf_real_t allowed = span.error + trajectory_rounding(path);
    if (tf_follow_limit_direction(path, allowed))
      return next_after_limit_direction(path);
    (void)tf_expand(path); // as above: the series were overwritten
  }
  const tf_real_t two_fold = time_of_near_two_fold(path, span);
  if (two_fold > 0) {
    tf_advance(path, 0, two_fold);
    return tf_next_segment(path, EVENT_TWO_FOLD);
  }

  // First event: the first root of h, g, mu - |lambda| or A.
  tf_real_t time;
  const event_t event = first_event(path, span, &time);

  // Advance. In stick the series of q = r z is truncated, which leaves an h.
  tf_advance(path, 0, time);
  if (path->mode == TF_STICK_PLUS || path->mode == TF_STICK_MINUS)
    tf_project(path);

  // Continue in the contact that follows.
  path->is_over = event == EVENT_NONE && !(path->remaining > 0);
  return path->is_over || tf_next_segment(path, event);
}

static bool integrate_step(trajectory_t *path) {
  if (!tf_first_segment(path)) return false;
  pace_t pace = {.remaining = path->remaining, .segment = 0};
  for (int i = 0; i < TF_LOCATED_MOST_SEGMENTS; i++) {
    tf_keep_pace(path, &pace, i);
    if (!integrate_segment(path, i % STIFFNESS_EVERY == STIFFNESS_EVERY - 1))
      return false;
    if (path->is_over) return true;
  }
  return false;
}

// The whole step by tf_step. What that refuses or degrades, it reports itself.
static tf_status_t fall_back(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, tf_report_t *report) {
  const tf_status_t status = tf_step(k, state, input, report);
  if (status != TF_OK && status != TF_COARSE) return status;
  report->status = TF_FELL_BACK;
  return TF_FELL_BACK;
}

// The most that the contact and the inputs can put in, per second.
static tf_real_t most_power(const tf_machine_t *k, const tf_input_t *u,
                            end_state_t at) {
  const tf_real_t v = magnitude(at.v), w = magnitude(at.w);
  const tf_real_t arm = magnitude(at.r) + magnitude(k->d);
  const tf_real_t mu = k->tyre.law == TF_TYRE_NONE ? 0 : k->tyre.mu;
  return mu * (4 * (v + arm * w) / 3 + k->tyre.kappa * w) +
         magnitude(u->force) * v + magnitude(u->torque) * w;
}

// Whether a step, done with a coarser tolerance, ends with more energy than the
// motion can have.
static bool gains_energy(const tf_machine_t *k, const tf_input_t *u,
                         end_state_t from, end_state_t to) {
  const tf_real_t before = mean_energy(k, u, from, from);
  const tf_real_t after = mean_energy(k, u, to, to);
  const tf_real_t power = most_power(k, u, from) + most_power(k, u, to);
  return !(after - before <= TF_CREATED_SHARE * before + k->dt * power);
}

// How far the force at the end is from the law there, by the law itself.
static tf_real_t residual_at_end(const trajectory_t *path, tf_slip_t slip) {
  const tf_machine_t *k = path->motion.machine;
  const outcome_t stick = {.mode = path->mode};
  if (path->mode > TF_SLIP_MINUS)
    return mode_residual(k, &stick, path->force, slip);
  return slip_law_residual(&k->tyre, path->mode == TF_SLIP_PLUS ? 1 : -1,
                           path->force, slip);
}

// The name of the mode at the end. Where no event tells, it goes by the signs
// there: of h without contact, of g in a stick without a moment.
static unsigned mode_at_end(const trajectory_t *path, tf_slip_t slip) {
  if (path->segment.contact == CONTACT_NONE && slip.h != 0)
    return slip.h < 0 ? TF_SLIP_MINUS : TF_SLIP_PLUS;
  if (path->segment.contact == CONTACT_STICK && slip.g != 0 &&
      path->motion.machine->stick_kappa == 0)
    return slip.g < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
  return path->mode;
}

static tf_status_t commit_located(trajectory_t *path, const tf_input_t *input,
                                  tf_state_t *state, tf_report_t *report) {
  const tf_machine_t *k = path->motion.machine;
  const tf_real_t z = path->now.z;
  const end_state_t end = {path->now.r, path->now.p + k->d * z,
                           z + input->omega0};
  const end_state_t from = {state->r, state->v, state->w};
  if (!in_reach(end.r, end.v, end.w)) return refuse_step(report, TF_DIVERGED);
  if (path->is_coarse && gains_energy(k, input, from, end))
    return fall_back(k, state, input, report);
  const tf_slip_t slip = slip_speeds(k, end.r, end.v, end.w - input->omega0);
  const bool contact = k->tyre.law != TF_TYRE_NONE;
  path->set &= ~TF_MODE_BIT(path->mode);
  path->mode = mode_at_end(path, slip);
  // The mode at the end may come from a smaller set than the largest one.
  const outcome_t outcome = {
      .mode = path->mode,
      .set = path->set | TF_MODE_BIT(path->mode),
      .status = path->is_coarse ? TF_COARSE : TF_OK,
      .delassus = contact ? delassus_at(k, end.r * k->cos_gamma, slip.g < 0,
                                        inertia_at(k, end.r))
                          : 0};
  if (k->with_angle) state->phi += path->angle;
  const bool stays = state->r == end.r;
  record(state, end, slip, path->force, residual_at_end(path, slip), outcome,
         report);
  // What follows an event begins with the h and g that its segment ended with.
  const tf_real_t rounding =
      slip_rounding(k, end.r, end.v, end.w, input->omega0);
  const tf_status_t status = status_by_signs(
      report, rounding + path->tolerance / (32 * TF_REAL_EPSILON) * rounding);
  return stays ? judge_standing(k, input, state, report) : status;
}

// Without a moment nothing ends a stick where g changes its sign: which of both
// names it has is decided by where it is at the end.
static void name_stick(trajectory_t *path) {
  const unsigned sticks = path->set & STICKS;
  if (path->motion.machine->stick_kappa > 0 || !(path->mode > TF_SLIP_MINUS))
    return;
  path->mode = trajectory_slip(path).g < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
  path->set = (path->set & ~sticks) | TF_MODE_BIT(path->mode);
}

TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report) {
  const tf_status_t status = validate_located(machine, state, input);
  if (status != TF_OK) return refuse_step(report, status);
  trajectory_t path;
  begin_trajectory(&path, machine, state, input);
  if (!integrate_step(&path)) return fall_back(machine, state, input, report);
  name_stick(&path);
  return commit_located(&path, input, state, report);
}
