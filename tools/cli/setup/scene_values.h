/// @file
/// The value of one line of a scene as text; a part of scene_file.c.
#ifndef TWOFOLD_CLI_SCENE_VALUES_H
#define TWOFOLD_CLI_SCENE_VALUES_H

#include <stdbool.h>

#include "scene_file.h"

#define CLI_PLACE_ROOM 512 ///< longer paths are cut in messages

typedef struct {
  cli_scene_file_t *file;
  const char *path;
  unsigned line;              ///< the present one, from 1
  unsigned given[CLI_KEYS];   ///< line that gave the key, 0: none
  char place[CLI_PLACE_ROOM]; ///< "PATH:LINE:" of the present line
} cli_scene_reader_t;

/// Sets the place to a line. Returns: the place.
const char *cli_scene_place_of(cli_scene_reader_t *reader, unsigned line);

/// Where a parameter stands in a scene.
tf_real_t *cli_scene_parameter_of(tf_scene_t *scene, size_t key);

/// Whether the first characters of a text may be the name of a scene.
bool cli_scene_is_name(const char *text, size_t length);

/// Reports that the value of a key is out of its range. Returns: CLI_REFUSED.
int cli_scene_refuse_range(cli_scene_reader_t *reader, size_t key,
                           tf_real_t value, double low, double high);

/// Reads the value of a key of the present line; text is cut into its parts.
/// Ranges of parameters are not checked here.
/// Returns: as cli_scene_parse.
int cli_scene_value(cli_scene_reader_t *reader, size_t key, char *text);

#endif
