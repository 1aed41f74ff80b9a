// Scenes from text, line by line; scene_values.c reads the value of a line.
// Afterwards the parameters are checked together, because their ranges depend
// on the law and the law may stand after them.

#include "scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "../text/closest.h"
#include "../text/lines.h"
#include "../text/message.h"
#include "../text/number.h"
#include "names.h"

#define LINE_ROOM 512

static int find_key(const cli_scene_reader_t *reader, const char *name,
                    size_t *key) {
  cli_closest_t closest = cli_closest_to(name);
  for (*key = 0; *key < CLI_KEYS; ++*key) {
    if (strcmp(cli_key_name(*key), name) == 0) {
      return CLI_DONE;
    }
    cli_closest_offer(&closest, cli_key_name(*key));
  }
  return cli_message(CLI_USAGE,
                     "%s unknown key '%s'%s ('twofold help scene' lists them)",
                     reader->place, name, closest.hint);
}

// Splits a line without its comment into key and value.
static int read_line(cli_scene_reader_t *reader, char *line) {
  line[strcspn(line, "#")] = '\0';
  line += strspn(line, " \t");
  for (size_t end = strlen(line);
       end > 0 && strchr(" \t\r", line[end - 1]) != NULL; end--) {
    line[end - 1] = '\0';
  }
  if (*line == '\0') {
    return CLI_DONE;
  }
  char *value = line + strcspn(line, " \t=");
  const bool equals = value[strspn(value, " \t")] == '=';
  char *rest = value + strspn(value, " \t") + (equals ? 1 : 0);
  rest += strspn(rest, " \t");
  *value = '\0';
  size_t key = 0;
  const int code = find_key(reader, line, &key);
  if (code != CLI_DONE) {
    return code;
  }
  if (*rest == '\0') {
    return cli_message(CLI_USAGE, "%s %s: expected a value", reader->place,
                       line);
  }
  if (reader->given[key] != 0) {
    return cli_message(CLI_USAGE, "%s %s was already given in line %u",
                       reader->place, line, reader->given[key]);
  }
  reader->given[key] = reader->line;
  return cli_scene_value(reader, key, rest);
}

static int read_lines(cli_scene_reader_t *reader, const char *text,
                      size_t size) {
  char line[LINE_ROOM];
  int code = CLI_DONE;
  while (size > 0 && code == CLI_DONE) {
    const char *newline = memchr(text, '\n', size);
    const size_t length = newline != NULL ? (size_t)(newline - text) : size;
    const size_t taken = newline != NULL ? length + 1 : length;
    reader->line++;
    (void)cli_scene_place_of(reader, reader->line);
    if (length >= sizeof line) {
      return cli_message(CLI_USAGE, "%s the line has more than %zu characters",
                         reader->place, sizeof line - 1);
    }
    for (size_t i = 0; i < length; i++) {
      const unsigned char byte = (unsigned char)text[i];
      if ((byte < ' ' && byte != '\t' && byte != '\r') || byte > '~') {
        return cli_message(CLI_USAGE,
                           "%s column %zu: byte %u is not ASCII text",
                           reader->place, i + 1, byte);
      }
    }
    memcpy(line, text, length);
    line[length] = '\0';
    code = read_line(reader, line);
    text += taken;
    size -= taken;
  }
  return code;
}

// A parameter that the law does not use may be 0: it means "none".
static int check_parameters(cli_scene_reader_t *reader) {
  tf_scene_t *scene = &reader->file->scene;
  for (size_t key = 0; key < TF_PARAMETERS; key++) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[key];
    const tf_real_t value = *cli_scene_parameter_of(scene, key);
    if (reader->given[key] != 0 && !cli_parameter_fits(key, value)) {
      return cli_message(CLI_REFUSED, "%s %s must be a whole number",
                         cli_scene_place_of(reader, reader->given[key]),
                         range->name);
    }
    const bool used = ((range->laws >> (unsigned)scene->params.law) & 1u) != 0;
    if ((value >= range->low && value <= range->high) ||
        (!used && value >= 0 && value <= 0)) {
      continue;
    }
    if (reader->given[key] != 0) {
      return cli_scene_refuse_range(reader, key, value, (double)range->low,
                                    (double)range->high);
    }
    return cli_message(CLI_REFUSED,
                       "%s: %s is missing, which law %s needs: give it a value "
                       "in [%g, %g] %s, or begin with 'based-on SCENE'",
                       reader->path, range->name,
                       tf_tyre_law_name(scene->params.law), (double)range->low,
                       (double)range->high, range->unit);
  }
  return CLI_DONE;
}

