/// @file
/// The overview of the commands, the list of scenes and the version.
#ifndef TWOFOLD_CLI_HELP_H
#define TWOFOLD_CLI_HELP_H

/// Prints one line per command.
void cli_overview(void);

/// `twofold --version`. Returns: the exit code.
int cli_version(void);

/// `twofold scenes`: one line per scene. Returns: the exit code.
int cli_scenes(int argc, char *const argv[]);

#endif
