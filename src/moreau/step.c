// One step of the Moreau-Jean theta scheme. tf_step at the end of this file is
// the scheme, stage by stage. Rare cases are functions of their own that are
// called last, so that their stacks do not add.
#include "twofold/step.h"

#include "balance.h"
#include "balanced.h"
#include "codim2_end.h"
#include "least_violation.h"
#include "outcome.h"
#include "single_valued.h"
#include "stages.h"
#include "standing.h"

// Commit: the state and the report, or the refusal. A Delassus scalar that
// overflows shows that the slopes of h and g did.
TF_INLINE tf_status_t commit(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, end_state_t at,
                             tf_force_t force, outcome_t outcome,
                             tf_report_t *report) {
  if (!in_reach(at.r, at.v, at.w) || !within(outcome.delassus, TF_REAL_MAX))
    return refuse_step(report, TF_DIVERGED);
  const tf_slip_t slip = slip_speeds(k, at.r, at.v, at.w - input->omega0);
  const tf_real_t residual = mode_residual(k, &outcome, force, slip);
  if (k->with_angle) // (12)
    state->phi += angle_turned(k, state->w, at.w);
  const bool stays = state->r == at.r;
  record(state, at, slip, force, residual, outcome, report);
  tf_status_t status = outcome.status;
  if (!plainly_has_signs(k, outcome.mode, slip, at))
    status = status_of_end(k, state, input->omega0, report);
  return stays ? judge_standing(k, input, state, report) : status;
}

// A step that is not beyond doubt: taken again in the form that creates no
// energy where it does, and not TF_OK where it is too long for the motion.
TF_RARE tf_status_t doubtful_step(const tf_machine_t *k, tf_state_t *state,
                                  const tf_input_t *input, tf_report_t *report,
                                  end_state_t at, tf_force_t force,
                                  outcome_t outcome) {
  const end_state_t from = {state->r, state->v, state->w};
  const tf_real_t energy = mean_energy(k, input, from, at);
  const balance_t b = balance_of(k, is_midpoint(k), input, from, at, force.F);
  if (creates_energy(&b, energy)) {
    const balanced_end_t end =
        tf_balanced_end(k, state, input, outcome.mode, force);
    at = end.at;
    force = end.force;
    outcome.mode = end.mode;
    outcome.is_mean = false;
    outcome.delassus = end.delassus;
    if (outcome.status == TF_OK) outcome.status = TF_COARSE;
  } else if (outcome.status == TF_OK &&
             (is_too_coarse(k, &b, energy, from, at) ||
              (ends_slip(state->mode, outcome.mode) && is_blow(k, from, at)))) {
    outcome.status = TF_COARSE;
  }
  return commit(k, state, input, at, force, outcome, report);
}

// Balance, and commit.
TF_INLINE tf_status_t close_step(const free_motion_t *c, tf_state_t *state,
                                 const tf_input_t *input,
                                 const forced_end_t *end, outcome_t outcome,
                                 tf_report_t *report) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const end_state_t from = {state->r, state->v, state->w};
  const balance_t b =
      balance_of(k, is_midpoint(k), input, from, end->at, end->force.F);
  if (!is_balanced(&b) || ends_slip(state->mode, outcome.mode))
    return doubtful_step(k, state, input, report, end->at, end->force, outcome);
  return commit(k, state, input, end->at, end->force, outcome, report);
}

TF_RARE tf_status_t degraded_step(const tf_machine_t *k, tf_state_t *state,
                                  const tf_input_t *input,
                                  tf_report_t *report) {
  free_motion_t c = plain_motion(k, state, input);
  const violation_t best = least_violation(&c);
  return close_step(&c, state, input, &best.end, best.outcome, report);
}

// A slip that turns within the step, see slip_end(): not TF_OK where a blow
// does that and the slip is kept.
TF_RARE tf_status_t turning_step(const tf_machine_t *k, tf_state_t *state,
                                 const tf_input_t *input, unsigned slip,
                                 tf_report_t *report) {
  free_motion_t c = plain_motion(k, state, input);
  inclusion_t in;
  solutions_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  const unsigned mode = mode_instead(&s, slip);
  const forced_end_t end = mode_end(&c, &s, mode);
  const end_state_t from = {state->r, state->v, state->w};
  const bool unsure = mode == slip && is_blow(k, from, end.at);
  const outcome_t outcome = {mode, s.set, unsure ? TF_COARSE : TF_OK,
                             end_delassus(&c, &in, signs, &end), false};
  return close_step(&c, state, input, &end, outcome, report);
}

// At h = g = 0, or near it with the mode lost.
TF_RARE tf_status_t codim2_step(const tf_machine_t *k, tf_state_t *state,
                                const tf_input_t *input, tf_report_t *report) {
  free_motion_t c = plain_motion(k, state, input);
  const codim2_end_t to = codim2_end(&c, input);
  if (to.outcome.mode == TF_NO_MODE)
    return degraded_step(k, state, input, report);
  return close_step(&c, state, input, &to.end, to.outcome, report);
}

// A function of its own, so that its stack and that of the search for the force
// do not add.
TF_RARE tf_status_t step_under_force(const tf_machine_t *k, tf_state_t *state,
                                     const tf_input_t *input,
                                     tf_report_t *report, tf_real_t F,
                                     tf_real_t M) {
  const free_motion_t c = plain_motion(k, state, input);
  const single_valued_end_t to = single_valued_end(&c, (tf_force_t){F, M});
  const outcome_t outcome = {to.mode, TF_MODE_BIT(to.mode), TF_OK, 0, false};
  const tf_status_t status =
      close_step(&c, state, input, &to.end, outcome, report);
  if (status >= TF_OK) // at most so far, if the step was taken in another form
    report->residual = to.residual + magnitude(report->force.F - F);
  return status;
}

TF_RARE tf_status_t single_valued_step(const tf_machine_t *k, tf_state_t *state,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const free_motion_t c = plain_motion(k, state, input);
  if (!c.linear.definite) return refuse_step(report, TF_STEP_TOO_LONG);
  const tf_force_t force = single_valued_force(&c);
  return step_under_force(k, state, input, report, force.F, force.M);
}

TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report) {
  const tf_machine_t *k = machine;
  // Validate.
  if (!may_step(state, input)) return refuse_step(report, TF_BAD_STATE);
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return single_valued_step(k, state, input, report);
  // Free motion, (1)-(7).
  free_motion_t c = plain_motion(k, state, input);
  if (!c.linear.definite) return refuse_step(report, TF_STEP_TOO_LONG);
  // Inclusion, (8), and every mode that solves it.
  inclusion_t in;
  solutions_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  // Choose.
  if (is_near_codim2(&c, &in, signs, s.set))
    return codim2_step(k, state, input, report);
  const unsigned mode = choose_mode(k, state, &s);
  if (mode == TF_NO_MODE) return degraded_step(k, state, input, report);
  // End in the mode, (9), (10).
  const forced_end_t end = mode_end(&c, &s, mode);
  if (end.turns) return turning_step(k, state, input, mode, report);
  // Balance, and commit.
  const outcome_t outcome = {mode, s.set, TF_OK,
                             end_delassus(&c, &in, signs, &end), false};
  return close_step(&c, state, input, &end, outcome, report);
}
