/// @file
/// Every code that the core returns.
#ifndef TWOFOLD_STATUS_H
#define TWOFOLD_STATUS_H

#include "twofold/real.h"

TF_BEGIN_C

/// Zero is success; positive: the step was taken, with a reservation; negative:
/// refused, and the state is untouched. What else a function writes where it
/// refuses stands with the function.
typedef enum {
  TF_OK = 0,
  TF_DEGRADED = 1,  ///< no mode was consistent, or none that a slip may
                    ///< enter: smallest residual taken; or h and g do not
                    ///< end with the signs of the mode, but for rounding
  TF_FELL_BACK = 2, ///< tf_step_located left it to tf_step: TF_OK
  TF_COARSE = 3,    ///< too coarse: the step is too long for the motion;
                    ///< or tf_step_located missed its tolerance: it ran out
                    ///< of segments and left the rest to tf_step
  TF_STALLED = 4,   ///< the motion stalls: the step has lost the change of
                    ///< the state in its rounding, and so will the next
  TF_BAD_PARAMETER = -1, ///< a parameter or option is out of its range
  TF_BAD_STATE = -2,     ///< state or input not finite or out of its range
  TF_DIVERGED = -3,      ///< the next state would leave the range of states
  TF_STEP_TOO_LONG = -4  ///< r moves so far in one step that the effective
                         ///< mass of the linearly implicit step is <= 0
} tf_status_t;

/// A code in words.
#define tf_status_name TF_LINK(tf_status_name)
TF_API const char *tf_status_name(tf_status_t status);

TF_END_C

#endif
