// Elementary functions that tf_prepare needs: see kernel.h for the claims.
#include "kernel.h"

// Horner's rule in x^2, with Taylor coefficients: the first term left out is
// below 1e-18 of the first one on the reduced range |x| <= pi/4.
static tf_real_t polynomial(const tf_real_t *c, int terms, tf_real_t x2) {
  tf_real_t sum = c[terms - 1];
  for (int n = terms - 2; n >= 0; n--) sum = sum * x2 + c[n];
  return sum;
}

// pi/2 in two parts: n HIGH is exact for |n| <= 2, x - n HIGH is exact because
// the two agree in their leading bits, and LOW holds the digits of pi that the
// real type cannot. So cos of the number nearest pi/2 is right (6e-17 in
// double), not 0. Both parts are positive, so that -0 stays -0.
#ifdef TF_REAL_FLOAT
#define HALF_PI_HIGH 0x1.921fb4p+0f
#define HALF_PI_LOW 0x1.4442d2p-24f
#else
#define HALF_PI_HIGH 0x1.921fb54442d18p+0
#define HALF_PI_LOW 0x1.1a62633145c07p-54
#endif

TF_API void tf_sine_cosine(tf_real_t x, tf_real_t *sine, tf_real_t *cosine) {
  static const tf_real_t sin_c[] = {TF_R(1.0),
                                    TF_R(-1.0) / 6,
                                    TF_R(1.0) / 120,
                                    TF_R(-1.0) / 5040,
                                    TF_R(1.0) / 362880,
                                    TF_R(-1.0) / TF_R(39916800.0),
                                    TF_R(1.0) / TF_R(6227020800.0),
                                    TF_R(-1.0) / TF_R(1307674368000.0),
                                    TF_R(1.0) / TF_R(355687428096000.0)};
  static const tf_real_t cos_c[] = {TF_R(1.0),
                                    TF_R(-0.5),
                                    TF_R(1.0) / 24,
                                    TF_R(-1.0) / 720,
                                    TF_R(1.0) / 40320,
                                    TF_R(-1.0) / 3628800,
                                    TF_R(1.0) / TF_R(479001600.0),
                                    TF_R(-1.0) / TF_R(87178291200.0),
                                    TF_R(1.0) / TF_R(20922789888000.0)};
  const tf_real_t quarter_turns = x * TF_R(0.63661977236758134308);
  const int turns =
      (int)(quarter_turns + (quarter_turns < 0 ? TF_R(-0.5) : TF_R(0.5)));
  const tf_real_t y =
      (x - (tf_real_t)turns * HALF_PI_HIGH) - (tf_real_t)turns * HALF_PI_LOW;
  const tf_real_t s = y * polynomial(sin_c, 9, y * y);
  const tf_real_t c = polynomial(cos_c, 9, y * y);
  const int quadrant = turns & 3;
  const tf_real_t sin_x = (quadrant & 1) ? c : s;
  const tf_real_t cos_x = (quadrant & 1) ? s : c;
  *sine = (quadrant & 2) ? -sin_x : sin_x;
  *cosine = (quadrant == 1 || quadrant == 2) ? -cos_x : cos_x;
}

TF_API tf_real_t tf_small_arctangent(tf_real_t t) {
  static const tf_real_t c[] = {
      TF_R(1.0),      TF_R(-1.0) / 3,  TF_R(1.0) / 5,
      TF_R(-1.0) / 7, TF_R(1.0) / 9,   TF_R(-1.0) / 11,
      TF_R(1.0) / 13, TF_R(-1.0) / 15, TF_R(1.0) / 17};
  return t * polynomial(c, 9, t * t);
}

// 1 - exp(-2x) = e (2 - e) with e = 1 - exp(-x): no cancellation at small x,
// ten doublings from x/1024, where six terms of the series are enough.
TF_API tf_real_t tf_exit_probability(tf_real_t x) {
  if (!(x < 40)) return 1;
  const tf_real_t y = x * TF_R(0.0009765625);
  tf_real_t e =
      y * (1 - y / 2 * (1 - y / 3 * (1 - y / 4 * (1 - y / 5 * (1 - y / 6)))));
  for (int n = 0; n < 10; n++) e = e * (2 - e);
  return e;
}
