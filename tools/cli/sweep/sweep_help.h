/// @file
/// The help page of `sweep`.
#ifndef TWOFOLD_CLI_SWEEP_HELP_H
#define TWOFOLD_CLI_SWEEP_HELP_H

void cli_sweep_help(void);

#endif
