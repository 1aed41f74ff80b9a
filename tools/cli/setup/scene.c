// Scenes by name, or from a file. A word with a point or a slash names a file,
// so that what a word means does not depend on the files that are there.

#include "scene.h"

#include <string.h>

#include "../text/closest.h"
#include "../text/message.h"
#include "scene_file.h"

static const tf_scene_t *find_scene(const char *name) {
  cli_closest_t closest = cli_closest_to(name);
  for (size_t i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, name) == 0) {
      return tf_scenes[i];
    }
    cli_closest_offer(&closest, tf_scenes[i]->name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  (void)cli_message(CLI_USAGE,
                    "unknown scene '%s'%s%s%s ('twofold scenes' lists them; "
                    "a file has a . or a / in its name)",
                    name, hint.before, hint.name, hint.after);
  return NULL;
}

int cli_take_scene(const tf_scene_t **scene, const char *word) {
  if (*scene != NULL) {
    return cli_message(CLI_USAGE, "%s: one scene at a time (%s was given)",
                       word, (*scene)->name);
  }
  // One scene at a time, so one place is enough.
  static cli_scene_file_t file;
  if (strpbrk(word, "./") != NULL) {
    const int code = cli_scene_read(&file, word);
    *scene = code == CLI_DONE ? &file.scene : NULL;
    return code;
  }
  *scene = find_scene(word);
  return *scene != NULL ? CLI_DONE : CLI_USAGE;
}

int cli_need_scene(const tf_scene_t *scene, const char *command) {
  if (scene != NULL) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE,
                     "%s: which scene? ('twofold scenes' lists them)", command);
}
