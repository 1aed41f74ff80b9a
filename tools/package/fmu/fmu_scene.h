/// Which scene an FMU begins with, a const tf_scene_t *, and the token that its
/// model description and its binary share. package.py puts a header of its own
/// into every FMU in the place of this one.
#ifndef TWOFOLD_FMU_SCENE_H
#define TWOFOLD_FMU_SCENE_H

#define FMU_SCENE (tf_scenes[0])
#define FMU_TOKEN ""

#endif
