/// @file
/// The command `diverge`: samples of the motions that can follow a two-fold.
#ifndef TWOFOLD_CLI_DIVERGE_H
#define TWOFOLD_CLI_DIVERGE_H

#include "../setup/args.h"
#include "mechanism.h"

/// Checks options that need or exclude each other, and sets what depends on
/// others.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_diverge_check(cli_args_t *args);

/// Returns: the exit code.
int cli_diverge(const cli_args_t *args);

#endif
