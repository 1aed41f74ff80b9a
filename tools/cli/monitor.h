/// @file
/// The command `monitor`: frames from a board or a recorded run.
#ifndef TWOFOLD_CLI_MONITOR_H
#define TWOFOLD_CLI_MONITOR_H

/// argv[0] is the first argument behind `monitor`.
/// Returns: the exit code.
int cli_monitor(int argc, char *const argv[]);

#endif
