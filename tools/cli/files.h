/// @file
/// No command writes a file that it also reads, or one file twice.
#ifndef TWOFOLD_CLI_FILES_H
#define TWOFOLD_CLI_FILES_H

/// Checks the words of a command before it opens anything: none may name the
/// file of an option that writes one, nor its `.part`, in which rows are kept
/// until they are whole.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_check_files(int argc, char *const argv[]);

#endif
