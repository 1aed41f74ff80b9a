/// @file
/// The command `sweep`: one motion at each point of a grid of settings.
#ifndef TWOFOLD_CLI_SWEEP_H
#define TWOFOLD_CLI_SWEEP_H

#include "../setup/args.h"
#include "../text/options.h"
#include "measure.h"

int cli_sweep(const cli_args_t *args);

/// Read --over and --outcome into the arguments.
int cli_read_over(void *args, const cli_given_t *given);
int cli_read_outcome(void *args, const cli_given_t *given);

/// Checks options that need each other, and sets the usual outcomes.
int cli_sweep_check(cli_args_t *args);

#endif
