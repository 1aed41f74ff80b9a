// The ends of a step that are rare, as functions of their own: with an end, or
// with a status below TF_OK where the step is refused.
#ifndef TF_RARE_END_H
#define TF_RARE_END_H

#include "balance.h"
#include "stages.h"

// The end of a rare step, judged by its balance of energy.
#define tf_rare_end TF_LINK(tf_rare_end)
TF_API step_end_t tf_rare_end(const tf_machine_t *k, const tf_state_t *state,
                              const tf_input_t *input, start_t start);

// At h = g = 0, or near it with the mode lost; see codim2_end.c.
#define tf_codim2_end TF_LINK(tf_codim2_end)
TF_API void tf_codim2_end(free_motion_t *c, inclusion_t *in, solutions_t *s,
                          step_end_t *to);

// A slip that ends in stick or rest within its step, and by that changes much:
// it ends where its course does. It is TF_COARSE where that is in no mode that
// solves the inclusion, or where no force of the law leads there.
#define tf_end_along_course TF_LINK(tf_end_along_course)
TF_API void tf_end_along_course(free_motion_t *c, inclusion_t *in,
                                const solutions_t *s, step_end_t *to);

// A slip that the limit at h -> 0 holds on its side, where the force of its
// angle does not: it ends where its course does, if that is in its mode.
#define tf_slip_along_course TF_LINK(tf_slip_along_course)
TF_API void tf_slip_along_course(free_motion_t *c, inclusion_t *in,
                                 const solutions_t *s, step_end_t *to);

// Where no mode is consistent, or none that a slip may enter: of all ends that
// the step may take, the one that violates the law least.
#define tf_least_violation TF_LINK(tf_least_violation)
TF_API void tf_least_violation(free_motion_t *c, inclusion_t *in,
                               const solutions_t *s, step_end_t *to);

// The end of a step whose balance of energy needs a check: in the form that
// creates no energy where it does, and not TF_OK where the step is too long for
// the motion.
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
