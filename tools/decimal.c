// The decimal with the fewest digits that reads back to the same bits, and of
// those with as few the nearest one, by the Schubfach of R. Giulietti, "The
// Schubfach way to render doubles" (2020), whose letters stand here. It looks
// as "%.15g" does ("%.6g" of a float), or with as many digits more as it needs.
// Of a C library it uses memcpy and strlen: FMUs write numbers likewise, and no
// locale changes the point. Powers of ten are computed each time: those of
// usual numbers have a word or two.

#include "decimal.h"

#include <float.h>
#include <stdint.h>
#include <string.h>

#define WORDS 36 // 2^1120 / 5^292 has the digits that are needed
#define LOW63 (UINT64_MAX >> 1)

static uint64_t upper_product(uint64_t a, uint64_t b) {
  const uint64_t a1 = a >> 32, a0 = (uint32_t)a, b1 = b >> 32, b0 = (uint32_t)b;
  const uint64_t middle = a1 * b0 + (a0 * b0 >> 32);
  return a1 * b1 + (middle >> 32) + ((a0 * b1 + (uint32_t)middle) >> 32);
}

// floor(log2(10^e)), of |e| <= 5456721
static int log2_of_power(int e) {
  return (int)((e * INT64_C(913124641741)) >> 38);
}

// The 63 bits of a whole number from a bit on, which may be below the first.
static uint64_t bits_from(const uint32_t word[WORDS], int used, int first) {
  uint64_t bits = 0;
  for (int i = 0; i < used; i++) {
    const int at = 32 * i - first;
    if (at > -32 && at < 63)
      bits |= at < 0 ? word[i] >> -at : (uint64_t)word[i] << at;
  }
  return bits & LOW63;
}

// g = floor(10^e / 2^r) + 1, 2^125 <= g < 2^126, in two parts of 63 bits.
static void find_g(int e, uint64_t g[2]) {
  uint32_t word[WORDS] = {0};
  int used = e < 0 ? WORDS : 1;
  const int length = 32 * used - 31 + log2_of_power(e) - e; // in bits
  word[used - 1] = 1;
  while (e != 0) {
    const bool divides = e < 0;
    uint32_t five = 1;
    uint64_t rest = 0;
    for (int i = 0; i < 13 && e != 0; i++, e += divides ? 1 : -1) five *= 5;
    for (int i = used; divides && i-- > 0; rest %= five) {
      rest = rest << 32 | word[i];
      word[i] = (uint32_t)(rest / five);
    }
    for (int i = 0; !divides && i < used; i++, rest >>= 32) {
      rest += (uint64_t)word[i] * five;
      word[i] = (uint32_t)rest;
    }
    if (!divides && rest > 0) word[used++] = (uint32_t)rest;
  }
  g[1] = bits_from(word, used, length - 63);
  g[0] = bits_from(word, used, length - 126) + 1;
}

// g c / 2^126, rounded to odd
static uint64_t round_to_odd(const uint64_t g[2], uint64_t c) {
  const uint64_t z = (g[1] * c >> 1) + upper_product(g[0], c);
  const uint64_t w = upper_product(g[1], c) + (z >> 63);
  return w | ((z & LOW63) + LOW63) >> 63;
}

// d 10^k of the positive number c 2^q. irregular: the gap below it is half the
// gap above. k: out.
static uint64_t shortest(uint64_t c, int q, bool irregular, int *k) {
  const uint64_t odd = c & 1, below = irregular ? 1 : 2;
  uint64_t g[2];
  const int64_t off = irregular ? INT64_C(274743187321) : 0;
  *k = (int)((q * INT64_C(661971961083) - off) >> 41);
  find_g(-*k, g);
  const int h = q + log2_of_power(-*k) + 2;
  const uint64_t low = round_to_odd(g, (4 * c - below) << h) + odd;
  const uint64_t v = round_to_odd(g, 4 * c << h);
  const uint64_t high = round_to_odd(g, (4 * c + 2) << h) - odd;
  const uint64_t s = v / 4, ten = s / 10 * 10;
  if (s >= 10 && (low <= 4 * ten) != (4 * ten + 40 <= high))
    return low <= 4 * ten ? ten : ten + 10;
  if ((low <= 4 * s) != (4 * s + 4 <= high)) return low <= 4 * s ? s : s + 1;
  return v < 4 * s + 2 || (v == 4 * s + 2 && s % 2 == 0) ? s : s + 1;
}

// Digits with a point behind `before` of them; zeros stand where none are.
static char *write_digits(char *at, const char *digit, int n, int before) {
  if (before < 1) {
    *at++ = '0';
    *at++ = '.';
    for (; before < 0; before++) *at++ = '0';
    before = n;
  }
  for (int i = 0; i < before; i++) *at++ = (char)(i < n ? digit[i] : '0');
  if (n > before) *at++ = '.';
  for (int i = before; i < n; i++) *at++ = digit[i];
  return at;
}

// d 10^k as "%.*g" of `least` digits writes it, or of more.
static char *write_decimal(char *at, uint64_t d, int k, int least) {
  char letters[20], *digit = letters + sizeof letters;
  int n = 0;
  for (; d % 10 == 0; d /= 10) k++;
  for (; d > 0; d /= 10, n++) *--digit = (char)('0' + d % 10);
  const int e = n - 1 + k, size = e < 0 ? -e : e;
  if (e >= -4 && e < (n > least ? n : least))
    return write_digits(at, digit, n, e + 1);
  at = write_digits(at, digit, n, 1);
  *at++ = 'e';
  *at++ = e < 0 ? '-' : '+';
  if (size > 99) *at++ = (char)('0' + size / 100);
  *at++ = (char)('0' + size / 10 % 10);
  *at++ = (char)('0' + size % 10);
  return at;
}

size_t decimal_write(char out[DECIMAL_ROOM], double value, bool is_float) {
  const int least = is_float ? FLT_DIG : DBL_DIG;
  const int lost = is_float ? DBL_MANT_DIG - FLT_MANT_DIG : 0; // bits, all 0
  const int q_least =
      is_float ? FLT_MIN_EXP - FLT_MANT_DIG : DBL_MIN_EXP - DBL_MANT_DIG;
  uint64_t bits, hidden = UINT64_C(1) << 52;
  char *at = out;
  memcpy(&bits, &value, sizeof bits);
  if (bits >> 63 != 0) *at++ = '-';
  const int exponent = (int)(bits >> 52 & 2047);
  bits &= hidden - 1;
  if (exponent == 2047 || (exponent == 0 && bits == 0)) {
    memcpy(at, exponent == 0 ? "0\0\0" : bits == 0 ? "inf" : "nan", 4);
    return strlen(out);
  }
  uint64_t c = exponent > 0 ? bits | hidden : bits;
  int k, q = (exponent > 0 ? exponent : 1) - 1075 + lost;
  c >>= q < q_least ? lost + q_least - q : lost;
  hidden >>= lost;
  q = q < q_least ? q_least : q;
  const uint64_t d = shortest(c, q, c == hidden && q > q_least, &k);
  at = write_decimal(at, d, k, c < hidden ? 1 : least);
  *at = '\0';
  return (size_t)(at - out);
}
