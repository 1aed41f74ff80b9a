/// @file
/// Scripts by which shells complete a command line.
#ifndef TWOFOLD_CLI_COMPLETIONS_H
#define TWOFOLD_CLI_COMPLETIONS_H

/// `twofold completions bash|zsh|fish`: prints the script of a shell.
/// Returns: the exit code.
int cli_completions(int argc, char *const argv[]);

#endif
