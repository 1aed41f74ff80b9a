/// @file
/// The scene that a command is given, by its name.
#ifndef TWOFOLD_CLI_SCENE_H
#define TWOFOLD_CLI_SCENE_H

#include "twofold.h"

/// Takes a word for the name of the scene.
/// scene: in/out, NULL before the first.
/// Returns: CLI_DONE, or CLI_USAGE where there is no such scene or it is the
/// second one (after a message, with the closest name).
int cli_take_scene(const tf_scene_t **scene, const char *word);

/// Checks that a scene was given.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_need_scene(const tf_scene_t *scene, const char *command);

#endif
