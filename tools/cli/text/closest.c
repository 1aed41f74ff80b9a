// Suggestions for mistyped names. The distance is the edit distance (insert,
// delete, replace, swap two neighbours), bounded by a third of the word: beyond
// that a suggestion is noise.

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "text.h"

#define LONGEST CLI_CLOSEST_LONGEST

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

// Edit distance by dynamic programming with three rows, O(LONGEST^2).
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
  return (cli_closest_t){word, (strlen(word) + 1) / 3 + 1, ""};
}

void cli_closest_offer(cli_closest_t *closest, const char *name) {
  const size_t distance = edit_distance(closest->word, name);
  if (distance < closest->distance) {
    closest->distance = distance;
    (void)snprintf(closest->hint, sizeof closest->hint, "; did you mean '%s'?",
                   name);
  }
}

size_t cli_closest_find(cli_closest_t *closest, const void *table, size_t count,
                        size_t bytes) {
  size_t i = 0;
  for (; i < count; i++) {
    const void *row = (const char *)table + i * bytes;
    const char *name = *(const char *const *)row;
    if (strcmp(name, closest->word) == 0) {
      break;
    }
    cli_closest_offer(closest, name);
  }
  return i;
}
