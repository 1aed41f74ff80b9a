/// @file
/// A command line: which command it is, reading it, performing it.
#ifndef TWOFOLD_CLI_COMMAND_H
#define TWOFOLD_CLI_COMMAND_H

#include "table.h"

/// Performs a command line: argv[0] is the first word after the program's name.
/// Returns: the exit code.
int cli_command(int argc, char *const argv[]);

/// The command of a name, NULL: there is none.
const cli_command_t *cli_find_command(const char *name);

/// Reads and checks the words behind a command that takes options.
/// args: out; its files are from the heap, whatever is returned.
/// Returns: CLI_DONE, or another code after a message.
int cli_read_args(const cli_command_t *command, cli_args_t *args, int argc,
                  char *const argv[]);

/// `twofold help [COMMAND|WORD]`. Returns: the exit code.
int cli_help(int argc, char *const argv[]);

#endif
