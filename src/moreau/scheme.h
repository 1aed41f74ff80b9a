// One step of the Moreau-Jean theta scheme, from its start to its end, stage by
// stage. tf_step and tf_step_compensated differ in what they start with and in
// how they store the end.
#ifndef TF_SCHEME_H
#define TF_SCHEME_H

#include "balance.h"
#include "rare_end.h"
#include "stages.h"

// Validation.
TF_INLINE bool may_step(const tf_state_t *state, const tf_input_t *input) {
  return state->mode < TF_MODES && in_range(state, input);
}

TF_INLINE balance_t balance_of_end(const tf_machine_t *k,
                                   const tf_state_t *state,
                                   const tf_input_t *input,
                                   const step_end_t *to) {
  const end_state_t from = {state->r, state->v, state->w};
  return balance_of(k, is_midpoint(k), input, from, to->end.at,
                    to->end.force.F);
}

// The end of a step: complete where it is a common one. What its stages have
// found is in registers; the rest is left to tf_rare_end.
TF_INLINE end_kind_t end_of_step(const tf_machine_t *k, const tf_state_t *state,
                                 const tf_input_t *input, start_t start,
                                 step_end_t *to) {
  if (!tf_tyre_is_set_valued(k->contact.tyre.law)) return END_SINGLE_VALUED;
  // Without a moment g = 0 is no border.
  const bool has_border = k->contact.stick_kappa > 0;
  if (has_border && state->mode == TF_PINNED) return END_CODIM2;
  // Free motion, (1)-(7).
  free_motion_t c = free_motion(k, state, input, start);
  if (!c.linear.definite) return END_TOO_LONG;
  // Inclusion, (8), and every mode that solves it.
  inclusion_t in;
  tf_contact_modes_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  // Choose.
  if (has_border && is_near_codim2(&c, &in, signs, s.set)) return END_CODIM2;
  const unsigned mode = choose_mode(k, state, &s);
  to->outcome = (outcome_t){.mode = mode, .set = s.set, .status = TF_OK};
  if (mode == TF_NO_MODE) return END_NO_MODE;
  // End in the mode, (9), (10).
  to->end = mode_end(&c, &s, mode, false);
  if (to->end.reverses | to->end.turns)
    return to->end.reverses ? END_REVERSED
           : to->end.held   ? END_HELD
                            : END_TURNING;
  to->outcome.delassus = end_delassus(&c, &in, signs, &to->end);
  // Balance.
  const balance_t b = balance_of_end(k, state, input, to);
  return !is_balanced(&b) || ends_slip(state->mode, mode) ? END_TO_CHECK
                                                          : END_COMMON;
}

#endif
