/// @file
/// The known name closest to a mistyped one.
#ifndef TWOFOLD_CLI_CLOSEST_H
#define TWOFOLD_CLI_CLOSEST_H

#include <stddef.h>

/// A search for the closest name. Candidates are offered one at a time, so
/// that they may come from any table.
typedef struct {
  const char *word; ///< what was typed
  const char *name; ///< closest so far, NULL where none is close enough
  size_t distance;  ///< of name; a candidate has to be closer than this
} cli_closest_t;

/// Starts a search. word: in, kept.
cli_closest_t cli_closest_to(const char *word);

/// Offers one candidate. name: in, kept if it is the closest.
void cli_closest_offer(cli_closest_t *closest, const char *name);

/// The end of an error message: "; did you mean 'chaos'?" or nothing. The
/// result is two strings and a name between them, to be printed by "%s%s%s".
typedef struct {
  const char *before, *name, *after;
} cli_hint_t;
cli_hint_t cli_closest_hint(const cli_closest_t *closest);

#endif
