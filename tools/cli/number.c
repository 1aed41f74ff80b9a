// Numbers in and out of text.
//
// In: the whole text is one number or it is refused. strtod alone would take
// leading blanks, "1x", and 0 for "1e-999"; each of them is a typing error that
// must not start a run. "nan", "inf" and "1e999", which is read as infinite,
// are numbers: the range that each value has is what refuses them, and it can
// say what would be allowed. It is read directly into tf_real_t, for a decimal
// rounded to double and then to float may end at another float.
//
// Out: the fewest digits that read back to the same bits. Any decimal of
// TF_DIGITS_SAFE digits survives the way there and back, so that is where the
// search starts, and TF_DIGITS_ENOUGH always suffice; two digits lie between.
// Below the smallest normal number precision fades and the search starts at
// one digit. At a power of two the gap below is half the gap above, so that
// the nearest decimal may miss where its upper neighbour reads back: both are
// tried. The program never leaves the C locale: the point is a point.

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text.h"

#ifdef TF_REAL_FLOAT
#define TF_DIGITS_SAFE FLT_DIG
#define TF_DIGITS_ENOUGH 9
#else
#define TF_DIGITS_SAFE DBL_DIG
#define TF_DIGITS_ENOUGH 17
#endif

static tf_real_t text_to_real(const char *text, char **end) {
#ifdef TF_REAL_FLOAT
  return strtof(text, end);
#else
  return strtod(text, end);
#endif
}

bool cli_read_real(const char *text, tf_real_t *value, const char **why) {
  char *end = NULL;
  *why = "is not a number";
  if (isspace((unsigned char)text[0])) {
    return false;
  }
  errno = 0;
  const tf_real_t read = text_to_real(text, &end);
  if (end == text || *end != '\0') {
    return false;
  }
  if (errno == ERANGE && read > -TF_REAL_MIN && read < TF_REAL_MIN) {
    *why = "is too small for the number type of this build";
    return false;
  }
  *value = read;
  return true;
}

bool cli_read_whole(const char *text, uint64_t low, uint64_t high,
                    uint64_t *value) {
  uint64_t read = 0;
  if (*text == '\0') {
    return false;
  }
  for (const char *digit = text; *digit != '\0'; digit++) {
    if (*digit < '0' || *digit > '9') {
      return false;
    }
    const uint64_t next = (uint64_t)(*digit - '0');
    if (next > high || read > (high - next) / 10) {
      return false;
    }
    read = read * 10 + next;
  }
  if (read < low) {
    return false;
  }
  *value = read;
  return true;
}

// Writes the next decimal above (in magnitude) the nearest one of so many
// digits. Returns: whether value is a power of two that this reads back to.
static bool write_above(char out[CLI_REAL_ROOM], int digits, tf_real_t value) {
  int exponent = 0;
  const double fraction = frexp((double)value, &exponent);
  if (fabs(fraction) > 0.5) {
    return false;
  }
  (void)snprintf(out, CLI_REAL_ROOM, "%.*e", digits - 1, (double)value);
  char *e = strchr(out, 'e');
  if (e == NULL || e == out || e[-1] < '0' || e[-1] > '8') {
    return false;
  }
  e[-1]++;
  return text_to_real(out, NULL) == value;
}

size_t cli_write_real(char out[CLI_REAL_ROOM], tf_real_t value) {
  const bool faded = value > -TF_REAL_MIN && value < TF_REAL_MIN;
  for (int digits = faded ? 1 : TF_DIGITS_SAFE; digits <= TF_DIGITS_ENOUGH;
       digits++) {
    (void)snprintf(out, CLI_REAL_ROOM, "%.*g", digits, (double)value);
    if (text_to_real(out, NULL) == value ||
        (digits < TF_DIGITS_ENOUGH && write_above(out, digits, value))) {
      break;
    }
  }
  return strlen(out);
}
