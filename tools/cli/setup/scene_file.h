/// @file
/// Scenes as text: a line `KEY VALUE` or `KEY = VALUE` for each member, with
/// comments behind `#`. Units and ranges are those of tf_parameter_ranges. A
/// text that is printed here reads back to the same bits.
#ifndef TWOFOLD_CLI_SCENE_FILE_H
#define TWOFOLD_CLI_SCENE_FILE_H

#include <stddef.h>

#include "../text/buffer.h"
#include "scene_values.h"
#include "twofold.h"

/// Reads a scene from text. Its name is that of the file without the ending,
/// unless the text gives one.
/// path: in, of the file, for the messages and the name.
/// Returns: CLI_DONE; after a message with path, line, key and range CLI_USAGE
/// (no such key, a key twice, not a number) or CLI_REFUSED (out of range).
int cli_scene_parse(cli_scene_file_t *file, const char *path, const char *text,
                    size_t size);

/// Reads a scene from a file.
/// Returns: as cli_scene_parse; CLI_USAGE as well where it cannot be read.
int cli_scene_read(cli_scene_file_t *file, const char *path);

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
/// is the second one) or what cli_scene_read returned.
int cli_take_scene(const tf_scene_t **scene, const char *word);

/// Checks that a scene was given.
int cli_need_scene(const tf_scene_t *scene, const char *command);

#endif
