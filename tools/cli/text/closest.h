/// @file
/// The known name closest to a mistyped one.
#ifndef TWOFOLD_CLI_CLOSEST_H
#define TWOFOLD_CLI_CLOSEST_H

#include <stddef.h>

#define CLI_CLOSEST_LONGEST 24 ///< longer words are not compared

/// A search for the closest name. Candidates come from any table.
typedef struct {
  const char *word; ///< what was typed
  size_t distance;  ///< a candidate has to be closer than this
  char hint[CLI_CLOSEST_LONGEST + 24]; ///< see below
} cli_closest_t;

/// Starts a search. word: in, kept.
cli_closest_t cli_closest_to(const char *word);

/// Offers one candidate. The hint is the end of an error message,
/// "; did you mean 'chaos'?", or empty.
void cli_closest_offer(cli_closest_t *closest, const char *name);

/// Looks for the word in a table of `count` rows of `bytes` bytes, each of
/// which begins with a const char *, its name, and offers all names before it.
/// Returns: the number of the row, count: there is none.
size_t cli_closest_find(cli_closest_t *closest, const void *table, size_t count,
                        size_t bytes);

#endif
