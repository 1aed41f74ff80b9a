// The end of a step whose balance of energy is checked, in the form that
// creates no energy where it does; see balanced.c.
#ifndef TF_BALANCED_H
#define TF_BALANCED_H

#include "balance.h"
#include "stages.h"

// Balance. Whether the end of a step is to be checked by tf_checked_end().
TF_INLINE bool needs_check(const tf_machine_t *k, const tf_state_t *state,
                           const tf_input_t *input, const step_end_t *to) {
  const end_state_t from = {state->r, state->v, state->w};
  const balance_t b =
      balance_of(k, is_midpoint(k), input, from, to->end.at, to->end.force.F);
  return !is_balanced(&b) || ends_slip(state->mode, to->outcome.mode);
}

// The end of such a step: in the form that creates no energy where it does,
// and not TF_OK where the step is too long for the motion.
#define tf_checked_end TF_LINK(tf_checked_end)
TF_API step_end_t tf_checked_end(const tf_machine_t *k, const tf_state_t *state,
                                 const tf_input_t *input, step_end_t to);

// The form that creates no energy: its end, the force of the step, and the slip
// that the end has. mode, force: what the linear step ends with.
typedef struct {
  end_state_t at;
  tf_force_t force;
  unsigned mode;
  tf_real_t delassus;
} balanced_end_t;

#define tf_balanced_end TF_LINK(tf_balanced_end)
TF_API balanced_end_t tf_balanced_end(const tf_machine_t *k,
                                      const tf_state_t *state,
                                      const tf_input_t *input, unsigned mode,
                                      tf_force_t force);

#endif
