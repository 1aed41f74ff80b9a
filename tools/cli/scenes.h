/// @file
/// The commands `scenes` and `scene`, and the help page of the latter.
#ifndef TWOFOLD_CLI_SCENES_H
#define TWOFOLD_CLI_SCENES_H

/// `twofold scenes`: one line per scene. Returns: the exit code.
int cli_scenes(int argc, char *const argv[]);

/// `twofold scene SCENE`: a scene as text that reads back to the same bits.
/// argv[0] is the first argument after `scene`. Returns: the exit code.
int cli_scene(int argc, char *const argv[]);

void cli_scene_help(void);

#endif
