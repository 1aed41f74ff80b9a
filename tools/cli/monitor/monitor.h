/// @file
/// The command `monitor`: what a stream of frames reports.
#ifndef TWOFOLD_CLI_MONITOR_H
#define TWOFOLD_CLI_MONITOR_H

#include "../setup/args.h"

/// Takes the positional argument, a file or a device.
int cli_take_source(void *args, const char *word);

/// Checks options that need each other.
int cli_monitor_check(cli_args_t *args);

int cli_monitor(const cli_args_t *args);

#endif
