/// Scenes as text: a line `KEY VALUE` or `KEY = VALUE` for each member, with
/// comments behind `#`. The parameters come first, in the order of
/// tf_parameter_ranges, whose names, units and ranges they have. A text that is
/// printed here reads back to the same bits.
#pragma once

#include "../text/text.h"
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

/// Reads a scene from text. Its name is that of the file without the ending,
/// unless the text gives one.
/// path: in, of the file, for the messages and the name.
int cli_scene_parse(cli_scene_file_t *file, const char *path, const char *text,
                    size_t size);

/// The first line of a file that is printed.
#define CLI_SCENE_TITLE            \
  "# Scene of twofold " TF_VERSION \
  ", in SI units: 'twofold help scene' has all ranges.\n"

/// Appends a scene with some parameters, those of the scene or altered ones.
void cli_scene_print(const tf_scene_t *scene, const tf_params_t *params,
                     cli_buffer_t *out);

/// The scene of a name, NULL: there is none.
const tf_scene_t *cli_find_scene(cli_closest_t *closest);

/// Takes a word for the name of the scene, or of its file where it has a point
/// or a slash. scene: in/out, NULL before the first: a second one is refused.
/// What is read from a file stays until the next one is read.
int cli_take_scene(const tf_scene_t **scene, const char *word);
