/// @file
/// Every code that the core returns, and whether this machine computes as the
/// core assumes.
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

/// What a setting of compiler or processor does to the bits of a step.
typedef enum {
  TF_ARITHMETIC_OK = 0,
  TF_ARITHMETIC_ROUNDING,  ///< another rounding mode than to nearest is set
  TF_ARITHMETIC_SUBNORMAL, ///< subnormal numbers count as 0
  TF_ARITHMETIC_FUSED,     ///< a b - c is not rounded after the product
  TF_ARITHMETIC_REORDERED, ///< (a + b) - b is taken for a
  TF_ARITHMETIC_QUOTIENT,  ///< a/b is not rounded correctly: it is a (1/b)
  TF_ARITHMETIC_ROOT,      ///< nor is sqrt
  TF_ARITHMETIC_ZERO,      ///< the sign of 0 is lost
  TF_ARITHMETICS
} tf_arithmetic_t;

/// Tries the arithmetic as the core is compiled, in the calling thread. A
/// program does that before its first step; no other function does.
/// Returns: TF_ARITHMETIC_OK, or the first that does not hold.
/// Trust: the flags of the file that contains it, src/num/status.c, are those
///   of all others of the core.
#define tf_arithmetic TF_LINK(tf_arithmetic)
TF_API tf_arithmetic_t tf_arithmetic(void);

/// What is wrong, and what mends it.
#define tf_arithmetic_name TF_LINK(tf_arithmetic_name)
TF_API const char *tf_arithmetic_name(tf_arithmetic_t arithmetic);

TF_END_C

#endif
