// Scenes from files for the page, read by the reader of the command line; its
// messages become text that the page shows.
#include <stdarg.h>
#include <stdio.h>

#include "cli/setup/scene_file.h"
#include "cli/text/message.h"
#include "module.h"

#define TEXT_ROOM (CLI_SCENE_BYTES + 1)
#define NAME_ROOM 256
#define TOLD_ROOM 1024
static char text[TEXT_ROOM], name[NAME_ROOM], told[TOLD_ROOM];
static cli_scene_file_t file[2]; // the one that holds, and the next one
static unsigned present;
static bool has_one;

int cli_message(int code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(told, sizeof told, format, arguments);
  va_end(arguments);
  return code;
}

// Where the page puts the bytes of a file, and its name, zero-terminated.
char *EXPORT(scene_bytes)(void) { return text; }

uint32_t EXPORT(scene_room)(void) { return TEXT_ROOM; }

char *EXPORT(scene_path)(void) { return name; }

uint32_t EXPORT(scene_path_room)(void) { return NAME_ROOM; }

// Reads a scene of so many bytes. Returns: whether it is one; then it is the
// scene behind the core's own. Otherwise `scene_told` says why not, and the one
// before holds.
bool EXPORT(scene_take)(uint32_t length) {
  cli_scene_file_t *next = &file[1 - present];
  if (cli_scene_parse(next, name, text, length) != CLI_DONE) return false;
  present = 1 - present;
  has_one = true;
  return true;
}

const char *EXPORT(scene_told)(void) { return told; }

const tf_scene_t *own_scene(void) {
  return has_one ? &file[present].scene : NULL;
}

const char *scene_as_file(const tf_scene_t *scene) {
  cli_buffer_t out = {text, 0, sizeof text, false};
  cli_add(&out, CLI_SCENE_TITLE);
  cli_scene_print(scene, &scene->params, &out);
  return text;
}
