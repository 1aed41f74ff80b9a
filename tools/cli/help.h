/// @file
/// The help texts.
#ifndef TWOFOLD_CLI_HELP_H
#define TWOFOLD_CLI_HELP_H

#include <stdbool.h>

/// `twofold help [COMMAND]`.
/// Returns: CLI_DONE, CLI_STOPPED (not writable) or CLI_USAGE (complained).
int cli_help(int argc, char *const argv[]);

/// Whether `twofold help COMMAND` has a page.
bool cli_has_page(const char *command);

/// `twofold --version`.
int cli_version(void);

/// `twofold scenes`: one line a scene.
int cli_scenes(int argc, char *const argv[]);

#endif
