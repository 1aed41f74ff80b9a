// The end of a step at h = g = 0, or near it with the mode lost.
#ifndef TF_CODIM2_END_H
#define TF_CODIM2_END_H

#include "stages.h"

// s: what solves the inclusion, whatever the sign of g at the end. False where
// no mode is admissible.
#define tf_codim2_end TF_LINK(tf_codim2_end)
TF_API bool tf_codim2_end(const free_motion_t *c, const tf_input_t *input,
                          const inclusion_t *in, const solutions_t *s,
                          step_end_t *out);

#endif
