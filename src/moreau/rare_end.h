// The ends of a step that are rare, as functions of their own: with an end, or
// with a status below TF_OK where the step is refused.
#ifndef TF_RARE_END_H
#define TF_RARE_END_H

#include "balance.h"
#include "stages.h"

// The rest is written too: it is copied, though nobody asks for it.
TF_INLINE void refuse_end(step_end_t *to) {
  *to = (step_end_t){.outcome = {.status = TF_STEP_TOO_LONG}};
}

// (11), under a single-valued law.
#define tf_single_valued_end TF_LINK(tf_single_valued_end)
TF_API void tf_single_valued_end(const tf_machine_t *k, const tf_state_t *state,
                                 const tf_input_t *input, start_t start,
                                 step_end_t *to);

// At h = g = 0, or near it with the mode lost; see codim2_end.c.
#define tf_codim2_end TF_LINK(tf_codim2_end)
TF_API void tf_codim2_end(free_motion_t *c, const tf_input_t *input,
                          inclusion_t *in, solutions_t *s, step_end_t *to);

// Where no mode is consistent, or none that a slip may enter: of all ends that
// the step may take, the one that violates the law least.
#define tf_least_violation TF_LINK(tf_least_violation)
TF_API void tf_least_violation(free_motion_t *c, inclusion_t *in,
                               const solutions_t *s, step_end_t *to);

// A slip that turns within the step, see slip_end(), and ends in a stick where
// it can. It is not TF_OK where a blow turns it and it is kept.
TF_INLINE void end_turning(const free_motion_t *c, const solutions_t *s,
                           step_end_t *to) {
  const tf_state_t *x = c->state;
  const unsigned slip = to->outcome.mode, mode = mode_instead(s, slip);
  to->end = mode_end(c, s, mode);
  to->outcome.mode = mode;
  if (mode == slip &&
      is_blow(TF_API_MACHINE(c), (end_state_t){x->r, x->v, x->w}, to->end.at))
    to->outcome.status = TF_COARSE;
}

#endif
