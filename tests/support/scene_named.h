/* scene_named.h - a scene by its name. */
#ifndef TESTS_SUPPORT_SCENE_NAMED_H
#define TESTS_SUPPORT_SCENE_NAMED_H

#include "tap.h"
#include "twofold.h"

static inline const tf_scene_t *scene_named(const char *name) {
  for (int i = 0; i < TF_SCENES; i++)
    if (!strcmp(tf_scenes[i]->name, name)) return tf_scenes[i];
  printf("# no scene is called %s\n", name);
  CHECK(0);
  return tf_scenes[0];
}

#endif
