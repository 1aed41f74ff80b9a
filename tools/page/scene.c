// Scenes from files and numbers from text for the page, read by the readers of
// the command line: an address, a field and an option mean the same bits. Its
// messages become text that the page shows.
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/text/text.h"
#include "module.h"

#define NUMBER_ROOM 1024 // beyond any number that people or programs write
#define NAME_ROOM 256
#define TOLD_ROOM 1024
char page_text[TEXT_ROOM];
static char name[NAME_ROOM], told[TOLD_ROOM];
static double taken;
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

char *EXPORT(text_bytes)(void) { return page_text; }

uint32_t EXPORT(text_room)(void) { return TEXT_ROOM; }

// Reads a number from so many bytes. Returns: what is wrong with them, or
// nothing; then `number_value` is the number.
const char *EXPORT(number_take)(uint32_t length) {
  const char *why = "is not a number";
  if (length >= NUMBER_ROOM) return why;
  page_text[length] = '\0';
  if (strlen(page_text) != length) return why;
  return cli_read_real(page_text, &taken, &why) ? "" : why;
}

double EXPORT(number_value)(void) { return taken; }

// Where the page puts the name of a file, zero-terminated.
char *EXPORT(scene_path)(void) { return name; }

uint32_t EXPORT(scene_path_room)(void) { return NAME_ROOM; }

// Reads a scene of so many bytes. Returns: whether it is one; then it is the
// scene behind the core's own. Otherwise `scene_told` says why not, and the one
// before holds.
bool EXPORT(scene_take)(uint32_t length) {
  cli_scene_file_t *next = &file[1 - present];
  if (cli_scene_parse(next, name, page_text, length) != CLI_DONE) return false;
  present = 1 - present;
  has_one = true;
  return true;
}

const char *EXPORT(scene_told)(void) { return told; }

const tf_scene_t *own_scene(void) {
  return has_one ? &file[present].scene : NULL;
}

const char *scene_as_file(const tf_scene_t *scene) {
  cli_buffer_t out = {page_text, 0, sizeof page_text, false};
  cli_add(&out, CLI_SCENE_TITLE);
  cli_scene_print(scene, &scene->params, &out);
  return page_text;
}
