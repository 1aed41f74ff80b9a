// The number type of one build of this tool, and the few functions it needs:
// by the same series in float, double, x87's long double and binary128, so that
// builds differ in their rounding alone. binary128 is arithmetic of the
// compiler's run time; no library of functions is linked for it.
#ifndef FINER_REAL_H
#define FINER_REAL_H

#include <stdbool.h>

#ifndef FINER_BITS
#define FINER_BITS 53
#endif

// UNIT is half a unit in the last place of 1; TOLERANCE of a step is above what
// rounding makes of an extrapolated step, or no step would meet it.
#if FINER_BITS == 24
typedef float real_t;
#define REAL(x) x##F
#define COLUMNS 4
#define UNIT 0x1p-24F
#define TOLERANCE 0x1p-15F
#elif FINER_BITS == 53
typedef double real_t;
#define REAL(x) x
#define COLUMNS 6
#define UNIT 0x1p-53
#define TOLERANCE 0x1p-44
#elif FINER_BITS == 64
typedef long double real_t;
#define REAL(x) x##L
#define COLUMNS 7
#define UNIT 0x1p-64L
#define TOLERANCE 0x1p-55L
#elif FINER_BITS == 113
__extension__ typedef __float128 real_t;
#define REAL(x) ((real_t)(x##L))
#define COLUMNS 10
#define UNIT ((real_t)0x1p-113L)
#define TOLERANCE ((real_t)0x1p-92L)
#else
#error "FINER_BITS is 24, 53, 64 or 113"
#endif

static inline real_t absolute(real_t x) { return x < 0 ? -x : x; }

real_t root(real_t x); // of x >= 0
real_t exponential(real_t x);
real_t angle(real_t y, real_t x); // of the vector (x, y), x >= 0
real_t tangent(real_t x);         // |x| < pi/2

#endif
