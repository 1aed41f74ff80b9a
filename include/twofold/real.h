/// @file
/// The number type of a build, and what a build must promise about it.
/// Equal bits on every target need three things from the compiler: each
/// operation is rounded once to tf_real_t (FLT_EVAL_METHOD is 0), none is
/// contracted into a fused multiply-add (-ffp-contract=off), and none is
/// reordered (never -ffast-math). A build that breaks the first or the last is
/// refused here; for the second there is no macro, so the Makefile sets it and
/// the golden trajectory hashes fail without it.
#ifndef TWOFOLD_REAL_H
#define TWOFOLD_REAL_H

#include <float.h>

#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "twofold needs FLT_EVAL_METHOD 0 (on x86: -mfpmath=sse)"
#endif
#if defined(__FAST_MATH__)
#error "twofold must not be compiled with -ffast-math"
#endif

/// TF_REAL_FLOAT selects float; without it the build is double. Every public
/// function carries the choice in its link name, so a program compiled for one
/// cannot be linked against a library compiled for the other.
#ifdef TF_REAL_FLOAT
typedef float tf_real_t;
#define TF_R(literal) literal##f
#define TF_LINK(name) name##_f32
#define TF_REAL_EPSILON FLT_EPSILON
#define TF_REAL_MIN FLT_MIN
#define TF_REAL_MAX FLT_MAX
#else
typedef double tf_real_t;
#define TF_R(literal) literal
#define TF_LINK(name) name##_f64
#define TF_REAL_EPSILON DBL_EPSILON
#define TF_REAL_MIN DBL_MIN
#define TF_REAL_MAX DBL_MAX
#endif

/// Linkage of the core. A build for one scene includes the sources into one
/// translation unit with TF_API_STATIC defined: all functions are local to it
/// then, so that the compiler can propagate the constants of the scene through
/// them. TF_API_DATA declares a table.
#ifdef TF_API_STATIC
#define TF_API static __attribute__((unused))
#define TF_API_DATA TF_API
#else
#define TF_API
#define TF_API_DATA extern
#endif

#endif
