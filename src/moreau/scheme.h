// One step of the Moreau-Jean theta scheme, from its start to its end, stage by
// stage. tf_step and tf_step_compensated differ in what they start with and in
// how they store the end.
#ifndef TF_SCHEME_H
#define TF_SCHEME_H

#include "balanced.h"
#include "rare_end.h"

// Validation.
TF_INLINE bool may_step(const tf_state_t *state, const tf_input_t *input) {
  return state->mode < TF_MODES && in_range(state, input);
}

// The end of a step. False where it is a rare one: that is left to tf_rare_end,
// which is this function with `rare` set. As it begins the step anew, the
// common one keeps its registers, and their stacks do not add.
TF_INLINE bool end_of_step(const tf_machine_t *k, const tf_state_t *state,
                           const tf_input_t *input, start_t start, bool rare,
                           step_end_t *to) {
  if (!tf_tyre_is_set_valued(k->tyre.law)) {
    if (rare) tf_single_valued_end(k, state, input, start, to);
    return rare;
  }
  // Free motion, (1)-(7).
  free_motion_t c = free_motion(k, state, input, start);
  if (!c.linear.definite) {
    if (rare) refuse_end(to);
    return rare;
  }
  // Inclusion, (8), and every mode that solves it.
  inclusion_t in;
  solutions_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  // Choose. Without a moment g = 0 is no border.
  if (k->stick_kappa > 0 && is_near_codim2(&c, &in, signs, s.set)) {
    if (rare) tf_codim2_end(&c, input, &in, &s, to);
    return rare;
  }
  const unsigned mode = choose_mode(k, state, &s);
  if (mode == TF_NO_MODE) {
    if (rare) tf_least_violation(&c, &in, &s, to);
    return rare;
  }
  // End in the mode, (9), (10).
  to->end = mode_end(&c, &s, mode);
  to->outcome = (outcome_t){.mode = mode, .set = s.set, .status = TF_OK};
  if (to->end.reverses | to->end.swings) {
    if (!rare) return false;
    end_swinging(&c, &in, &s, to);
  }
  if (rare && ends_slip(state->mode, mode) && swings_much(&c, &in, to))
    to->outcome.status = TF_COARSE;
  to->outcome.delassus = end_delassus(&c, &in, signs, &to->end);
  // Balance.
  return rare || !needs_check(k, state, input, to);
}

// The end of a rare step, judged by its balance of energy. Its status is below
// TF_OK where the step is refused.
#define tf_rare_end TF_LINK(tf_rare_end)
TF_API step_end_t tf_rare_end(const tf_machine_t *k, const tf_state_t *state,
                              const tf_input_t *input, start_t start);

#endif
