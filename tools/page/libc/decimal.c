// Between doubles and decimals, exactly: both are whole numbers times a power
// of 2 or of 10, and the whole numbers have all of their bits here. Slow and
// short: a scene has a few dozen numbers.
#include "decimal.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define LIMBS 176      // of 32 bits: MAX_DIGITS over the least double
#define MAX_DIGITS 600 // those behind tell only whether there is a rest
#define BILLION 1000000000u
#define FRACTION 52 // bits of a double behind the point
#define LEAST (-1074)
#define NO_EXPONENT 2047

int errno;

typedef struct {
  uint32_t limb[LIMBS]; // the lowest first
  int used;
} whole_t;

static void multiply(whole_t *n, uint32_t by, uint32_t plus) {
  uint64_t carry = plus;
  for (int i = 0; i < n->used; i++) {
    carry += (uint64_t)n->limb[i] * by;
    n->limb[i] = (uint32_t)carry;
    carry >>= 32;
  }
  if (carry != 0) n->limb[n->used++] = (uint32_t)carry;
}

// Returns: the rest.
static uint32_t divide(whole_t *n, uint32_t by) {
  uint64_t rest = 0;
  for (int i = n->used - 1; i >= 0; i--) {
    rest = rest << 32 | n->limb[i];
    n->limb[i] = (uint32_t)(rest / by);
    rest %= by;
  }
  while (n->used > 0 && n->limb[n->used - 1] == 0) n->used--;
  return (uint32_t)rest;
}

// Times the power of a base; chunk: in, the base to the power of `step`.
static void raise(whole_t *n, int power, uint32_t base, uint32_t chunk,
                  int step) {
  for (; power >= step; power -= step) multiply(n, chunk, 0);
  for (; power > 0; power--) multiply(n, base, 0);
}

static int bit_length(const whole_t *n) {
  int length = 32 * n->used;
  if (n->used == 0) return 0;
  for (uint32_t top = n->limb[n->used - 1]; top < 0x80000000u; top <<= 1)
    length--;
  return length;
}

static bool bit(const whole_t *n, int at) {
  return at >= 0 && at < 32 * n->used &&
         (n->limb[at / 32] >> (at % 32) & 1u) != 0;
}

