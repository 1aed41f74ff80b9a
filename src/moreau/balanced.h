// The step that creates no energy, for those that the linear one does not
// resolve; see balanced.c.
#ifndef TF_BALANCED_H
#define TF_BALANCED_H

#include "linear.h"

// Its end, the force of the step, and the slip that the end has.
typedef struct {
  end_state_t at;
  tf_force_t force;
  unsigned mode;
  tf_real_t delassus;
} balanced_end_t;

// mode, force: what the linear step ends with.
#define tf_balanced_end TF_LINK(tf_balanced_end)
TF_API balanced_end_t tf_balanced_end(const tf_machine_t *k,
                                      const tf_state_t *state,
                                      const tf_input_t *input, unsigned mode,
                                      tf_force_t force);

#endif
