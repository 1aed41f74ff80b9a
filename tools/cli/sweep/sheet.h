/// @file
/// The file of a sweep: header, rows, trailer; and how a file that was stopped
/// is taken up again.
#ifndef TWOFOLD_CLI_SHEET_H
#define TWOFOLD_CLI_SHEET_H

#include "../host/output.h"
#include "../text/trailer.h"
#include "point.h"

#define CLI_PROLOGUE_ROOM 16384
typedef struct {
  const cli_args_t *args;
  uint32_t inputs; ///< hash of their table
  cli_output_t output;
  cli_trailer_t trailer;
  uint64_t first, end; ///< points of this shard
  uint64_t kept;       ///< rows that were there before
  bool whole;          ///< FILE has all rows: nothing is to be done
  char prologue[CLI_PROLOGUE_ROOM]; ///< what stands before the first row
  size_t header, length;            ///< of its first line, 0: none; of all
} cli_sheet_t;

/// Opens the file. Under --resume the rows that are there are read and kept; a
/// file of another sweep is refused, and so are such rows without --resume.
/// hash: in, as cli_point_check gives it.
int cli_sheet_open(cli_sheet_t *sheet, const cli_sweep_t *sweep, uint32_t hash);

/// Writes one row.
/// Returns: whether everything so far could be written.
bool cli_sheet_put(cli_sheet_t *sheet, const char *row, size_t length);

/// Ends the file: under CLI_DONE it gets its trailer and its name.
/// Returns: the code; CLI_STOPPED after a message if it was CLI_DONE.
int cli_sheet_close(cli_sheet_t *sheet, int code);

#endif
