/// @file
/// The overview of the commands, and the version.
#ifndef TWOFOLD_CLI_HELP_H
#define TWOFOLD_CLI_HELP_H

/// Prints one line per command.
void cli_overview(void);

/// `twofold --version`. Returns: the exit code.
int cli_version(void);

#endif
