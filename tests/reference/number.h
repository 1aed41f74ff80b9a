/// The reference's number, by its bits: long double, which needs no library but
/// libm. Laws without a jump (tools/study/finer.c) take float and double, too,
/// 24 and 53, and with -DREF_BITS=113 quadruple precision by gcc and
/// libquadmath. The prototypes stand here instead of quadmath.h, which belongs
/// to gcc, so that every static analyser can read these files.
#ifndef REFERENCE_NUMBER_H
#define REFERENCE_NUMBER_H

#include <float.h>
#include <math.h>
#include <stddef.h>

#ifndef REF_BITS
#define REF_BITS 64
#endif

#if REF_BITS == 24
typedef float ref_real_t;

#define REF_FN(name) name##f
#define REF_NUMBER(decimal) decimal##F
#define REF_EPSILON FLT_EPSILON
#elif REF_BITS == 53
typedef double ref_real_t;

#define REF_FN(name) name
#define REF_NUMBER(decimal) decimal
#define REF_EPSILON DBL_EPSILON
#elif REF_BITS == 113
__extension__ typedef __float128 ref_real_t;

ref_real_t fabsq(ref_real_t x);
ref_real_t sqrtq(ref_real_t x);
ref_real_t hypotq(ref_real_t x, ref_real_t y);
ref_real_t sinq(ref_real_t x);
ref_real_t cosq(ref_real_t x);
ref_real_t tanq(ref_real_t x);
ref_real_t tanhq(ref_real_t x);
ref_real_t atan2q(ref_real_t y, ref_real_t x);
ref_real_t powq(ref_real_t x, ref_real_t y);

#define REF_FN(name) name##q
#define REF_NUMBER(decimal) (__extension__ decimal##Q)
#define REF_EPSILON ((ref_real_t)0x1p-112L)
#else
typedef long double ref_real_t;

#define REF_FN(name) name##l
#define REF_NUMBER(decimal) decimal##L
#define REF_EPSILON LDBL_EPSILON
#endif

static inline ref_real_t ref_abs(ref_real_t x) { return REF_FN(fabs)(x); }
static inline ref_real_t ref_sqrt(ref_real_t x) { return REF_FN(sqrt)(x); }
static inline ref_real_t ref_sin(ref_real_t x) { return REF_FN(sin)(x); }
static inline ref_real_t ref_cos(ref_real_t x) { return REF_FN(cos)(x); }
static inline ref_real_t ref_tan(ref_real_t x) { return REF_FN(tan)(x); }
static inline ref_real_t ref_hypot(ref_real_t x, ref_real_t y) {
  return REF_FN(hypot)(x, y);
}
static inline ref_real_t ref_atan2(ref_real_t y, ref_real_t x) {
  return REF_FN(atan2)(y, x);
}
static inline ref_real_t ref_pow(ref_real_t x, ref_real_t y) {
  return REF_FN(pow)(x, y);
}

static inline ref_real_t ref_larger(ref_real_t a, ref_real_t b) {
  return a > b ? a : b;
}
static inline ref_real_t ref_smaller(ref_real_t a, ref_real_t b) {
  return a < b ? a : b;
}
static inline int ref_sign(ref_real_t x) { return x < 0 ? -1 : 1; }

/// pi to 38 digits: its long double and what that leaves.
#define REF_PI                           \
  ((ref_real_t)3.14159265358979323851L - \
   (ref_real_t)5.01655761266833202355733e-20L)

#endif
