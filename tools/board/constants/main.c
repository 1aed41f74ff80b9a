// The program `constants`:
//   constants SCENE [RATE]     for a firmware; dt is the scene's, or 1/RATE
//   constants --scene SCENE    only the scene itself
//   constants --number SCENE   its number in tf_scenes
// SCENE is a name or, but for its number, a file ('twofold help scene').
#include <string.h>

#include "../../cli/setup/scene_file.h"
#include "constants.h"

// The number of a built-in scene, TF_SCENES for any other one.
static int number_of(const tf_scene_t *scene) {
  int i = 0;
  while (i < TF_SCENES && tf_scenes[i] != scene) i++;
  return i;
}

int main(int argc, char **argv) {
  const tf_scene_t *scene = NULL;
  const bool number = argc == 3 && !strcmp(argv[1], "--number");
  const bool alone = argc == 3 && !strcmp(argv[1], "--scene");
  if (argc < 2 || argc > 3) {
    fprintf(stderr, "usage: constants [--scene|--number] SCENE [RATE]\n");
    return 2;
  }
  const int code = cli_take_scene(&scene, argv[number || alone ? 2 : 1]);
  if (code != 0) return code;
  if (!number && !alone)
    return constants_of_firmware(stdout, scene, argc > 2 ? argv[2] : NULL);
  if (alone) {
    constants_of_scene(stdout, scene, &scene->params);
  } else if (number_of(scene) < TF_SCENES) {
    printf("%d\n", number_of(scene));
  } else {
    fprintf(stderr, "constants: a file has no number: %s\n", argv[2]);
    return 2;
  }
  return ferror(stdout) || fflush(stdout) ? 4 : 0;
}
