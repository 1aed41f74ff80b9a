/// @file
/// The help texts.
#ifndef TWOFOLD_CLI_HELP_H
#define TWOFOLD_CLI_HELP_H

/// Of `twofold help run`: what follows the schemes that switch.
#define CLI_RUN_HELP_MORE                                                     \
  "                       compensated: moreau that carries its rounding\n"    \
  "                       along, for small steps in float\n"                  \
  "  --realtime           a step waits for its time on the wall clock; the\n" \
  "                       summary counts those that were late\n"

/// `twofold help [COMMAND]`.
/// Returns: CLI_DONE, CLI_STOPPED (not writable) or CLI_USAGE (complained).
int cli_help(int argc, char *const argv[]);

/// `twofold --version`.
int cli_version(void);

/// `twofold scenes`: one line a scene.
int cli_scenes(int argc, char *const argv[]);

#endif
