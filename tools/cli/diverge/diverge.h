/// @file
/// The command `diverge`: samples of the motions that can follow a two-fold.
#ifndef TWOFOLD_CLI_DIVERGE_H
#define TWOFOLD_CLI_DIVERGE_H

/// The command: argv[0] is the first argument after `diverge`.
/// Returns: the exit code.
int cli_diverge(int argc, char *const argv[]);

/// The command `merge`: argv[0] is the first argument after it.
/// Returns: the exit code.
int cli_merge(int argc, char *const argv[]);

#endif
