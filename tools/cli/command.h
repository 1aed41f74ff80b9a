/// @file
/// The table of the commands.
#ifndef TWOFOLD_CLI_COMMAND_H
#define TWOFOLD_CLI_COMMAND_H

/// Performs a command line: argv[0] is the first word after the program's name.
/// Returns: the exit code.
int cli_command(int argc, char *const argv[]);

#endif
