// What Frama-C must know of the compiler: models of the built-in functions of
// gcc that src/ uses, put before every file by tools/verify/eva/eva.py, with
//   -D__builtin_sqrt=model_sqrt -eva-builtin model_sqrt:Frama_C_sqrt
// and so on. They are part of what the analysis trusts.
#ifndef TF_EVA_MODEL_H
#define TF_EVA_MODEL_H

// The analyser's own square root, rounded as IEEE 754 wants it, NaN below 0.
// Its C library's has a precondition there, which the built-in has not.
/*@ assigns \result \from x; */
extern double model_sqrt(double x);
/*@ assigns \result \from x; */
extern float model_sqrtf(float x);

// The magnitude but for the sign of 0 and NaN, of which nothing in src/ makes
// anything.
static inline double model_fabs(double x) { return x < 0 ? -x : x; }
static inline float model_fabsf(float x) { return x < 0 ? -x : x; }

#endif
