// The oracle's number: quadruple precision, 113 bits, by gcc and libquadmath.
// The prototypes stand here instead of quadmath.h, which belongs to gcc alone,
// so that every static analyser can read these files.
#ifndef ORACLE_NUMBER_H
#define ORACLE_NUMBER_H

#include <stddef.h>

__extension__ typedef __float128 real;

real fabsq(real x);
real sqrtq(real x);
real sinq(real x);
real cosq(real x);
real tanq(real x);
real atan2q(real y, real x);
real expq(real x);
real logq(real x);
real powq(real x, real y);
real strtoflt128(const char *text, char **end);
int quadmath_snprintf(char *text, size_t size, const char *format, ...);

#define PI_TEXT "3.14159265358979323846264338327950288419717"

static inline real bigger(real a, real b) { return a > b ? a : b; }
static inline real lesser(real a, real b) { return a < b ? a : b; }

#endif
