/// @file
/// The command `sweep`: one motion at each point of a grid of settings.
#ifndef TWOFOLD_CLI_SWEEP_H
#define TWOFOLD_CLI_SWEEP_H

#include "axes.h"

/// Returns: the exit code.
int cli_sweep(const cli_args_t *args);

#endif
