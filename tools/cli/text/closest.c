// Suggestions for mistyped names. The distance is the edit distance (insert,
// delete, replace, swap two neighbours), bounded by a third of the word: beyond
// that a suggestion is noise.

#include <stdio.h>
#include <string.h>

#include "text.h"

#define LONGEST CLI_CLOSEST_LONGEST

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

// table[i][j] is the distance of the first i letters to the first j.
static size_t edit_distance(const char *a, const char *b) {
  size_t table[LONGEST + 1][LONGEST + 1];
  const size_t n = strlen(a), m = strlen(b);
  if (n > LONGEST || m > LONGEST) return SIZE_MAX;
  for (size_t i = 0; i <= n; i++) {
    for (size_t j = 0; j <= m; j++) {
      size_t best = i + j;
      if (i > 0 && j > 0) {
        best = table[i - 1][j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0);
        best = least(best, least(table[i - 1][j], table[i][j - 1]) + 1);
      }
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = least(best, table[i - 2][j - 2] + 1);
      table[i][j] = best;
    }
  }
  return table[n][m];
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
    if (strcmp(name, closest->word) == 0) break;
    cli_closest_offer(closest, name);
  }
  return i;
}
