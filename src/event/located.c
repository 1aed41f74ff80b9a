// One step with its events located, as an event-driven scheme for Filippov
// systems (Piiroinen and Kuznetsov 2008) by Taylor series: segment after
// segment until the step is over, each up to its first event.
#include "twofold/located.h"

#include "../friction/rest_law.h"
#include "../model/mechanics.h"
#include "../moreau/report.h"
#include "trajectory.h"

// A slip below so many errors of a segment, and so much smaller than it was at
// the start of the segment, has reached h = g = 0.
#define CAPTURE_ERRORS 256
#define CLOSE_SHARE TF_R(0x1p-6)
// Every so many segments a slip near h = g = 0 is tested for being stiff.
#define STIFFNESS_EVERY 5

static tf_status_t validate_located(const tf_machine_t *k,
                                    const tf_state_t *state,
                                    const tf_input_t *input) {
  const tf_tyre_law_t law = k->contact.tyre.law;
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
  path->motion.speed = 0;
  const tf_real_t turn = input->alpha * k->dt;
  path->omega = input->omega0 - turn;
  path->turn = magnitude(turn);
  path->now.r = state->r;
  path->now.z = state->w - path->omega;
  path->now.p = slider_speed(k, state->v, path->now.z);
  path->remaining = k->dt;
  path->angle = 0;
  path->is_over = path->is_unsure = false;
  path->spent = 0;
  path->mode = state->mode;
  path->set = path->here = 0;
  path->force = (tf_force_t){0, 0};
}

// Whether a slip next to h = g = 0 went along a limit direction. A try that
// fails counts as a segment, so that no segment of the budget costs both.
static bool goes_along_limit_direction(trajectory_t *path, span_t span) {
  const bool is_due = path->spent % STIFFNESS_EVERY == 0 || span.length == 0;
  if (!is_due || !tf_may_be_stiff(path, span.length)) return false;
  if (tf_follow_limit_direction(path, span.error + trajectory_rounding(path)))
    return true;
  path->spent++;
  return false;
}

// The time at which a stick reaches the two-fold A = 0, if the velocities
// change less until then than they may be off by, else 0. So near to it
// lambda = N/A is a quotient of two errors, which ever shorter segments follow.
static tf_real_t time_of_near_two_fold(const trajectory_t *path, span_t span) {
  const taylor_t *motion = &path->motion;
  const tf_machine_t *k = motion->machine;
  if (path->segment.kind != SEGMENT_STICK || k->contact.stick_kappa == 0 ||
      !(span.length < path->remaining))
    return 0;
  const delassus_quadratic_t at = delassus_quadratic(k, path->segment.sign_g);
  const tf_real_t A = delassus_quadratic_at(at, motion->r.c[0]);
  const tf_real_t rate =
      delassus_quadratic_rate(at, motion->r.c[0], motion->r.c[1]);
  const tf_real_t time = A * rate < 0 ? -A / rate : 0;
  const bool captures =
      time > span.length && time <= path->remaining &&
      term_size(motion, 1) * time <= CAPTURE_ERRORS * span.error;
  const tf_real_t change = magnitude(motion->F.c[1]) * time;
  return captures && change <= CLOSE_SHARE * k->contact.tyre.mu ? time : 0;
}

// How far the trajectory is from h = g = 0 [m/s], where either z or r becomes 0
// (place_at_codim2): r, which is an integral of v over the segment, by what it
// may be off by there.
static tf_real_t distance_to_codim2(const trajectory_t *path, tf_real_t time) {
  const phase_point_t now = path->now;
  const rates_t rates = tf_trajectory_rates(path);
  return magnitude(now.p) + (rates.vz > rates.rz
                                 ? magnitude(now.r) / time
                                 : path->motion.length * magnitude(now.z));
}

