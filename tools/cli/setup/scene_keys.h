/// @file
/// What a file of a scene holds: its keys. The parameters come first, in the
/// order of tf_parameter_ranges and by their names there.
#ifndef TWOFOLD_CLI_SCENE_KEYS_H
#define TWOFOLD_CLI_SCENE_KEYS_H

#include <stddef.h>

#include "twofold.h"

#define CLI_SCENE_BYTES 16384 ///< of a file, at most
#define CLI_SCENE_NAME 32     ///< with the terminating zero, as below
#define CLI_SCENE_ABOUT 128

/// A scene and the text that it points to, so it must not be copied.
typedef struct {
  tf_scene_t scene;
  char name[CLI_SCENE_NAME];
  char shows[CLI_SCENE_ABOUT], leaves_out[CLI_SCENE_ABOUT];
} cli_scene_file_t;

enum {
  CLI_KEY_BASED_ON = TF_PARAMETERS,
  CLI_KEY_NAME,
  CLI_KEY_SHOWS,
  CLI_KEY_LEAVES_OUT,
  CLI_KEY_LAW,
  CLI_KEY_REST,
  CLI_KEY_RULE,
  CLI_KEY_WITH_ANGLE,
  CLI_KEY_R,
  CLI_KEY_OMEGA,
  CLI_KEY_H,
  CLI_KEY_V,
  CLI_KEY_T_END,
  CLI_KEY_PROFILE,
  CLI_KEYS
};

/// Name of a key, and the unit of its value, "1" where there is none.
const char *cli_key_name(size_t key);
const char *cli_key_unit(size_t key);

#endif
