// In: the whole text is one number or it is refused. strtod alone would accept
// leading blanks, "1x", and "1e-999" as 0; each of them is a typing error that
// must not start a run. "nan", "inf" and "1e999", which is read as infinite,
// are numbers: they are refused later by the range of the value, whose message
// says what is allowed. The text is read directly into tf_real_t, because a
// decimal rounded to double and then to float may end at a different float.

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <stdarg.h>

#include "../../../src/link/parts.h"
#include "text.h"

bool cli_read_real(const char *text, tf_real_t *value, const char **why) {
  char *end = NULL;
  *why = "is not a number";
  if (isspace((unsigned char)text[0])) return false;
  errno = 0;
  const tf_real_t read = sizeof read == sizeof(float)
                             ? (tf_real_t)strtof(text, &end)
                             : (tf_real_t)strtod(text, &end);
  if (end == text || *end != '\0') return false;
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
  if (*text == '\0') return false;
  for (const char *digit = text; *digit != '\0'; digit++) {
    if (*digit < '0' || *digit > '9') return false;
    const uint64_t next = (uint64_t)(*digit - '0');
    if (next > high || read > (high - next) / 10) return false;
    read = read * 10 + next;
  }
  if (read < low) return false;
  *value = read;
  return true;
}

size_t cli_write_real(char out[CLI_REAL_ROOM], tf_real_t value) {
  return decimal_write(out, (double)value, sizeof(tf_real_t) == sizeof(float));
}

// Evenly spaced values. Each is computed from its number alone, so that a part
// of a range has the values of the whole.

int cli_blame(int code, const cli_given_t *given, const char *format, ...) {
  char text[8192];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return cli_message(code, "%s %s: %s", given->name, given->value, text);
}

int cli_read_number(const cli_given_t *given, const char *text,
                    tf_real_t *value) {
  const char *why = "";
  if (cli_read_real(text, value, &why)) return CLI_DONE;
  return cli_blame(CLI_USAGE, given, "'%s' %s", text, why);
}

static int read_end(const cli_given_t *given, const char *text, bool exact,
                    double *value) {
  tf_real_t real = 0;
  const int code = cli_read_number(given, text, &real);
  *value = exact ? strtod(text, NULL) : (double)real;
  return code;
}

int cli_read_range(const cli_given_t *given, const char *text, uint64_t most,
                   bool exact, cli_range_t *range) {
  char parts[3][CLI_REAL_ROOM];
  range->text = given->value;
  for (int i = 0; i < 3; i++) {
    const size_t length = strcspn(text, ":");
    if (length >= CLI_REAL_ROOM || (text[length] == ':') != (i < 2))
      return cli_blame(CLI_USAGE, given, "expected A:B:N");
    memcpy(parts[i], text, length);
    parts[i][length] = '\0';
    text += length + (i < 2 ? 1 : 0);
  }
  if (!cli_read_whole(parts[2], 1, most, &range->count)) {
    return cli_blame(CLI_USAGE, given,
                     "N must be a whole number in [1, %" PRIu64 "]", most);
  }
  CLI_TRY(read_end(given, parts[0], exact, &range->from));
  CLI_TRY(read_end(given, parts[1], exact, &range->to));
  if (range->count > 1 || !(range->to > range->from || range->to < range->from))
    return CLI_DONE;
  return cli_blame(CLI_USAGE, given, "one value cannot be both %s and %s",
                   parts[0], parts[1]);
}

static bool is_whole(double value) {
  return fabs(value) < 0x1p53 && !(fabs(value - (double)(int64_t)value) > 0);
}

double cli_range_at(const cli_range_t *range, uint64_t i) {
  if (i + 1 == range->count) return range->to;
  const double from = range->from, to = range->to;
  const double at = (double)i, last = (double)(range->count - 1);
  // Of whole numbers the product is exact, so whole values are.
  const bool whole = is_whole(from) && is_whole(to);
  return from + (whole ? (to - from) * at / last : (to - from) * (at / last));
}

uint32_t cli_crc(uint32_t before, const void *from, size_t length) {
  return tf_crc32(before, from, length);
}
