/// @file
/// The number type of a build. Every target computes the same bits if each
/// operation is rounded once to tf_real_t: none is fused, reordered or omitted.
/// - This header refuses options that break that and define a macro.
/// - The core forbids fused operations in its own files (src/num/rounding.h).
///   Compile your program with -ffp-contract=off if its inputs must have the
///   same bits, too.
/// - tf_arithmetic (status.h) finds what no macro shows: -ffp-contract=fast,
///   -freciprocal-math and -fno-signed-zeros of clang, and rounding modes.
#ifndef TWOFOLD_REAL_H
#define TWOFOLD_REAL_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// 16: as 0 for float and double. 1: as 0 for double alone.
#if defined(__FLT_EVAL_METHOD__)
#define TF_EVALUATION __FLT_EVAL_METHOD__
#elif defined(FLT_EVAL_METHOD)
#define TF_EVALUATION FLT_EVAL_METHOD
#else
#define TF_EVALUATION 0
#endif
#if TF_EVALUATION == 1 && defined(TF_REAL_FLOAT)
#error "float needs FLT_EVAL_METHOD 0 (gcc on s390x: -fexcess-precision=fast)"
#elif defined(TF_REAL_FLOAT) && defined(__TINYC__) && __TINYC__ <= 927
#error "float needs tcc 0.9.28: this one mixes up results of functions"
#elif TF_EVALUATION != 0 && TF_EVALUATION != 1 && TF_EVALUATION != 16
#error "twofold needs FLT_EVAL_METHOD 0 (on x86: -msse2 -mfpmath=sse)"
#endif
#undef TF_EVALUATION
#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "twofold must not be compiled with -Ofast, -ffast-math or /fp:fast"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) ||                                  \
    defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0
#error "twofold must not be compiled with a part of -ffast-math"
#endif
#ifdef FLT_RADIX // in every <float.h>; some checkers read none
#if FLT_RADIX != 2 || FLT_MANT_DIG != 24
#error "twofold needs the float of IEEE 754"
#endif
#if !defined(TF_REAL_FLOAT) && DBL_MANT_DIG != 53
#error "the double of this target is no IEEE double: define TF_REAL_FLOAT"
#endif
#endif
/// Refuses -fsingle-precision-constant, which makes each constant a float.
typedef char
    tf_constants_keep_their_type[sizeof(1.0) == sizeof(double) ? 1 : -1];

/// TF_REAL_FLOAT selects float; without it the build is double. Every public
/// function carries the choice in its link name, so a program compiled for one
/// cannot be linked against a library compiled for the other.
#ifdef TF_REAL_FLOAT
typedef float tf_real_t;
#define TF_LINK(name) name##_f32
#define TF_REAL_EPSILON FLT_EPSILON
#define TF_REAL_MIN FLT_MIN
#define TF_REAL_MAX FLT_MAX
#else
typedef double tf_real_t;
#define TF_LINK(name) name##_f64
#define TF_REAL_EPSILON DBL_EPSILON
#define TF_REAL_MIN DBL_MIN
#define TF_REAL_MAX DBL_MAX
#endif
/// A constant of that type: TF_R(1e-3), TF_R(-1).
#define TF_R(number) ((tf_real_t)(number))

/// Declarations between the two have C linkage in C++.
#ifdef __cplusplus
#define TF_BEGIN_C extern "C" {
#define TF_END_C }
#else
#define TF_BEGIN_C
#define TF_END_C
#endif

/// Linkage of the core. A build for one scene is one translation unit that
/// defines TF_API_STATIC: all functions are local, and the compiler propagates
/// the constants of the scene through them. TF_API_DATA declares a table, which
/// C++ cannot declare as local.
#ifdef TF_API_STATIC
#define TF_API static __attribute__((unused))
#else
#define TF_API
#endif
#if defined(TF_API_STATIC) && !defined(__cplusplus)
#define TF_API_DATA TF_API
#else
#define TF_API_DATA extern
#endif

#endif
