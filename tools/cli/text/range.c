// Evenly spaced values. Each is computed from its number alone, so that a part
// of a range has the values of the whole.

#include "range.h"

#include <inttypes.h>
#include <string.h>

#include "message.h"
#include "number.h"

static int read_end(const char *option, const char *whole, const char *text,
                    tf_real_t *value) {
  const char *why = "";
  if (cli_read_real(text, value, &why)) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE, "%s %s: '%s' %s", option, whole, text, why);
}

int cli_read_range(const char *option, const char *whole, const char *text,
                   uint64_t most, cli_range_t *range) {
  char parts[3][CLI_REAL_ROOM];
  range->text = whole;
  for (int i = 0; i < 3; i++) {
    const size_t length = strcspn(text, ":");
    if (length >= CLI_REAL_ROOM || (text[length] == ':') != (i < 2)) {
      return cli_message(CLI_USAGE, "%s %s: expected A:B:N", option, whole);
    }
    memcpy(parts[i], text, length);
    parts[i][length] = '\0';
    text += length + (i < 2 ? 1 : 0);
  }
  if (!cli_read_whole(parts[2], 1, most, &range->count)) {
    return cli_message(CLI_USAGE,
                       "%s %s: N must be a whole number in [1, %" PRIu64 "]",
                       option, whole, most);
  }
  int code = read_end(option, whole, parts[0], &range->from);
  if (code == CLI_DONE) {
    code = read_end(option, whole, parts[1], &range->to);
  }
  if (code == CLI_DONE && range->count == 1 &&
      (range->to > range->from || range->to < range->from)) {
    code = cli_message(CLI_USAGE, "%s %s: one value cannot be both %s and %s",
                       option, whole, parts[0], parts[1]);
  }
  return code;
}

tf_real_t cli_range_at(const cli_range_t *range, uint64_t i) {
  if (i + 1 == range->count) {
    return range->to;
  }
  const double share = (double)i / (double)(range->count - 1);
  return (tf_real_t)((double)range->from +
                     ((double)range->to - (double)range->from) * share);
}
