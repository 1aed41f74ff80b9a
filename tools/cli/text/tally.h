/// @file
/// What a tally of steps means to whoever asked for them: the words of a
/// summary and the exit code, the same for steps that were taken here and for
/// those that a stream reports.
#ifndef TWOFOLD_CLI_TALLY_H
#define TWOFOLD_CLI_TALLY_H

#include "twofold/tally.h"

/// Prints the line `degraded` of a summary to standard error.
/// since: in, what is known of the first of these steps: "first", or "first
/// reported". t: in, when that was [s]; NAN: not known, and not told.
void cli_tally_print(const tf_tally_t *tally, const char *since, double t);

/// Returns: CLI_FLAGGED where some steps were degraded or missed their
/// tolerance, else CLI_DONE.
int cli_tally_code(const tf_tally_t *tally);

#endif
