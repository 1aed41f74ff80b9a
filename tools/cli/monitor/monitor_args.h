/// @file
/// The command line of `monitor`.
#ifndef TWOFOLD_CLI_MONITOR_ARGS_H
#define TWOFOLD_CLI_MONITOR_ARGS_H

#include "board_command.h"
#include "stream.h"

/// The command line, read and validated.
typedef struct {
  const char *path;       ///< "-": standard input
  const char *out;        ///< of --as; NULL: standard output
  const cli_stream_t *as; ///< NULL: a live view
  const char *record;     ///< of --record, or NULL
  uint64_t baud;          ///< 0: unchanged
  bool follow, live;
  bool provenance; ///< of --as csv: comments before the header
  bool json;       ///< the summary as JSON
  cli_board_commands_t commands;
} cli_monitor_args_t;

/// Reads the arguments after `monitor`.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_monitor_args(cli_monitor_args_t *args, int argc, char *const argv[]);

#endif
