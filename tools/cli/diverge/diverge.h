/// @file
/// The command `diverge`: samples of the motions that can follow a two-fold.
#ifndef TWOFOLD_CLI_DIVERGE_H
#define TWOFOLD_CLI_DIVERGE_H

#include "../setup/args.h"
#include "job.h"

/// Checks options that need or exclude each other, and sets what depends on
/// others.
int cli_diverge_check(cli_args_t *args);

int cli_diverge(const cli_args_t *args);

#endif
