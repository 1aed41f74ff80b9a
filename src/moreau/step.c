// One step of the Moreau-Jean theta scheme; scheme.h has its stages.
#include "twofold/step.h"

#include "rare_end.h"
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
  if (!plainly_has_signs(k, outcome.mode, slip, at))
    status = tf_status_of_end(k, state, input, report);
  return stays ? tf_status_of_stall(k, input, state, report) : status;
}

TF_RARE tf_status_t rare_step(const tf_machine_t *k, tf_state_t *state,
                              const tf_input_t *input, tf_report_t *report) {
  const start_t start = start_of(k, state, input);
  const step_end_t to = tf_rare_end(k, state, input, start);
  if (to.outcome.status < TF_OK) return refuse_step(report, to.outcome.status);
  return commit(k, state, input, &to, report);
}

TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report) {
  const tf_machine_t *k = machine;
  if (!may_step(state, input)) return refuse_step(report, TF_BAD_STATE);
  const start_t start = start_of(k, state, input);
  step_end_t to;
  if (!common_end(k, state, input, start, &to))
    return rare_step(k, state, input, report);
  return commit(k, state, input, &to, report);
}
