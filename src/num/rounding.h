// One rounding per operation: the compiler fuses no multiply-add, whatever the
// flags of the build. Foreign build systems set no flag for this, and gcc fuses
// in gnu mode, their default. Every source of the core that computes includes
// this before its first function, mostly through kernel.h. No public header
// does, so that a user's code keeps its own options. A file with all of the
// core includes this before the public headers: an old gcc inlines no function
// without the pragma into one with it.
#ifndef TF_ROUNDING_H
#define TF_ROUNDING_H

#if defined(__clang__) && __clang_major__ >= 13
#pragma clang fp contract(off) reassociate(off)
#elif defined(__clang__)
#pragma clang fp contract(off)
#elif defined(__GNUC__) && __STDC_HOSTED__
#pragma GCC optimize("fp-contract=off")
#elif defined(__GNUC__)
// -ffreestanding implies the second option, which the pragma would reset.
#pragma GCC optimize("fp-contract=off", "no-tree-loop-distribute-patterns")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#else
#pragma STDC FP_CONTRACT OFF
// For a compiler without built-ins, such as tcc. The core calls
// __builtin_signbit with 0 only.
#define __builtin_signbit(zero) (1 / (zero) < 0)
#define __builtin_sqrt sqrt
#define __builtin_sqrtf sqrtf
#define __builtin_fabs fabs
#define __builtin_fabsf fabsf
double sqrt(double x);
float sqrtf(float x);
double fabs(double x);
float fabsf(float x);
#endif

#endif
