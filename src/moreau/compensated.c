// The step that keeps the rounding of its state: the stages of tf_step, with
// the slip at the start and the end of the step in pairs (compensation.h).
#include "twofold/compensated.h"

#include "balance.h"
#include "balanced.h"
#include "codim2_end.h"
#include "compensation.h"
#include "least_violation.h"
#include "outcome.h"
#include "single_valued.h"
#include "stages.h"

// What one step is given.
typedef struct {
  const tf_compensated_t *constants;
  tf_state_t *state;
  tf_compensation_t *low;
  const tf_input_t *input;
  tf_report_t *report;
} compensated_step_t;

TF_INLINE free_motion_t compensated_motion(compensated_step_t *step) {
  const tf_machine_t *k = &step->constants->machine;
  const state_pair_t pairs = paired(step->state, step->low);
  return free_motion(
      k, step->state, linearise(k, step->state, step->input),
      slip_in_pairs(step->constants, &pairs, step->input->omega0));
}

// Commit: the end of the step in pairs, the state and the report, or the
// refusal. It derives the inverse of (6) anew: as a function of its own, which
// a step ends with, its pairs and those of the step need no stack together.
// `residual` is that of a single-valued law.
static __attribute__((noinline)) tf_status_t commit_pairs(
    compensated_step_t *step, tf_force_t force, change_t friction,
    outcome_t outcome, tf_real_t residual) {
  const tf_machine_t *k = &step->constants->machine;
  const tf_real_t omega0 = step->input->omega0;
  const linear_t l = linearise(k, step->state, step->input);
  // A mean over a passage of h = g = 0 has a moment of its own.
  const unsigned law = outcome.is_mean ? TF_MODES : outcome.mode;
  const state_pair_t from = paired(step->state, step->low);
  const state_pair_t to =
      outcome.mode == TF_PINNED
          ? rest_in_pairs(k, &from, omega0)
          : end_in_pairs(step->constants, &from, step->input, &l, law, force,
                         friction);
  if (!in_reach(to.r.hi, to.v.hi, to.w.hi) ||
      !within(outcome.delassus + residual, TF_REAL_MAX)) // one of them is 0
    return refuse_step(step->report, TF_DIVERGED);
  const tf_slip_t slip = slip_in_pairs(step->constants, &to, omega0).slip;
  const end_state_t at = {to.r.hi, to.v.hi, to.w.hi};
  if (tf_tyre_is_set_valued(k->tyre.law))
    residual = mode_residual(k, &outcome, force, slip);
  store_compensation(k, step->state, step->low, &to);
  record(step->state, at, slip, force, residual, outcome, step->report);
  if (plainly_has_signs(k, outcome.mode, slip, at)) return outcome.status;
  return status_of_end(k, step->state, omega0, step->report);
}

// The step in the form that creates no energy. It starts from the leading
// parts; what they leave out is carried over.
TF_RARE tf_status_t balanced_compensated_step(compensated_step_t *step,
                                              tf_force_t force,
                                              outcome_t outcome) {
  const tf_machine_t *k = &step->constants->machine;
  const balanced_end_t end =
      tf_balanced_end(k, step->state, step->input, outcome.mode, force);
  if (!in_reach(end.at.r, end.at.v, end.at.w) ||
      !within(outcome.delassus, TF_REAL_MAX))
    return refuse_step(step->report, TF_DIVERGED);
  const state_pair_t to = {pair_plus((pair_t){end.at.r, 0}, step->low->r),
                           pair_plus((pair_t){end.at.v, 0}, step->low->v),
                           pair_plus((pair_t){end.at.w, 0}, step->low->w)};
  const end_state_t at = {to.r.hi, to.v.hi, to.w.hi};
  const tf_slip_t slip =
      slip_in_pairs(step->constants, &to, step->input->omega0).slip;
  outcome.mode = slip_of_sign(slip.h, step->state->mode);
  outcome.is_mean = false;
  outcome.delassus = end.delassus;
  if (outcome.status == TF_OK) outcome.status = TF_COARSE;
  store_compensation(k, step->state, step->low, &to);
  record(step->state, at, slip, end.force,
         mode_residual(k, &outcome, end.force, slip), outcome, step->report);
  return outcome.status;
}

