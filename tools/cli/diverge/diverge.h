/// @file
/// The commands `diverge`, samples of the motions that can follow a two-fold,
/// and `merge`, which adds its counts.
#ifndef TWOFOLD_CLI_DIVERGE_H
#define TWOFOLD_CLI_DIVERGE_H

#include "../setup/args.h"
#include "mechanism.h"

/// Check options that need or exclude each other, and set what depends on
/// others.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_diverge_check(cli_args_t *args);
int cli_merge_check(cli_args_t *args);

/// Return the exit code.
int cli_diverge(const cli_args_t *args);
int cli_merge(const cli_args_t *args);

#endif
