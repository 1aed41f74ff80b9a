/// @file
/// The options of `sweep` by which a grid and its columns are given.
#ifndef TWOFOLD_CLI_AXES_H
#define TWOFOLD_CLI_AXES_H

#include "../setup/args.h"
#include "../text/options.h"
#include "measure.h"

/// Read --over and --outcome into the arguments.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_read_over(void *args, const cli_given_t *given);
int cli_read_outcome(void *args, const cli_given_t *given);

/// Checks options that need each other, and sets the usual outcomes.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_sweep_check(cli_args_t *args);

#endif