// Balance, and commit.
TF_INLINE tf_status_t close_compensated_step(compensated_step_t *step,
                                             const forced_end_t *end,
                                             outcome_t outcome,
                                             tf_real_t residual) {
  const tf_machine_t *k = &step->constants->machine;
  const end_state_t from = {step->state->r, step->state->v, step->state->w};
  const balance_t b =
      balance_of(k, is_midpoint(k), step->input, from, end->at, end->force.F);
  if (!is_balanced(&b) || ends_slip(step->state->mode, outcome.mode)) {
    const tf_real_t energy = mean_energy(k, step->input, from, end->at);
    if (creates_energy(&b, energy))
      return balanced_compensated_step(step, end->force, outcome);
    const bool blow =
        ends_slip(step->state->mode, outcome.mode) && is_blow(k, from, end->at);
    if (outcome.status == TF_OK &&
        (blow || is_too_coarse(k, &b, energy, from, end->at)))
      outcome.status = TF_COARSE;
  }
  return commit_pairs(step, end->force, end->friction, outcome, residual);
}

TF_RARE tf_status_t degraded_compensated_step(compensated_step_t *step) {
  free_motion_t c = compensated_motion(step);
  const violation_t best = least_violation(&c);
  return close_compensated_step(step, &best.end, best.outcome, 0);
}

// A slip that turns within the step; see turning_step().
TF_RARE tf_status_t turning_compensated_step(compensated_step_t *step,
                                             unsigned slip) {
  const tf_machine_t *k = &step->constants->machine;
  free_motion_t c = compensated_motion(step);
  inclusion_t in;
  solutions_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  const unsigned mode = mode_instead(&s, slip);
  const forced_end_t end = mode_end(&c, &s, mode);
  const end_state_t from = {step->state->r, step->state->v, step->state->w};
  const bool unsure = mode == slip && is_blow(k, from, end.at);
  const outcome_t outcome = {mode, s.set, unsure ? TF_COARSE : TF_OK,
                             end_delassus(&c, &in, signs, &end), false};
  return close_compensated_step(step, &end, outcome, 0);
}

// At h = g = 0, or near it with the mode lost.
TF_RARE tf_status_t codim2_compensated_step(compensated_step_t *step) {
  free_motion_t c = compensated_motion(step);
  const codim2_end_t to = codim2_end(&c, step->input);
  if (to.outcome.mode == TF_NO_MODE) return degraded_compensated_step(step);
  return close_compensated_step(step, &to.end, to.outcome, 0);
}

// A function of its own, so that its stack and that of the search for the force
// do not add.
TF_RARE tf_status_t compensated_step_under_force(compensated_step_t *step,
                                                 tf_real_t F, tf_real_t M) {
  const free_motion_t c = compensated_motion(step);
  const single_valued_end_t to = single_valued_end(&c, (tf_force_t){F, M});
  const outcome_t outcome = {to.mode, TF_MODE_BIT(to.mode), TF_OK, 0, false};
  return close_compensated_step(step, &to.end, outcome, to.residual);
}

TF_RARE tf_status_t single_valued_compensated_step(compensated_step_t *step) {
  const free_motion_t c = compensated_motion(step);
  if (!c.linear.definite) return refuse_step(step->report, TF_STEP_TOO_LONG);
  const tf_force_t force = single_valued_force(&c);
  return compensated_step_under_force(step, force.F, force.M);
}

TF_API tf_status_t tf_step_compensated(const tf_compensated_t *machine,
                                       tf_state_t *state,
                                       tf_compensation_t *compensation,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const tf_machine_t *k = &machine->machine;
  compensated_step_t step = {machine, state, compensation, input, report};
  // Validate.
  const tf_real_t low =
      magnitude(compensation->r) + magnitude(compensation->v) +
      magnitude(compensation->w) + magnitude(compensation->phi);
  if (!may_step(state, input) || !within(low, TF_STATE_LIMIT))
    return refuse_step(report, TF_BAD_STATE);
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return single_valued_compensated_step(&step);
  // Free motion, (1)-(7).
  free_motion_t c = compensated_motion(&step);
  if (!c.linear.definite) return refuse_step(report, TF_STEP_TOO_LONG);
  // Inclusion, (8), and every mode that solves it.
  inclusion_t in;
  solutions_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  // Choose.
  if (is_near_codim2(&c, &in, signs, s.set))
    return codim2_compensated_step(&step);
  const unsigned mode = choose_mode(k, state, &s);
  if (mode == TF_NO_MODE) return degraded_compensated_step(&step);
  // End in the mode, (9), (10).
  const forced_end_t end = mode_end(&c, &s, mode);
  if (end.turns) return turning_compensated_step(&step, mode);
  // Balance, and commit.
  const outcome_t outcome = {mode, s.set, TF_OK,
                             end_delassus(&c, &in, signs, &end), false};
  return close_compensated_step(&step, &end, outcome, 0);
}
