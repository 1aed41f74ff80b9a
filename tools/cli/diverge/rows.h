/// @file
/// The rows that `diverge` writes for each cycle.
#ifndef TWOFOLD_CLI_ROWS_H
#define TWOFOLD_CLI_ROWS_H

#include <stddef.h>

#include "tracker.h"

#define CLI_DIVERGE_ROW 512

/// Headers of --exits and --returns. Returns: the length.
size_t cli_exit_header(char out[CLI_DIVERGE_ROW]);
size_t cli_return_header(char out[CLI_DIVERGE_ROW]);

/// Rows of one cycle. Returns: the length, 0 for a cycle without an exit.
size_t cli_exit_row(char out[CLI_DIVERGE_ROW], uint64_t sample, uint64_t cycle,
                    const cli_cycle_t *what);
size_t cli_return_row(char out[CLI_DIVERGE_ROW], uint64_t sample,
                      uint64_t cycle, const cli_cycle_t *what);

#endif