// What a scene that is based on no other one has to give besides.
static int check_start(const cli_scene_reader_t *reader) {
  static const size_t needed[] = {CLI_KEY_LAW, CLI_KEY_R, CLI_KEY_OMEGA,
                                  CLI_KEY_T_END};
  if (reader->given[CLI_KEY_BASED_ON] != 0) {
    return CLI_DONE;
  }
  for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++) {
    if (reader->given[needed[i]] == 0) {
      return cli_message(CLI_USAGE,
                         "%s: %s is missing; give it, or begin with 'based-on "
                         "SCENE'",
                         reader->path, cli_key_name(needed[i]));
    }
  }
  if (reader->given[CLI_KEY_V] == 0 && reader->given[CLI_KEY_H] == 0) {
    return cli_message(CLI_USAGE, "%s: v or h is missing at the start",
                       reader->path);
  }
  return CLI_DONE;
}

// The name of the file without folders and ending, where the text gives none.
static int name_it(cli_scene_reader_t *reader) {
  char *name = reader->file->name;
  if (name[0] != '\0') {
    return CLI_DONE;
  }
  const char *slash = strrchr(reader->path, '/');
  const char *base = slash != NULL ? slash + 1 : reader->path;
  const size_t length = strcspn(base, ".");
  if (!cli_scene_is_name(base, length)) {
    return cli_message(CLI_USAGE,
                       "%s: the name of the file is no name of a scene (1 to "
                       "%d letters, digits and _); give 'name NAME' in it",
                       reader->path, CLI_SCENE_NAME - 1);
  }
  memcpy(name, base, length);
  name[length] = '\0';
  return CLI_DONE;
}

int cli_scene_parse(cli_scene_file_t *file, const char *path, const char *text,
                    size_t size) {
  cli_scene_reader_t reader = {.file = file, .path = path};
  memset(file, 0, sizeof *file);
  if (size > CLI_SCENE_BYTES) {
    return cli_message(CLI_USAGE, "%s: longer than %d bytes, no scene", path,
                       CLI_SCENE_BYTES);
  }
  const size_t skipped = cli_utf8_mark(text, size);
  int code = read_lines(&reader, text + skipped, size - skipped);
  code = code == CLI_DONE ? check_start(&reader) : code;
  code = code == CLI_DONE ? check_parameters(&reader) : code;
  code = code == CLI_DONE ? name_it(&reader) : code;
  file->scene.name = file->name;
  file->scene.shows = file->shows;
  file->scene.leaves_out = file->leaves_out;
  return code;
}

static int read_file(cli_scene_file_t *file, const char *path) {
  char text[CLI_SCENE_BYTES + 1];
  FILE *opened = fopen(path, "r");
  if (opened == NULL) {
    return cli_message(CLI_USAGE, "%s: %s", path, strerror(errno));
  }
  const size_t size = fread(text, 1, sizeof text, opened);
  const int error = ferror(opened) != 0 ? errno : 0;
  (void)fclose(opened);
  if (error != 0) {
    return cli_message(CLI_USAGE, "%s: %s", path, strerror(error));
  }
  return cli_scene_parse(file, path, text, size);
}

// Scenes by name, or from a file. A word with a point or a slash names a file,
// so that what a word means does not depend on the files that are there.

int cli_take_scene(const tf_scene_t **scene, const char *word) {
  if (*scene != NULL) {
    return cli_message(CLI_USAGE, "%s: one scene at a time (%s was given)",
                       word, (*scene)->name);
  }
  // One scene at a time, so one place is enough.
  static cli_scene_file_t file;
  if (strpbrk(word, "./") != NULL) {
    const int code = read_file(&file, word);
    *scene = code == CLI_DONE ? &file.scene : NULL;
    return code;
  }
  return cli_find_scene("", word, "; a file has a . or a / in its name", scene);
}

int cli_need_scene(const tf_scene_t *scene, const char *command) {
  if (scene != NULL) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE,
                     "%s: which scene? ('twofold scenes' lists them)", command);
}
