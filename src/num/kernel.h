// Elementary functions of the core, because the bits of libm differ from target
// to target. A step uses only abs, sqrt and comparisons; the rest serves
// tf_prepare. The error bounds claimed here are tested by
// angle_kernel_error_bound, sine_kernel_error_bound and
// exit_probability_kernel.
#ifndef TF_KERNEL_H
#define TF_KERNEL_H

#include "rounding.h"
#include "twofold/real.h"

// The parts of a step are inlined into one function: passing their structs
// through memory would double its instructions. TF_RARE keeps out of it what a
// step hardly ever needs.
#define TF_INLINE static inline __attribute__((always_inline))
#define TF_RARE static __attribute__((noinline, cold))

// A compiler that has the instruction uses it; a soft-float target calls
// the C library's sqrt, which IEEE 754 requires to be correctly rounded, so
// both give the same bits.
TF_INLINE tf_real_t square_root(tf_real_t x) {
#ifdef TF_REAL_FLOAT
  return __builtin_sqrtf(x);
#else
  return __builtin_sqrt(x);
#endif
}

TF_INLINE tf_real_t magnitude(tf_real_t x) {
#ifdef TF_REAL_FLOAT
  return __builtin_fabsf(x);
#else
  return __builtin_fabs(x);
#endif
}

// False for NaN too: a comparison with NaN is false.
TF_INLINE bool within(tf_real_t x, tf_real_t limit) {
  return magnitude(x) <= limit;
}

// NaN becomes low: the comparisons are written so that it cannot pass.
TF_INLINE tf_real_t clip(tf_real_t x, tf_real_t low, tf_real_t high) {
  return x > low ? (x < high ? x : high) : low;
}

// 1/x, kept finite: below the smallest normal number x counts as 0.
TF_INLINE tf_real_t inverse_or_0(tf_real_t x) {
  return x >= TF_REAL_MIN ? 1 / x : 0;
}

// tan(x/2) from t = tan(x), 0 <= x <= pi/2. t up to 6e6: t t stays finite.
TF_INLINE tf_real_t half_tangent(tf_real_t t) {
  return t / (1 + square_root(1 + t * t));
}

// sin and cos for |x| <= 3.2, error <= 2 ULP each.
#define tf_sine_cosine TF_LINK(tf_sine_cosine)
TF_API void tf_sine_cosine(tf_real_t x, tf_real_t *sine, tf_real_t *cosine);

// atan for |t| <= 0.1, error <= 2 ULP.
#define tf_small_arctangent TF_LINK(tf_small_arctangent)
TF_API tf_real_t tf_small_arctangent(tf_real_t t);

// 1 - exp(-x), error <= 16 ULP for x >= 1024 of the least normal number.
#define tf_exit_probability TF_LINK(tf_exit_probability)
TF_API tf_real_t tf_exit_probability(tf_real_t x);

#endif
