/// @file
/// The command `monitor`: frames from a board or a recorded run.
#ifndef TWOFOLD_CLI_MONITOR_H
#define TWOFOLD_CLI_MONITOR_H

#include "command.h"

/// The command line of `monitor`, read and validated.
typedef struct {
  const char *path; ///< "-": standard input
  const char *out;  ///< of --csv; NULL: standard output
  uint64_t baud;    ///< 0: as it is
  bool csv, follow;
  cli_commands_t commands;
} cli_monitor_args_t;

/// Reads the arguments behind `monitor`.
/// Returns: CLI_DONE or CLI_USAGE (complained).
int cli_monitor_args(cli_monitor_args_t *args, int argc, char *const argv[]);

/// The command: argv[0] is the first argument behind `monitor`.
/// Returns: the exit code.
int cli_monitor(int argc, char *const argv[]);

#endif