static double from_bits(uint64_t bits) {
  double value = 0;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static uint64_t bits_of(double value) {
  uint64_t bits = 0;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

static double infinite(void) {
  errno = ERANGE;
  return from_bits((uint64_t)NO_EXPONENT << FRACTION);
}

// n times 2 to the power of e, n not 0, and a rest below the last bit of n or
// not, rounded to even.
static double round_whole(const whole_t *n, int e, bool rest) {
  const int length = bit_length(n);
  const int low = length + e - 1 - FRACTION;
  const int last = low > LEAST ? low : LEAST; // power of the last bit kept
  const int drop = last - e;                  // bits of n below it
  uint64_t kept = 0;
  if (low > NO_EXPONENT) return infinite();
  for (int i = length; i >= drop; i--) kept = kept << 1 | bit(n, i);
  const bool half = bit(n, drop - 1);
  for (int i = 0; i < drop - 1 && !rest; i++) rest = bit(n, i);
  if (half && (rest || (kept & 1u) != 0)) kept++;
  if (kept >> FRACTION == 0) {
    if (half || rest) errno = ERANGE;
    return from_bits(kept);
  }
  const uint64_t bits = ((uint64_t)(last - LEAST + 1) << FRACTION) +
                        (kept - ((uint64_t)1 << FRACTION));
  return bits >> FRACTION >= NO_EXPONENT ? infinite() : from_bits(bits);
}

// n times 10 to the power of e; size: in, e and the digits of n.
static double from_decimal(whole_t *n, int e, int size, bool rest) {
  if (size > 310) return infinite();
  if (size < -330) {
    errno = ERANGE;
    return 0;
  }
  if (e >= 0) {
    raise(n, e, 10, BILLION, 9);
    return round_whole(n, 0, rest);
  }
  // As many bits as the division takes, and more than are kept.
  const int limbs = (-e * 10 / 3 + 96) / 32;
  for (int i = n->used - 1; i >= 0; i--) n->limb[i + limbs] = n->limb[i];
  memset(n->limb, 0, sizeof n->limb[0] * (size_t)limbs);
  n->used += limbs;
  for (; e <= -9; e += 9) rest = divide(n, BILLION) != 0 || rest;
  for (; e < 0; e++) rest = divide(n, 10) != 0 || rest;
  return round_whole(n, -32 * limbs, rest);
}

static int digit_of(char byte, int base) {
  const int small = byte | 0x20;
  const int digit = byte >= '0' && byte <= '9'     ? byte - '0'
                    : small >= 'a' && small <= 'f' ? small - 'a' + 10
                                                   : base;
  return digit < base ? digit : -1;
}

// The power behind a letter, limited to what makes any number 0 or infinite.
static const char *read_power(const char *at, char letter, int *power) {
  const char *digit = at + 1;
  int read = 0;
  if ((*at | 0x20) != letter) return at;
  const bool negative = *digit == '-';
  if (*digit == '-' || *digit == '+') digit++;
  if (digit_of(*digit, 10) < 0) return at;
  for (; digit_of(*digit, 10) >= 0; digit++)
    read = read < 100000 ? 10 * read + digit_of(*digit, 10) : read;
  *power = negative ? -read : read;
  return digit;
}

// Digits, a point among them or not, and a power. Returns: the end; the start
// where there is no digit.
static const char *read_digits(const char *start, int base, double *value) {
  whole_t n = {.used = 0};
  int digits = 0, behind = 0, power = 0, seen = 0;
  bool has_point = false, rest = false;
  const char *at = start;
  for (;; at++) {
    const int digit = digit_of(*at, base);
    if (*at == '.' && !has_point) {
      has_point = true;
      continue;
    }
    if (digit < 0) break;
    seen++;
    if (digits < MAX_DIGITS) {
      multiply(&n, (uint32_t)base, (uint32_t)digit);
      digits += n.used > 0;
      behind += has_point;
    } else {
      rest = rest || digit != 0;
      behind -= !has_point;
    }
  }
  if (seen == 0) return start;
  at = read_power(at, base == 10 ? 'e' : 'p', &power);
  if (n.used == 0)
    *value = 0;
  else if (base == 10)
    *value = from_decimal(&n, power - behind, power - behind + digits, rest);
  else
    *value = round_whole(&n, power - 4 * behind, rest);
  return at;
}

static bool is_word(const char *text, const char *word) {
  while (*word != '\0' && (*text | 0x20) == *word) text++, word++;
  return *word == '\0';
}

// As in C, but for blanks before the number, which are not skipped.
double strtod(const char *text, char **end) {
  const char *at = text + (*text == '-' || *text == '+');
  const char *last = at;
  double value = 0;
  const bool is_nan = is_word(at, "nan");
  if (is_nan || is_word(at, "inf")) {
    value = from_bits(((uint64_t)NO_EXPONENT << FRACTION) +
                      ((uint64_t)is_nan << (FRACTION - 1)));
    last = at + (is_word(at, "infinity") ? 8 : 3);
  } else {
    const bool is_hex = at[0] == '0' && (at[1] | 0x20) == 'x';
    if (is_hex) last = read_digits(at + 2, 16, &value);
    if (!is_hex || last == at + 2) last = read_digits(at, 10, &value);
  }
  if (last == at) last = text;
  // Text of the caller, which may be written where the caller may.
  if (end != NULL) *end = strchr(last, *last);
  return *text == '-' && last != text ? -value : value;
}

double frexp(double value, int *exponent) {
  const uint64_t mask = (uint64_t)NO_EXPONENT << FRACTION;
  const uint64_t bits = bits_of(value);
  const int power = (int)((bits & mask) >> FRACTION);
  *exponent = 0;
  if (!(value < 0 || value > 0) || power == NO_EXPONENT) return value;
  if (power == 0) {
    const double fraction = frexp(value * 0x1p64, exponent);
    *exponent -= 64;
    return fraction;
  }
  *exponent = power - 1022;
  return from_bits((bits & ~mask) | (uint64_t)1022 << FRACTION);
}

int decimal_digits(double value, char digits[DECIMAL_ROOM]) {
  int exponent = 0, count = 0;
  char lowest_first[DECIMAL_ROOM] = {0};
  const double fraction = frexp(fabs(value), &exponent);
  uint64_t whole = (uint64_t)(fraction * 0x1p53);
  int e = exponent - 53; // value = whole 2^e = whole 5^-e 10^e
  for (; whole != 0 && (whole & 1u) == 0; whole >>= 1) e++;
  whole_t n = {.limb = {(uint32_t)whole, (uint32_t)(whole >> 32)},
               .used = whole != 0 ? 2 : 0};
  if (e > 0) raise(&n, e, 2, 0x80000000u, 31);
  if (e < 0) raise(&n, -e, 5, 1220703125u, 13);
  while (n.used > 0) {
    uint32_t nine = divide(&n, BILLION);
    for (int i = 0; i < 9; i++, nine /= 10)
      lowest_first[count++] = (char)('0' + nine % 10);
  }
  while (count > 0 && lowest_first[count - 1] == '0') count--;
  const int power = count + (e < 0 ? e : 0);
  int low = 0;
  while (low < count && lowest_first[low] == '0') low++;
  for (int i = count - 1; i >= low; i--) *digits++ = lowest_first[i];
  *digits = '\0';
  return power;
}
