/// @file
/// A command line: which command it is, reading it, performing it.
#ifndef TWOFOLD_CLI_COMMAND_H
#define TWOFOLD_CLI_COMMAND_H

#include "setup/args.h"
#include "table.h"

/// Performs a command line: argv[0] is the first word after the program's name.
int cli_command(int argc, char *const argv[]);

/// The command of a name, NULL: there is none.
const cli_command_t *cli_find_command(const char *name);

/// Reads and checks the words behind a command that takes options. No file that
/// is written, nor the `.part` or `.resume` beside it, may be one that another
/// option or a positional argument names.
/// args: out; its files are from the heap, whatever is returned.
int cli_read_args(const cli_command_t *command, cli_args_t *args, int argc,
                  char *const argv[]);

/// `twofold help [COMMAND|WORD]`.
int cli_help(int argc, char *const argv[]);

/// `twofold completions bash|zsh|fish`: prints the script of a shell.
int cli_completions(int argc, char *const argv[]);

/// `twofold scenes`: one line per scene.
int cli_scenes(int argc, char *const argv[]);

#endif
