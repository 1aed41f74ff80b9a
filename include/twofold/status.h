/// @file
/// Every code that the core returns, and whether this machine computes as the
/// core assumes.
#ifndef TWOFOLD_STATUS_H
#define TWOFOLD_STATUS_H

#include "twofold/real.h"

TF_BEGIN_C

/// Zero is success. Positive: the step was taken, with a reservation. Negative:
/// it was refused, and the state is untouched; each function says what else it
/// writes then.
typedef enum {
  TF_OK = 0,
  TF_DEGRADED = 1,  ///< no mode was consistent, or none that a slip may
                    ///< enter, and the smallest violation was taken; or h
                    ///< and g do not have the signs of the mode
  TF_FELL_BACK = 2, ///< tf_step took a whole located step, with TF_OK
  TF_COARSE = 3,    ///< the step is too long for the motion (causes: step.h),
                    ///< or tf_step_located missed its tolerance (located.h)
  TF_STALLED = 4,   ///< rounding loses the motion in this step, and in the
                    ///< next ones
  TF_BAD_PARAMETER = -1, ///< a parameter or option is out of its range
  TF_BAD_STATE = -2,     ///< state or input not finite or out of its range
  TF_DIVERGED = -3,      ///< the next state would leave the range of states
  TF_STEP_TOO_LONG = -4  ///< r moves so far in one step that the effective
                         ///< mass of the linearly implicit step is <= 0
} tf_status_t;

/// A code in words.
#define tf_status_name TF_LINK(tf_status_name)
TF_API const char *tf_status_name(tf_status_t status);

/// What a setting of compiler or processor does to the bits of a step. The
/// options are listed in docs/PORTS.md.
typedef enum {
  TF_ARITHMETIC_OK = 0,
  TF_ARITHMETIC_ROUNDING,  ///< the rounding mode is not to nearest
  TF_ARITHMETIC_SUBNORMAL, ///< subnormal numbers count as 0
  TF_ARITHMETIC_FUSED,     ///< a b - c is not rounded after the product
  TF_ARITHMETIC_REORDERED, ///< (a + b) - b is simplified to a
  TF_ARITHMETIC_QUOTIENT,  ///< a/b is not rounded correctly: it is a (1/b)
  TF_ARITHMETIC_ROOT,      ///< sqrt is not rounded correctly
  TF_ARITHMETIC_ZERO,      ///< the sign of 0 is lost
  TF_ARITHMETICS
} tf_arithmetic_t;

/// Tests the arithmetic of the core in the calling thread. Call it once before
/// the first step: no other function tests it.
/// Returns: TF_ARITHMETIC_OK, or the first fault found.
/// Trust: it sees the flags with which src/num/status.c is compiled; compile
///   all files of the core alike.
#define tf_arithmetic TF_LINK(tf_arithmetic)
TF_API tf_arithmetic_t tf_arithmetic(void);

/// A fault in words, and its remedy.
#define tf_arithmetic_name TF_LINK(tf_arithmetic_name)
TF_API const char *tf_arithmetic_name(tf_arithmetic_t arithmetic);

TF_END_C

#endif
