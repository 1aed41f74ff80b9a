// One step of the Moreau-Jean theta scheme, from its start to its end, stage by
// stage. tf_step and tf_step_compensated differ in what they start with and in
// how they store the end.
#ifndef TF_SCHEME_H
#define TF_SCHEME_H

#include "balance.h"
#include "stages.h"

// Validation.
TF_INLINE bool may_step(const tf_state_t *state, const tf_input_t *input) {
  return state->mode < TF_MODES && in_range(state, input);
}

// Balance. Whether the end of a step is to be checked by tf_checked_end().
TF_INLINE bool needs_check(const tf_machine_t *k, const tf_state_t *state,
                           const tf_input_t *input, const step_end_t *to) {
  const end_state_t from = {state->r, state->v, state->w};
  const balance_t b =
      balance_of(k, is_midpoint(k), input, from, to->end.at, to->end.force.F);
  return !is_balanced(&b) || ends_slip(state->mode, to->outcome.mode);
}

// How a step ends. All but END_COMMON are rare and left to tf_rare_end. As that
// begins the step anew, the common one keeps its registers, and their stacks do
// not add.
typedef enum {
  END_COMMON,
  END_SINGLE_VALUED, // the law has no solution set
  END_TOO_LONG,      // it is refused
  END_CODIM2,        // at h = g = 0, or near it with the mode lost
  END_NO_MODE,       // no mode is consistent, or none that a slip may enter
  END_TURNING,       // a slip whose force turns within the step
  END_TO_CHECK       // the balance of energy is to be checked
} end_kind_t;

// The end of a step, complete where it is a common one.
static inline __attribute__((always_inline)) end_kind_t end_of_step(
    const tf_machine_t *k, const tf_state_t *state, const tf_input_t *input,
    start_t start, free_motion_t *c, inclusion_t *in, solutions_t *s,
    unsigned *signs, step_end_t *to) {
  if (!tf_tyre_is_set_valued(k->tyre.law)) return END_SINGLE_VALUED;
  // Free motion, (1)-(7).
  *c = free_motion(k, state, input, start);
  if (!c->linear.definite) return END_TOO_LONG;
  // Inclusion, (8), and every mode that solves it.
  *signs = solve_inclusion(c, in, s);
  // Choose. Without a moment g = 0 is no border.
  if (k->stick_kappa > 0 && is_near_codim2(c, in, *signs, s->set))
    return END_CODIM2;
  const unsigned mode = choose_mode(k, state, s);
  if (mode == TF_NO_MODE) return END_NO_MODE;
  // End in the mode, (9), (10).
  to->end = mode_end(c, s, mode);
  to->outcome = (outcome_t){.mode = mode, .set = s->set, .status = TF_OK};
  if (to->end.reverses | to->end.turns) return END_TURNING;
  to->outcome.delassus = end_delassus(c, in, *signs, &to->end);
  // Balance.
  return needs_check(k, state, input, to) ? END_TO_CHECK : END_COMMON;
}

// The same for who leaves a rare one to tf_rare_end: whether it is common.
TF_INLINE bool common_end(const tf_machine_t *k, const tf_state_t *state,
                          const tf_input_t *input, start_t start,
                          step_end_t *to) {
  free_motion_t c;
  inclusion_t in;
  solutions_t s;
  unsigned signs;
  return end_of_step(k, state, input, start, &c, &in, &s, &signs, to) ==
         END_COMMON;
}

#endif
