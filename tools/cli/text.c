// Complaints and suggestions. A refused command line is read by someone who
// has just mistyped something, so a complaint names the option, the value and
// the range, and an unknown name comes with the closest known one. Closeness
// is the edit distance (insert, delete, replace, swap of two neighbours),
// bounded by a third of the word: beyond it a suggestion is noise.

#include "text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int cli_complain(int code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  (void)fputs("twofold: ", stderr);
  (void)vfprintf(stderr, format, arguments);
  (void)fputc('\n', stderr);
  va_end(arguments);
  return code;
}

int cli_finish_stdout(void) {
  errno = 0;
  if (fflush(stdout) == 0 && ferror(stdout) == 0) {
    return CLI_DONE;
  }
  return cli_complain(CLI_STOPPED, "standard output: %s",
                      errno != 0 ? strerror(errno) : "write error");
}

// Longest word that is compared; every name is far shorter.
#define LONGEST 24

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

// Edit distance by three rows of the dynamic programme, O(LONGEST^2).
static size_t edit_distance(const char *a, const char *b) {
  size_t rows[3][LONGEST + 1];
  const size_t n = strlen(a);
  const size_t m = strlen(b);
  if (n > LONGEST || m > LONGEST) {
    return SIZE_MAX;
  }
  for (size_t j = 0; j <= m; j++) {
    rows[0][j] = j;
  }
  for (size_t i = 1; i <= n; i++) {
    size_t *row = rows[i % 3];
    const size_t *above = rows[(i + 2) % 3];
    const size_t *two_above = rows[(i + 1) % 3];
    row[0] = i;
    for (size_t j = 1; j <= m; j++) {
      const size_t replace = above[j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0);
      row[j] = least(replace, least(above[j], row[j - 1]) + 1);
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = least(row[j], two_above[j - 2] + 1);
      }
    }
  }
  return rows[n % 3][m];
}

cli_closest_t cli_closest_to(const char *word) {
  const cli_closest_t closest = {word, NULL, (strlen(word) + 1) / 3 + 1};
  return closest;
}

void cli_closest_offer(cli_closest_t *closest, const char *name) {
  const size_t distance = edit_distance(closest->word, name);
  if (distance < closest->distance) {
    closest->distance = distance;
    closest->name = name;
  }
}

cli_hint_t cli_closest_hint(const cli_closest_t *closest) {
  const cli_hint_t none = {"", "", ""};
  const cli_hint_t hint = {"; did you mean '", closest->name, "'?"};
  return closest->name != NULL ? hint : none;
}
