// Scenes by name, or from a file. A word with a point or a slash names a file,
// so that what a word means does not depend on the files that are there.

#include "scene.h"

#include <string.h>

#include "../text/message.h"
#include "names.h"
#include "scene_file.h"

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
  cli_hint_t hint;
  *scene = cli_find_scene(word, &hint);
  return *scene != NULL
             ? CLI_DONE
             : cli_message(CLI_USAGE,
                           "unknown scene '%s'%s%s%s ('twofold scenes' lists "
                           "them; a file has a . or a / in its name)",
                           word, hint.before, hint.name, hint.after);
}

int cli_need_scene(const tf_scene_t *scene, const char *command) {
  if (scene != NULL) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE,
                     "%s: which scene? ('twofold scenes' lists them)", command);
}
