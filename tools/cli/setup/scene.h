/// @file
/// The scene that a command is given, by its name or by a file.
#ifndef TWOFOLD_CLI_SCENE_H
#define TWOFOLD_CLI_SCENE_H

#include "twofold.h"

/// Takes a word for the name of the scene, or of its file where the word has a
/// point or a slash.
/// scene: in/out, NULL before the first. What is read from a file stays until
/// the next one is read.
/// Returns: CLI_DONE; after a message CLI_USAGE (there is no such scene, or it
/// is the second one) or what cli_scene_read returned.
int cli_take_scene(const tf_scene_t **scene, const char *word);

/// Checks that a scene was given.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_need_scene(const tf_scene_t *scene, const char *command);

#endif
