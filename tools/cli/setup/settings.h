/// @file
/// The settings of a command line: NAME=VALUE pairs, still as text.
#ifndef TWOFOLD_CLI_SETTINGS_H
#define TWOFOLD_CLI_SETTINGS_H

#include <stddef.h>

/// The longest name that --set knows, with its terminating zero.
#define CLI_NAME_ROOM 16
/// How many settings one command line may hold: more than there are names.
#define CLI_SETTINGS 64

/// One setting as typed, kept for messages.
typedef struct {
  const char *option;       ///< "--set" or "--dt"
  const char *text;         ///< what followed it
  char name[CLI_NAME_ROOM]; ///< left of '='
  const char *value;        ///< right of '='
} cli_setting_t;

/// All settings in the order in which they were given, no name twice.
typedef struct {
  size_t count;
  cli_setting_t list[CLI_SETTINGS];
} cli_settings_t;

/// Splits NAME=VALUE and appends it.
/// option: "--set". text: in, kept.
/// Returns: CLI_DONE, or CLI_USAGE after a message. A name that was given
/// before is refused: which of the two values is meant cannot be known.
int cli_settings_add(cli_settings_t *settings, const char *option,
                     const char *text);

/// Appends the setting of an option that implies the name: --dt VALUE.
/// Returns: as cli_settings_add.
int cli_settings_add_named(cli_settings_t *settings, const char *option,
                           const char *name, const char *value);

/// The setting of a name, NULL where it was not given.
const cli_setting_t *cli_settings_find(const cli_settings_t *settings,
                                       const char *name);

#endif
