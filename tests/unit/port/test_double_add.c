/* Double addition in software, for boards whose library does not round it
 * right, against this machine's. */
#include "../../port/arch/double_add.c" // NOLINT(bugprone-suspicious-include)
#include "tap.h"

static uint64_t bits_of(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

static double number(uint64_t bits) {
  double x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* Numbers of which there are some everywhere: few bits, many bits, next to a
 * power of two, of any exponent or one near to that of another. */
static uint64_t any_double(uint64_t near) {
  uint64_t bits = tap_bits();
  switch (tap_bits() % 8) {
    case 0:
      return bits;
    case 1:
      return bits & ~(HIDDEN - 1);
    case 2:
      return (bits & ~(HIDDEN - 1)) | (HIDDEN - 1 - tap_bits() % 4);
    case 3:
      return (bits & (SIGN | (HIDDEN - 1))) >> tap_bits() % 52; /* subnormal */
    default: /* within 64 binades of the other one */
      bits &= SIGN | (HIDDEN - 1);
      if (tap_bits() % 2) bits &= ~((uint64_t)-1 >> (12 + tap_bits() % 52));
      bits += (near & INFINITE) - (tap_bits() % 65 << 52);
      return bits;
  }
}

TEST(sum_is_that_of_the_processor) {
  long finite = 0;
  for (int n = 0; n < samples(2000000); n++) {
    const uint64_t a = any_double(INFINITE / 2 & INFINITE), b = any_double(a);
    const double sum = number(a) + number(b);
    const double difference = number(a) - number(b);
    const uint64_t plus = double_sum(a, b);
    const uint64_t minus = double_difference(a, b);
    const uint64_t reversed = double_reversed(b, a);
    CHECK(isnan(sum) ? isnan(number(plus)) : plus == bits_of(sum));
    CHECK(isnan(difference) ? isnan(number(minus))
                            : minus == bits_of(difference));
    CHECK(reversed == minus || isnan(number(reversed)));
    finite += isfinite(sum) != 0;
  }
  CHECK(finite > samples(1000000));
}

TEST(sum_that_the_library_misses) {
  const uint64_t a = bits_of(-65536), b = bits_of(0x1p-17 + 13 * 0x1p-41);
  CHECK(double_sum(a, b) == bits_of(-65536 + (0x1p-17 + 13 * 0x1p-41)));
}

TEST(sums_of_zeros_and_infinities) {
  const double some[] = {0.0, -0.0, 1, -1, INFINITY, -INFINITY};
  for (int i = 0; i < 36; i++) {
    const double x = some[i % 6], y = some[i / 6];
    const uint64_t got = double_sum(bits_of(x), bits_of(y));
    CHECK(isnan(x + y) ? isnan(number(got)) : got == bits_of(x + y));
  }
}
