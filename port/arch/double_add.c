// Addition of doubles in software, rounded as IEEE 754 requires, for Arm
// without an FPU for them: that of libgcc does not always do so
// (docs/PORTS.md), but on Cortex-M0. The linker replaces it by these functions
// (--wrap); their arguments are the bits of doubles, in the registers of the
// run-time ABI.
#include <stdint.h>

#define SIGN ((uint64_t)1 << 63)
#define INFINITE ((uint64_t)0x7FF << 52)
#define HIDDEN ((uint64_t)1 << 52)
#define QUIET ((uint64_t)1 << 51)
#define GUARD 10 // bits below the last one; the lowest is sticky

uint64_t double_sum(uint64_t a, uint64_t b) __asm__("__wrap___aeabi_dadd");
uint64_t double_difference(uint64_t a,
                           uint64_t b) __asm__("__wrap___aeabi_dsub");
uint64_t double_reversed(uint64_t a,
                         uint64_t b) __asm__("__wrap___aeabi_drsub");

// The significand, and the exponent, which is 1 for subnormal numbers too.
static inline uint64_t significand_of(uint64_t bits, unsigned *exponent) {
  const unsigned field = (unsigned)(bits >> 52);
  *exponent = field ? field : 1;
  return ((bits & (HIDDEN - 1)) | (field ? HIDDEN : 0)) << GUARD;
}

// x / 2^n; the last bit is set if any bit is lost.
static inline uint64_t sticky_shift(uint64_t x, unsigned n) {
  if (n == 0) return x;
  if (n > 63) return x != 0;
  return x >> n | ((x << (64 - n)) != 0);
}

static inline uint64_t rounded(uint64_t sum, unsigned exponent) {
  if (sum & SIGN) {
    sum = sticky_shift(sum, 1);
    exponent++;
  } else {
    // The sum is not 0 and below 2^63: at least 1 less than 64.
    unsigned shift = ((unsigned)__builtin_clzll(sum) - 1) & 63u;
    if (shift >= exponent) shift = exponent - 1; // subnormal
    sum <<= shift;
    exponent -= shift;
  }
  const uint64_t half = (uint64_t)1 << (GUARD - 1);
  const uint64_t rest = sum & (2 * half - 1);
  sum >>= GUARD;
  sum += rest > half || (rest == half && (sum & 1));
  // The hidden bit, or a carry into it, increments the exponent.
  const uint64_t bits = ((uint64_t)(exponent - 1) << 52) + sum;
  return bits < INFINITE ? bits : INFINITE;
}

uint64_t double_sum(uint64_t a, uint64_t b) {
  if ((a & ~SIGN) < (b & ~SIGN)) { // a is the larger one
    const uint64_t smaller = a;
    a = b;
    b = smaller;
  }
  const uint64_t sign = a & SIGN, larger = a & ~SIGN, other = b & ~SIGN;
  const int opposite = ((a ^ b) & SIGN) != 0;
  if (larger >= INFINITE) {
    if (larger > INFINITE) return a | QUIET;
    return opposite && other == INFINITE ? INFINITE | QUIET : a;
  }
  unsigned exponent, exponent_b;
  uint64_t sum = significand_of(larger, &exponent);
  const uint64_t added = significand_of(other, &exponent_b);
  const uint64_t shifted = sticky_shift(added, exponent - exponent_b);
  sum = opposite ? sum - shifted : sum + shifted;
  if (sum == 0) return opposite ? 0 : sign;
  return sign | rounded(sum, exponent);
}

uint64_t double_difference(uint64_t a, uint64_t b) {
  return double_sum(a, b ^ SIGN);
}

uint64_t double_reversed(uint64_t a, uint64_t b) {
  return double_sum(a ^ SIGN, b);
}
