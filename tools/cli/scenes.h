/// @file
/// The commands `scenes` and `scene`.
#ifndef TWOFOLD_CLI_SCENES_H
#define TWOFOLD_CLI_SCENES_H

#include "setup/args.h"

/// `twofold scenes`: one line per scene. Returns: the exit code.
int cli_scenes(int argc, char *const argv[]);

/// `twofold scene SCENE`: a scene as text that reads back to the same bits.
/// Returns: the exit code.
int cli_scene(const cli_args_t *args);

#endif