// Whether a slip with h = 0 or g = 0 at the end of a segment has reached both.
static bool is_at_codim2(const trajectory_t *path, span_t span) {
  const taylor_t *motion = &path->motion;
  const tf_slip_t start =
      slip_from_pq(motion->machine, motion->p.c[0], motion->q.c[0]);
  const tf_real_t close =
      CLOSE_SHARE * (magnitude(start.h) + magnitude(start.g));
  const tf_real_t missed = CAPTURE_ERRORS * span.error;
  const tf_real_t capture =
      (missed < close ? missed : close) + trajectory_rounding(path);
  return magnitude(path->now.p) + magnitude(path->now.r * path->now.z) <=
             capture &&
         distance_to_codim2(path, span.length) <= capture;
}

// One segment, up to its first event, and the choice of the next one; false
// where there is none.
TF_INLINE bool integrate_segment(trajectory_t *path) {
  // Expand: (13), (14) with (15) or (16).
  if (!tf_begin_series(path)) return false;
  // At the very end of the step the force is that of the contact that follows.
  path->is_over = !(path->remaining > 0);
  if (path->is_over) {
    path->force = (tf_force_t){path->motion.F.c[0], path->motion.M.c[0]};
    return true;
  }

  // Length, by the last terms of the series.
  const span_t span = tf_segment_span(path);

  // Next to a singular point the series are short, and the motion is near to
  // one through that point: slip to h = g = 0, stick to a two-fold.
  if (goes_along_limit_direction(path, span)) {
    if (magnitude(path->now.p) + magnitude(path->now.z) == 0)
      return tf_next_segment(path, EVENT_CODIM2);
    path->is_over = !(path->remaining > 0);
    return true;
  }
  if (!(span.length > 0) || path->spent > path->motion.machine->segments)
    return false;
  const tf_real_t two_fold = time_of_near_two_fold(path, span);
  if (two_fold > 0) {
    tf_advance(path, 0, two_fold);
    return tf_next_segment(path, EVENT_TWO_FOLD);
  }

  // First event: the first root of h, g, mu - |lambda| or A.
  tf_real_t time;
  event_t event =
      tf_next_event(&path->motion, &path->segment, span.length, &time);

  // Advance. In stick the series of q = r z is truncated, which leaves an h.
  tf_advance(path, 0, time);
  if (event == EVENT_RELEASE || !(path->remaining > 0))
    tf_take_force(path, time);
  if (is_stick(path->mode)) tf_project(path);
  if ((event == EVENT_H_ZERO || event == EVENT_G_ZERO) &&
      path->motion.machine->contact.stick_kappa > 0 && is_at_codim2(path, span))
    event = EVENT_CODIM2;

  // Continue in the contact that follows.
  path->is_over = event == EVENT_NONE && !(path->remaining > 0);
  return path->is_over || tf_next_segment(path, event);
}

static end_state_t end_of(const trajectory_t *path) {
  const tf_real_t z = path->now.z;
  return (end_state_t){path->now.r,
                       slider_velocity(path->motion.machine, path->now.p, z),
                       z + path->omega};
}

// The name of the mode at the end. Where no event decides, it goes by the signs
// there: of h without contact, of g in a stick without a moment.
static unsigned mode_at_end(const trajectory_t *path, tf_slip_t slip) {
  if (path->segment.kind == SEGMENT_FREE && slip.h != 0)
    return slip_with(sign_of(slip.h));
  if (path->segment.kind == SEGMENT_STICK && slip.g != 0 &&
      path->motion.machine->contact.stick_kappa == 0)
    return stick_with(sign_of(slip.g));
  return path->mode;
}

// The changes that a step has met, for whom asks for them.
typedef struct {
  tf_located_change_t *list;
  size_t room, count;
  unsigned mode; // before the next one
} changes_t;

