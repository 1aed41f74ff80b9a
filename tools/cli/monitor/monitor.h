/// @file
/// The command `monitor`: frames from a board or a recorded run.
#ifndef TWOFOLD_CLI_MONITOR_H
#define TWOFOLD_CLI_MONITOR_H

/// The command: argv[0] is the first argument after `monitor`.
/// Returns: the exit code.
int cli_monitor(int argc, char *const argv[]);

#endif
