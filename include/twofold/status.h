/// @file
/// Every code that the core returns.
#ifndef TWOFOLD_STATUS_H
#define TWOFOLD_STATUS_H

#include "twofold/real.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Zero is success; positive: the step was taken, with a reservation; negative:
/// refused, and the state is untouched. What else a function writes where it
/// refuses stands with the function.
typedef enum {
  TF_OK = 0,
  TF_DEGRADED = 1,       ///< no mode was consistent, or none that a slip may
                         ///< enter: smallest residual taken; or h and g do not
                         ///< end with the signs of the mode, but for rounding
  TF_FELL_BACK = 2,      ///< tf_step_located took the step by tf_step, which
                         ///< says TF_OK
  TF_COARSE = 3,         ///< advanced, but too coarsely: tf_step_located ran
                         ///< out of segments and took the rest of the step by
                         ///< tf_step; or the step is too long for the motion
                         ///< (tf_step); or a step has lost the change of the
                         ///< state in its rounding, and so will the next ones:
                         ///< the motion stands still
  TF_BAD_PARAMETER = -1, ///< a parameter or option is out of its range
  TF_BAD_STATE = -2,     ///< state or input not finite or out of its range
  TF_DIVERGED = -3,      ///< the next state would leave the range of states
  TF_STEP_TOO_LONG = -4  ///< r moves so far in one step that the effective
                         ///< mass of the linearly implicit step is <= 0
} tf_status_t;

/// Name of a code, in words.
/// Scheme: none.
/// status: in, any value.
/// Returns: a constant string, never NULL; "unknown status" for other values.
/// Cost: one look-up in a table. Stack: 16 B.
/// Memory: static storage, reentrant.
/// Claims: status_names_are_distinct
#define tf_status_name TF_LINK(tf_status_name)
TF_API const char *tf_status_name(tf_status_t status);

#ifdef __cplusplus
}
#endif

#endif
