/// The rows of a run on a terminal, where nobody asked for all of them: the
/// first and the last ones, in columns that a terminal has room for.
#pragma once

#include "../host/output.h"
#include "row.h"

#define CLI_GLANCE 5 ///< rows at each end
#define CLI_GLANCE_ROOM 128

typedef struct {
  bool on;
  uint64_t rows; ///< so far
  char last[CLI_GLANCE][CLI_GLANCE_ROOM];
} cli_glance_t;

/// Writes what stands above the columns. Returns: whether it could be written.
bool cli_glance_begin(cli_output_t *output);

/// Takes the next row. Returns: likewise.
bool cli_glance_row(cli_glance_t *glance, const cli_csv_t *row,
                    cli_output_t *output);

/// Writes the rows at the end, and how to get all.
bool cli_glance_end(cli_glance_t *glance, cli_output_t *output);
