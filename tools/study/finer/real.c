// Square root by Newton's method, the others by Taylor series of an argument
// that is halved until the series is short.
#include "real.h"

#include <math.h>

#define SHORT REAL(0.1)

// One round of Newton doubles the digits of the C library's root: two are
// enough for 113 bits.
real_t root(real_t x) {
  if (x <= 0) return 0;
  real_t y = (real_t)sqrt((double)x);
  for (int n = 0; n < 2; n++) y = (y + x / y) / 2;
  return y;
}

real_t exponential(real_t x) {
  if (x < -80) return 0;
  int halved = 0;
  for (; absolute(x) > SHORT; halved++) x /= 2;
  real_t term = x, sum = x; // exp(x) - 1, which doubles as s (s + 2)
  for (int n = 2; absolute(term) > UNIT * absolute(x) / 4; n++) {
    term *= x / (real_t)n;
    sum += term;
  }
  for (; halved > 0; halved--) sum *= sum + 2;
  return sum + 1;
}

real_t angle(real_t y, real_t x) {
  const real_t length = root(x * x + y * y);
  if (length <= 0) return 0;
  real_t t = y / (x + length), scale = 2;
  for (; absolute(t) > SHORT; scale *= 2) t /= 1 + root(1 + t * t);
  const real_t square = t * t;
  real_t power = t, sum = t;
  for (int n = 3; absolute(power) > UNIT * absolute(t) / 4; n += 2) {
    power *= -square;
    sum += power / (real_t)n;
  }
  return scale * sum;
}

real_t tangent(real_t x) {
  int halved = 0;
  for (; absolute(x) > SHORT; halved++) x /= 2;
  const real_t square = x * x;
  real_t term = 1, sine = 1, cosine = 1;
  for (int n = 1; absolute(term) > UNIT / 4; n++) {
    term *= -square / (real_t)(2 * n);
    cosine += term;
    term /= (real_t)(2 * n + 1);
    sine += term;
  }
  real_t t = x * sine / cosine;
  for (; halved > 0; halved--) t = 2 * t / (1 - t * t);
  return t;
}
