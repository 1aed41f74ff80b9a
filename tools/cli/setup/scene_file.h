/// @file
/// Scenes as text: a line `KEY VALUE` or `KEY = VALUE` for each member, with
/// comments behind `#`. The parameters come first, in the order of
/// tf_parameter_ranges, whose names, units and ranges they have. A text that is
/// printed here reads back to the same bits.
#ifndef TWOFOLD_CLI_SCENE_FILE_H
#define TWOFOLD_CLI_SCENE_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "../text/buffer.h"
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

/// Reads a scene from text. Its name is that of the file without the ending,
/// unless the text gives one.
/// path: in, of the file, for the messages and the name.
/// Returns: CLI_DONE; after a message with path, line, key and range CLI_USAGE
/// (no such key, a key twice, not a number) or CLI_REFUSED (out of range).
int cli_scene_parse(cli_scene_file_t *file, const char *path, const char *text,
                    size_t size);

/// The first line of a file that is printed.
#define CLI_SCENE_TITLE            \
  "# Scene of twofold " TF_VERSION \
  ", in SI units: 'twofold help scene' has all ranges.\n"

/// Appends a scene with some parameters, those of the scene or altered ones.
void cli_scene_print(const tf_scene_t *scene, const tf_params_t *params,
                     cli_buffer_t *out);

/// Takes a word for the name of the scene, or of its file where the word has a
/// point or a slash.
/// scene: in/out, NULL before the first. What is read from a file stays until
/// the next one is read.
/// Returns: CLI_DONE; after a message CLI_USAGE (there is no such scene, or it
/// is the second one) or what cli_scene_parse returned.
int cli_take_scene(const tf_scene_t **scene, const char *word);

#endif
