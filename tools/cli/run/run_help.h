/// @file
/// The help page of `run`.
#ifndef TWOFOLD_CLI_RUN_HELP_H
#define TWOFOLD_CLI_RUN_HELP_H

void cli_run_help(void);

#endif
