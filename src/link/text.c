// Numbers and rows as text, without a C library. A real is scaled into six
// digits by multiplying or dividing by ten, so that no table of powers is
// needed.
#include "../num/rounding.h"
#include "parts.h"
#include "twofold/telemetry.h"

#define DIGITS 6

static char *put(char *at, const char *text) {
  while (*text != '\0') *at++ = *text++;
  return at;
}

// Scales to [1e5, 1e6) and rounds. Returns: the digits as a whole number;
// power: out, the power of ten of the first digit.
static uint32_t six_digits(tf_real_t value, int *power) {
  *power = DIGITS - 1;
  for (; value >= TF_R(999999.5); value /= 10) ++*power;
  for (; value < TF_R(99999.5); value *= 10) --*power;
  return (uint32_t)(value + TF_R(0.5));
}

static char *put_power(char *at, int power) {
  *at++ = 'e';
  if (power < 0) *at++ = '-';
  const unsigned size = (unsigned)(power < 0 ? -power : power);
  if (size >= 100) *at++ = (char)('0' + size / 100);
  if (size >= 10) *at++ = (char)('0' + size / 10 % 10);
  *at++ = (char)('0' + size % 10);
  return at;
}

TF_API size_t tf_decimal(char *out, tf_real_t value) {
  char *at = out;
  if (value < 0) {
    *at++ = '-';
    value = -value;
  }
  if (!(value > 0 && value <= TF_REAL_MAX)) {
    const char *word = value > 0 ? "inf" : "nan";
    return (size_t)(put(at, value == 0 ? "0" : word) - out);
  }
  int power = 0, count = 1; // digits up to the last one that is not 0
  char digits[DIGITS];
  uint32_t left = six_digits(value, &power);
  for (int i = DIGITS; i > 0; left /= 10) digits[--i] = (char)('0' + left % 10);
  for (int i = 1; i < DIGITS; i++)
    if (digits[i] != '0') count = i + 1;
  const bool plain = power >= -5 && power < DIGITS;
  const int whole = plain ? power + 1 : 1; // digits before the point
  if (whole <= 0) at = put(at, "0.");
  for (int i = whole; i < 0; i++) *at++ = '0';
  for (int i = 0; i < count || i < whole; i++) {
    if (i == whole && i > 0) *at++ = '.';
    *at++ = digits[i];
  }
  if (!plain) at = put_power(at, power);
  return (size_t)(at - out);
}

static char *put_pair(char *at, const char *label, tf_real_t value) {
  at = put(at, label);
  return at + tf_decimal(at, value);
}

TF_API size_t tf_text_row(char *out, const tf_state_t *state,
                          const tf_report_t *report) {
  char *at = out;
  at = put_pair(at, "r:", state->r);
  at = put_pair(at, " v:", state->v);
  at = put_pair(at, " omega:", state->w);
  at = put_pair(at, " h:", report->slip.h);
  at = put_pair(at, " g:", report->slip.g);
  *at++ = '\n';
  return (size_t)(at - out);
}
