// One step of the Moreau-Jean theta scheme; scheme.h has its stages.
#include "twofold/step.h"

#include "../model/mechanics.h"
#include "report.h"
#include "scheme.h"

// Commit: the state and the report, or the refusal. A Delassus scalar that
// overflows shows that the slopes of h and g did.
TF_INLINE tf_status_t commit(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, const step_end_t *to,
                             tf_report_t *report) {
  const end_state_t at = to->end.at;
  const outcome_t outcome = to->outcome;
  if (!in_reach(at.r, at.v, at.w) || !within(outcome.delassus, TF_REAL_MAX))
    return refuse_step(report, TF_DIVERGED);
  const tf_slip_t slip = slip_speeds(k, at.r, at.v, at.w - input->omega0);
  const tf_real_t residual = mode_residual(k, &outcome, to->end.force, slip);
  if (k->with_angle) // (12)
    state->phi += angle_change(k, state->w, at.w);
  const bool stays = state->r == at.r;
  record(state, at, slip, to->end.force, residual, outcome, report);
  tf_status_t status = outcome.status;
  // The slip of a single-valued law is that of the sign of h.
  if (!plainly_has_signs(k, outcome.mode, slip, at) &&
      tf_tyre_is_set_valued(k->contact.tyre.law))
    status = tf_status_of_end(k, state, input, report);
  return stays ? tf_status_of_stall(k, input, state, report) : status;
}

// A function of its own, so that its stack and that of the end do not add.
TF_RARE tf_status_t commit_rare(const tf_machine_t *k, tf_state_t *state,
                                const tf_input_t *input, const step_end_t *to,
                                tf_report_t *report) {
  if (to->outcome.status < TF_OK)
    return refuse_step(report, to->outcome.status);
  return commit(k, state, input, to, report);
}

// What the common stages of a rare step have decided.
typedef struct {
  uint8_t kind, mode, set;
} decided_t;

// Its arguments are in registers, as those of all that a step calls, and it is
// what the step ends with: what has an address would be in memory in every
// step, and a structure of three numbers is passed there (7 % of a step).
TF_RARE tf_status_t rare_step(const tf_machine_t *k, tf_state_t *state,
                              const tf_input_t *input, tf_report_t *report,
                              decided_t by, tf_real_t F, tf_real_t M,
                              tf_real_t p, tf_real_t z, tf_real_t r,
                              tf_real_t v, tf_real_t w, tf_real_t delassus) {
  step_end_t to = {
      .end = {.force = {F, M}, .friction = {p, z}, .at = {r, v, w}},
      .outcome = {.mode = by.mode, .set = by.set, .delassus = delassus}};
  const start_t start = start_of(k, state, input);
  to.outcome.status =
      tf_rare_end((end_kind_t)by.kind, k, state, input, &start, &to);
  return commit_rare(k, state, input, &to, report);
}

TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report) {
  const tf_machine_t *k = machine;
  if (!may_step(state, input)) return refuse_step(report, TF_BAD_STATE);
  step_end_t to = {.outcome = {.mode = 0}};
  const end_kind_t kind =
      end_of_step(k, state, input, start_of(k, state, input), &to);
  if (kind == END_COMMON) return commit(k, state, input, &to, report);
  const decided_t by = {(uint8_t)kind, (uint8_t)to.outcome.mode,
                        (uint8_t)to.outcome.set};
  return rare_step(k, state, input, report, by, to.end.force.F, to.end.force.M,
                   to.end.friction.p, to.end.friction.z, to.end.at.r,
                   to.end.at.v, to.end.at.w, to.outcome.delassus);
}

// A step beside two halves of it: how far both ends lie apart is the estimate
// of its error. docs/SCHEMES.md lists what else was tried.

// The end of two halves. The draw of a random exit is that of the whole step:
// set_step_length() keeps its chance, and both halves have the tick of the
// step. False where one is refused.
static bool halve(const tf_machine_t *k, const tf_input_t *input,
                  tf_state_t *state) {
  const uint64_t tick = state->tick;
  tf_machine_t half = *k;
  tf_input_t first = *input;
  tf_report_t report;
  set_step_length(&half, k->dt / 2);
  first.omega0 -= input->alpha * half.dt;
  if (tf_step(&half, state, &first, &report) < TF_OK) return false;
  state->tick = tick;
  return tf_step(&half, state, input, &report) >= TF_OK;
}

// |p| + R |z| of a velocity.
static tf_real_t size_of_velocity(const tf_machine_t *k, tf_real_t R,
                                  tf_real_t v, tf_real_t z) {
  return magnitude(slider_speed(k, v, z)) + R * magnitude(z);
}

static tf_real_t difference(const tf_machine_t *k, const tf_input_t *input,
                            const tf_state_t *start, const tf_state_t *whole,
                            const tf_state_t *halves) {
  const tf_real_t R = square_root(gyration2_at(k, whole->r));
  const tf_real_t omega0 = input->omega0;
  const tf_real_t size =
      size_of_velocity(k, R, start->v,
                       start->w - (omega0 - input->alpha * k->dt)) +
      size_of_velocity(k, R, whole->v - start->v, whole->w - start->w);
  const tf_real_t apart =
      size_of_velocity(k, R, whole->v - halves->v, whole->w - halves->w) +
      magnitude(whole->r - halves->r) / k->dt;
  // r is known to half of its last digit at both ends.
  const tf_real_t rounding =
      slip_rounding(k, whole->r, whole->v, whole->w, omega0) +
      TF_REAL_EPSILON * magnitude(whole->r) / k->dt;
  return apart > rounding ? (apart - rounding) / size : 0;
}

TF_API tf_status_t tf_step_estimated(const tf_machine_t *machine,
                                     tf_state_t *state, const tf_input_t *input,
                                     tf_real_t accuracy, tf_report_t *report,
                                     tf_real_t *error) {
  const tf_state_t start = *state;
  const tf_status_t status = tf_step(machine, state, input, report);
  *error = 0;
  if (status < TF_OK) return status;
  tf_state_t halves = start;
  *error = halve(machine, input, &halves)
               ? difference(machine, input, &start, state, &halves)
               : TF_REAL_MAX;
  // Written so that an error that is not a number counts as too large.
  if (!(*error <= accuracy) && status == TF_OK) report->status = TF_COARSE;
  return report->status;
}
