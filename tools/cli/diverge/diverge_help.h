/// @file
/// The help page of `diverge`.
#ifndef TWOFOLD_CLI_DIVERGE_HELP_H
#define TWOFOLD_CLI_DIVERGE_HELP_H

void cli_diverge_help(void);
void cli_merge_help(void);

#endif
