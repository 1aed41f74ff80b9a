/// @file
/// The number type of a build, and what a build must promise about it.
/// Equal bits on every target need three things from the compiler: each
/// operation is rounded once to tf_real_t, none is contracted into a fused
/// multiply-add, and none is reordered or left out. Foreign build systems set
/// none of their flags for this, and most compile in gnu mode, where gcc
/// contracts; so it is forbidden here, for the rest of the translation unit: a
/// program that computes the inputs of a step keeps its bits too. What cannot
/// be forbidden is refused where a macro shows it. No macro shows an
/// explicit -ffp-contract=fast, -freciprocal-math or -fno-signed-zeros of
/// clang: these must not be given (docs/PORTS.md).
#ifndef TWOFOLD_REAL_H
#define TWOFOLD_REAL_H

#include <float.h>

#if defined(__clang__) && __clang_major__ >= 13
#pragma clang fp contract(off) reassociate(off)
#elif defined(__clang__)
#pragma clang fp contract(off)
#elif defined(__GNUC__) && __STDC_HOSTED__
#pragma GCC optimize("fp-contract=off")
#elif defined(__GNUC__)
// -ffreestanding implies the second, and the pragma would forget it.
#pragma GCC optimize("fp-contract=off", "no-tree-loop-distribute-patterns")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#else
#pragma STDC FP_CONTRACT OFF
#endif

// 16: half precision has its own operations, float and double are as with 0.
#if defined(__FLT_EVAL_METHOD__)
#if __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "twofold needs FLT_EVAL_METHOD 0 (on x86: -msse2 -mfpmath=sse)"
#endif
#elif defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "twofold needs FLT_EVAL_METHOD 0"
#endif
#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "twofold must not be compiled with -Ofast, -ffast-math or /fp:fast"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) ||                                  \
    defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0
#error "twofold must not be compiled with a part of -ffast-math"
#endif
// Defined by every <float.h>; a checker that reads none has nothing to refuse.
#ifdef FLT_RADIX
#if FLT_RADIX != 2 || FLT_MANT_DIG != 24
#error "twofold needs the float of IEEE 754"
#endif
#if !defined(TF_REAL_FLOAT) && DBL_MANT_DIG != 53
#error "the double of this target is no IEEE double: define TF_REAL_FLOAT"
#endif
#endif
/// A constant is of the type that it is written in; -fsingle-precision-constant
/// would make each a float.
typedef char
    tf_constants_keep_their_type[sizeof(1.0) == sizeof(double) ? 1 : -1];

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
/// them. TF_API_DATA declares a table; C++ has no declaration of a local one.
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