// Notes the contact from here on, where it is another one, a stick passes
// through a two-fold, or a motion comes to h = g = 0 and may go on in several
// modes. g has the sign that follows, also where it is 0.
static void note_change(changes_t *changes, trajectory_t *path) {
  const tf_machine_t *k = path->motion.machine;
  const bool passes = is_stick(path->mode) && path->segment.A_starts_at_zero;
  const bool chooses = path->spent > 0 && path->segment.g_starts_at_zero &&
                       size_of(path->here) > 1;
  const bool is_new = path->mode != changes->mode || passes || chooses;
  changes->mode = path->mode;
  if (!is_new || changes->count++ >= changes->room) return;
  const end_state_t at = end_of(path);
  tf_slip_t slip = trajectory_slip(path);
  const unsigned mode = mode_at_end(path, slip);
  const unsigned set =
      (path->here & ~TF_MODE_BIT(path->mode)) | TF_MODE_BIT(mode);
  tf_located_change_t *change = &changes->list[changes->count - 1];
  change->time = k->dt - path->remaining;
  change->state = *path->state;
  change->state.r = at.r;
  change->state.v = at.v;
  change->state.w = at.w;
  change->state.mode = (uint8_t)mode;
  if (k->with_angle) change->state.phi += path->angle;
  if (slip.g == 0 && mode != TF_PINNED)
    slip.g = with_sign(path->segment.sign_g, TF_REAL_MIN);
  const bool contact = k->contact.tyre.law != TF_TYRE_NONE;
  const tf_real_t A = contact && !passes
                          ? delassus_at(k, at.r * k->cos_gamma, sign_of(slip.g),
                                        inertia_at(k, at.r))
                          : 0;
  path->motion.F.c[0] = path->motion.M.c[0] = 0; // where no series begins
  (void)tf_begin_series(path);
  change->report =
      (tf_report_t){.mode = (uint8_t)mode,
                    .set = (uint8_t)set,
                    .choices = (uint8_t)size_of(set),
                    .force = {path->motion.F.c[0], path->motion.M.c[0]},
                    .slip = slip,
                    .delassus = A,
                    .status = TF_OK};
}

// How far the segments of the budget come.
typedef enum {
  PROGRESS_NONE, // not from the start of the step
  PROGRESS_PART, // to a point within it
  PROGRESS_WHOLE // to its end
} progress_t;

TF_INLINE progress_t integrate_step(trajectory_t *path, changes_t *changes) {
  const tf_machine_t *k = path->motion.machine;
  bool goes_on = tf_first_segment(path);
  while (goes_on && !path->is_over) {
    if (changes != NULL) note_change(changes, path);
    goes_on = path->spent++ < k->segments && integrate_segment(path);
  }
  if (goes_on) return PROGRESS_WHOLE;
  return path->remaining < k->dt ? PROGRESS_PART : PROGRESS_NONE;
}

// The whole step by tf_step. What that refuses, degrades or finds too coarse,
// it reports itself: that weighs more than which scheme took the step.
static tf_status_t fall_back(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, tf_report_t *report) {
  const tf_status_t status = tf_step(k, state, input, report);
  if (status != TF_OK) return status;
  report->status = TF_FELL_BACK;
  return TF_FELL_BACK;
}

// What is left of the step behind the segments, by one of tf_step.
static tf_status_t finish_by_fixed_step(const trajectory_t *path,
                                        tf_state_t *state,
                                        tf_report_t *report) {
  tf_machine_t k = *path->motion.machine;
  set_step_length(&k, path->remaining > MIN_STEP ? path->remaining : MIN_STEP);
  const end_state_t from = end_of(path);
  if (!in_reach(from.r, from.v, from.w))
    return refuse_step(report, TF_DIVERGED);
  tf_state_t x = *state;
  x.r = from.r;
  x.v = from.v;
  x.w = from.w;
  x.mode = (uint8_t)path->mode;
  if (k.with_angle) x.phi += path->angle;
  tf_report_t of_remainder;
  const tf_status_t status = tf_step(&k, &x, path->motion.input, &of_remainder);
  if (status < TF_OK) return refuse_step(report, status);
  *state = x;
  *report = of_remainder;
  const unsigned met = size_of(path->set) > size_of(of_remainder.set)
                           ? path->set
                           : of_remainder.set;
  report->set = (uint8_t)(met | TF_MODE_BIT(of_remainder.mode));
  report->choices = (uint8_t)size_of(report->set);
  if (status == TF_OK) report->status = TF_COARSE;
  return report->status;
}

