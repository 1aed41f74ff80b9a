// The step that keeps the rounding of its state: the stages of tf_step, with
// the slip at the start and the end of the step in pairs (compensation.h).
#include "twofold/compensated.h"

#include "compensation.h"
#include "rare_end.h"
#include "report.h"
#include "scheme.h"

// Where the balanced form ends starts from the leading parts; what they leave
// out is carried over.
TF_INLINE state_pair_t balanced_end_in_pairs(end_state_t at,
                                             const tf_compensation_t *low) {
  return (state_pair_t){pair_plus((pair_t){at.r, 0}, low->r),
                        pair_plus((pair_t){at.v, 0}, low->v),
                        pair_plus((pair_t){at.w, 0}, low->w)};
}

// What one step is given.
typedef struct {
  const tf_compensated_t *constants;
  tf_state_t *state;
  tf_compensation_t *low;
  const tf_input_t *input;
} compensated_step_t;

// Where a step ends, in pairs.
TF_INLINE state_pair_t pairs_at_end(const compensated_step_t *step,
                                    tf_force_t force, change_t friction,
                                    outcome_t outcome, end_state_t at) {
  const tf_machine_t *k = &step->constants->machine;
  const state_pair_t from = paired(step->state, step->low);
  if (outcome.is_balanced) return balanced_end_in_pairs(at, step->low);
  if (outcome.mode == TF_PINNED)
    return end_at_rest_in_pairs(k, &from, step->input->omega0);
  // A mean over a passage of h = g = 0 has a moment of its own.
  const unsigned law = outcome.is_mean ? TF_MODES : outcome.mode;
  const linear_t l = linearise(k, step->state, step->input);
  return end_in_pairs(step->constants, &from, step->input, &l, law, force,
                      friction);
}

// Commit: the end of the step in pairs, the state and the report, or the
// refusal. It derives the inverse of (6) anew: as a function of its own, which
// a step ends with, its pairs and those of the step need no stack together.
static __attribute__((noinline)) tf_status_t commit_pairs(
    compensated_step_t *step, const step_end_t *to, tf_report_t *report) {
  const tf_machine_t *k = &step->constants->machine;
  tf_state_t *state = step->state;
  outcome_t outcome = to->outcome;
  const tf_force_t force = to->end.force;
  const state_pair_t end =
      pairs_at_end(step, force, to->end.friction, outcome, to->end.at);
  if (!in_reach(end.r.hi, end.v.hi, end.w.hi) ||
      !within(outcome.delassus + outcome.residual, TF_REAL_MAX))
    return refuse_step(report, TF_DIVERGED); // one of the two is 0
  const pair_t omega0 = {step->input->omega0, 0};
  const tf_slip_t slip = slip_in_pairs(step->constants, &end, omega0).slip;
  const end_state_t at = {end.r.hi, end.v.hi, end.w.hi};
  if (outcome.is_balanced) outcome.mode = slip_of_sign(slip.h, state->mode);
  const tf_real_t residual = mode_residual(k, &outcome, force, slip);
  store_compensation(k, state, step->low, &end);
  record(state, at, slip, force, residual, outcome, report);
  if (plainly_has_signs(k, outcome.mode, slip, at)) return outcome.status;
  return tf_status_of_end(k, state, step->input, report);
}

TF_API tf_status_t tf_step_compensated(const tf_compensated_t *machine,
                                       tf_state_t *state,
                                       tf_compensation_t *compensation,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const tf_machine_t *k = &machine->machine;
  const tf_real_t low =
      magnitude(compensation->r) + magnitude(compensation->v) +
      magnitude(compensation->w) + magnitude(compensation->phi);
  if (!may_step(state, input) || !within(low, TF_STATE_LIMIT))
    return refuse_step(report, TF_BAD_STATE);
  const state_pair_t pairs = paired(state, compensation);
  const tf_real_t turn = turn_of_step(k, input);
  const pair_t omega0 = two_sum(input->omega0, -turn);
  start_t start = slip_in_pairs(machine, &pairs, omega0);
  start.p += k->d * turn; // now against the turntable of the end
  start.z -= turn;
  step_end_t to;
  const end_kind_t kind = end_of_step(k, state, input, start, &to);
  if (kind != END_COMMON) {
    const tf_status_t status = tf_rare_end(kind, k, state, input, &start, &to);
    if (status < TF_OK) return refuse_step(report, status);
  }
  compensated_step_t step = {machine, state, compensation, input};
  return commit_pairs(&step, &to, report);
}
