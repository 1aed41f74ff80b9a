/* Sums of two numbers: which transformations are exact, against whole numbers
 * of 64 bits and the fused multiply-add, and what the others may be off by. */
#include <stdint.h>

#include "num/pair.h"
#include "sample.h"

#define DIGITS (sizeof(tf_real_t) == 8 ? 53 : 24)

/* A whole number of all digits. */
static int64_t whole(void) {
  const int64_t n = (int64_t)(tap_bits() >> (64 - DIGITS));
  return tap_bits() & 1 ? -n : n;
}

static int64_t whole_of(pair_t a) { return (int64_t)a.hi + (int64_t)a.lo; }

TEST(sums_are_exact) {
  for (int n = 0; n < samples(100000); n++) {
    const int64_t a = whole(), b = whole(), scale = (int64_t)1 << n % 9;
    const tf_real_t x = (tf_real_t)(a * scale), y = (tf_real_t)b;
    const pair_t s = two_sum(x, y), t = two_sum(y, x);
    CHECK(whole_of(s) == a * scale + b);
    CHECK(s.hi == x + y && t.hi == s.hi && t.lo == s.lo);
    const pair_t f =
        magnitude(x) < magnitude(y) ? fast_two_sum(y, x) : fast_two_sum(x, y);
    CHECK(f.hi == s.hi && f.lo == s.lo);
    const pair_t loose = {y, x}, tidied = pair_normalized(loose);
    CHECK(tidied.hi == s.hi && tidied.lo == s.lo);
    CHECK(whole_of(pair_negative(s)) == -a * scale - b);
  }
}

TEST(products_are_exact) {
  for (int n = 0; n < samples(100000); n++) {
    const int64_t a = whole(), b = whole();
    const tf_real_t x = (tf_real_t)a, y = (tf_real_t)b;
    const pair_t xy = two_product(x, y), parts = veltkamp_split(x);
    CHECK(xy.hi == x * y);
    CHECK(xy.lo == (sizeof x == 8
                        ? (tf_real_t)fma((double)x, (double)y, -(double)xy.hi)
                        : (tf_real_t)((double)x * (double)y - (double)xy.hi)));
    CHECK(whole_of(parts) == a);
    CHECK(parts.hi * parts.hi == wide(parts.hi) * wide(parts.hi));
    CHECK(parts.lo * parts.lo == wide(parts.lo) * wide(parts.lo));
  }
}

/* What a pair is, as far as long double resolves. */
static real value(pair_t a) { return wide(a.hi) + wide(a.lo); }

static pair_t random_pair(void) {
  const tf_real_t hi = uniform(-2, 2);
  return pair_normalized(
      (pair_t){hi, hi * TF_REAL_EPSILON * uniform(-0.5, 0.5)});
}

/* In units of what is lost, the square of epsilon or what long double loses. */
TEST(other_operations_lose_the_square_of_epsilon) {
  const real unit = fmaxl(EPSILON * EPSILON, 2 * LDBL_EPSILON);
  for (int n = 0; n < samples(100000); n++) {
    const pair_t a = random_pair(), b = random_pair();
    const tf_real_t s = uniform(-2, 2);
    const real x = value(a), y = value(b), z = wide(s);
    const real size = fabsl(x) + fabsl(y), with = fabsl(x) + fabsl(z);
    CHECK(fabsl(value(pair_product(a, b)) - x * y) <= 4 * unit * fabsl(x * y));
    CHECK(fabsl(value(pair_times(a, s)) - x * z) <= 4 * unit * fabsl(x * z));
    CHECK(fabsl(value(pair_sum(a, b)) - (x + y)) <= 4 * unit * size);
    CHECK(fabsl(value(pair_difference(a, b)) - (x - y)) <= 4 * unit * size);
    CHECK(fabsl(value(pair_plus(a, s)) - (x + z)) <= 4 * unit * with);
    CHECK(fabsl(value(pair_quotient(a, b)) - x / y) <= 8 * unit * fabsl(x / y));
  }
}
