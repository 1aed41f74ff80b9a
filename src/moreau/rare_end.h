// The ends of a step that are rare. A function of its own finds them, which
// begins the step anew, so that the common end keeps its registers.
#ifndef TF_RARE_END_H
#define TF_RARE_END_H

#include "stages.h"

// How a step ends.
typedef enum {
  END_IN_MODE,        // in a mode that solves the inclusion
  END_IN_DOUBT,       // so, but not beyond doubt: its balance of energy
  END_NEAR_CODIM2,    // h = g = 0 is within reach
  END_TURNING,        // a slip that turns within the step, see slip_end()
  END_LEAST_VIOLATED, // no mode is consistent, or none that a slip may enter
  END_SINGLE_VALUED,  // under a single-valued law
  END_TOO_LONG        // refused
} ending_t;

// ending: not END_IN_MODE. The status is below TF_OK where the step is refused.
#define tf_rare_end TF_LINK(tf_rare_end)
TF_API step_end_t tf_rare_end(const tf_machine_t *k, const tf_state_t *state,
                              const tf_input_t *input, start_t start,
                              ending_t ending);

#endif
