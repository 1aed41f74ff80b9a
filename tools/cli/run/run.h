/// @file
/// The command `run`.
#ifndef TWOFOLD_CLI_RUN_H
#define TWOFOLD_CLI_RUN_H

#include "../setup/args.h"

/// Checks options that exclude each other.
int cli_run_check(cli_args_t *args);

int cli_run(const cli_args_t *args);

#endif
