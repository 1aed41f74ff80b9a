/// Scenes as C constants.
#pragma once

#include <stdio.h>

#include "twofold.h"

/// Writes a scene with some parameters, those of the scene or altered ones, as
/// the constant scene_constants.
void constants_of_scene(FILE *out, const tf_scene_t *scene,
                        const tf_params_t *params);

/// Writes the members of a machine, as what stands between the braces of a
/// constant.
void constants_of_machine(FILE *out, const tf_machine_t *machine);

/// Writes a scene, its machine and its start, as a firmware needs them.
/// rate: in, steps a second as typed; NULL: those of the scene.
/// Returns: 0; after a message 3 (refused) or 4 (not written).
int constants_of_firmware(FILE *out, const tf_scene_t *scene, const char *rate);