// How far the force at the end is from the law there, by the law itself.
TF_INLINE tf_real_t residual_at_end(const trajectory_t *path, tf_slip_t slip) {
  const tf_machine_t *k = path->motion.machine;
  const outcome_t stick = {.mode = path->mode};
  if (!is_slip(path->mode)) return mode_residual(k, &stick, path->force, slip);
  return slip_law_residual(&k->contact.tyre, sign_in(path->mode), path->force,
                           slip);
}

TF_INLINE tf_status_t commit_located(trajectory_t *path,
                                     const tf_input_t *input, tf_state_t *state,
                                     tf_report_t *report) {
  const tf_machine_t *k = path->motion.machine;
  // At the end the turntable has the speed of the input.
  path->omega = input->omega0;
  const end_state_t end = end_of(path);
  if (!in_reach(end.r, end.v, end.w)) return refuse_step(report, TF_DIVERGED);
  const tf_slip_t slip = slip_speeds(k, end.r, end.v, end.w - input->omega0);
  const bool contact = k->contact.tyre.law != TF_TYRE_NONE;
  path->set &= ~TF_MODE_BIT(path->mode);
  path->mode = mode_at_end(path, slip);
  // The mode at the end may come from a smaller set than the largest one.
  const outcome_t outcome = {
      .mode = path->mode,
      .set = path->set | TF_MODE_BIT(path->mode),
      .status = TF_OK,
      .delassus = contact ? delassus_at(k, end.r * k->cos_gamma,
                                        sign_of(slip.g), inertia_at(k, end.r))
                          : 0};
  if (k->with_angle) state->phi += path->angle;
  const bool stays = state->r == end.r;
  record(state, end, slip, path->force, residual_at_end(path, slip), outcome,
         report);
  // What follows an event begins with the h and g that its segment ended with.
  const tf_real_t rounding = step_rounding(path, end, input->omega0);
  const tf_status_t status = status_by_signs(
      report, rounding + k->tolerance / SLIP_ROUNDINGS * rounding);
  if (status == TF_OK && path->is_unsure) return report->status = TF_COARSE;
  return stays ? tf_status_of_stall(k, input, state, report) : status;
}

// Without a moment nothing ends a stick where g changes its sign: which of both
// names it has is decided by where it is at the end.
static void name_stick(trajectory_t *path) {
  const unsigned sticks = path->set & STICKS;
  if (path->motion.machine->contact.stick_kappa > 0 || is_slip(path->mode))
    return;
  path->mode = stick_with(sign_of(trajectory_slip(path).g));
  path->set = (path->set & ~sticks) | TF_MODE_BIT(path->mode);
}

TF_INLINE tf_status_t step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report, changes_t *changes) {
  const tf_status_t status = validate_located(machine, state, input);
  if (status != TF_OK) return refuse_step(report, status);
  trajectory_t path;
  begin_trajectory(&path, machine, state, input);
  const progress_t progress = integrate_step(&path, changes);
  if (changes != NULL && progress == PROGRESS_NONE) changes->count = 0;
  if (progress == PROGRESS_NONE)
    return fall_back(machine, state, input, report);
  if (progress == PROGRESS_PART)
    return finish_by_fixed_step(&path, state, report);
  name_stick(&path);
  return commit_located(&path, input, state, report);
}

TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report) {
  return step_located(machine, state, input, report, NULL);
}

TF_API tf_status_t tf_step_located_changes(const tf_machine_t *machine,
                                           tf_state_t *state,
                                           const tf_input_t *input,
                                           tf_report_t *report,
                                           tf_located_change_t *list,
                                           size_t room, size_t *count) {
  changes_t changes = {list, room, 0, state->mode};
  const tf_status_t status =
      step_located(machine, state, input, report, &changes);
  *count = status < 0 ? 0 : changes.count;
  return status;
}
