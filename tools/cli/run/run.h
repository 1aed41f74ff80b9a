/// @file
/// The command `run`.
#ifndef TWOFOLD_CLI_RUN_H
#define TWOFOLD_CLI_RUN_H

/// The command: argv[0] is the first argument after `run`.
/// Returns: the exit code.
int cli_run(int argc, char *const argv[]);

#endif
