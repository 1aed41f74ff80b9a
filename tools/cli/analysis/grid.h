/// @file
/// A grid of (r, omega) as CSV.
#ifndef TWOFOLD_CLI_GRID_H
#define TWOFOLD_CLI_GRID_H

#include "analysis.h"

/// Room for one row.
#define CLI_GRID_ROOM 768

/// Writes one row with its newline into out. length: out.
/// Returns: CLI_DONE, or another code after a message, which ends the grid.
typedef int (*cli_grid_row_t)(const cli_analysis_t *a, tf_real_t r,
                              tf_real_t omega, char out[CLI_GRID_ROOM],
                              size_t *length);

/// Writes header and rows, omega inner, r outer, and closes the output.
/// units: in, of the columns, for --provenance.
/// Returns: CLI_DONE; after a message CLI_STOPPED or what a row returned.
int cli_analysis_grid(cli_analysis_t *a, const char *header, const char *units,
                      cli_grid_row_t row);

#endif
