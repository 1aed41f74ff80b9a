/// @file
/// The command `sweep`: one motion at each point of a grid of settings.
#ifndef TWOFOLD_CLI_SWEEP_H
#define TWOFOLD_CLI_SWEEP_H

/// The command: argv[0] is the first argument after `sweep`.
/// Returns: the exit code.
int cli_sweep(int argc, char *const argv[]);

#endif
