// Scenes from text, line by line, and into text. Parameters are checked after
// the last line, because their ranges depend on the law and the law may stand
// after them. Every member is printed, also those that the law does not use, so
// that nothing depends on what a scene leaves out.

#include "scene_file.h"

#include "setup.h"

#define LINE_ROOM 512
#define PLACE_ROOM 512 // longer paths are cut in messages

// The keys: the numbers of --set but phi, in whose place stands the length of a
// run; then words, `based-on` first.
enum { T_END = CLI_PHI, BASED_ON = CLI_NUMBERS, KEYS = BASED_ON + 9 };

typedef struct {
  cli_scene_file_t *file;
  cli_lines_t lines;
  unsigned long given[KEYS]; // line that gave the key, 0: none
  bool has_keys;             // before the present one
  char place[PLACE_ROOM];    // "PATH:LINE:" of the present line
  cli_given_t here;          // that, and the present key
} reader_t;

static const tf_parameter_range_t *number_of(size_t key) {
  static const tf_parameter_range_t t_end = {"t-end", "s", 0,
                                             0,       0,   TF_STATE_LIMIT};
  return key == T_END ? &t_end : cli_number(key);
}

static void go_to(reader_t *reader, unsigned long line) {
  (void)snprintf(reader->place, sizeof reader->place,
                 "%s:%lu:", reader->lines.name, line);
  reader->here.name = reader->place;
}

static int refuse(const reader_t *reader, const tf_parameter_range_t *range,
                  tf_real_t value) {
  char text[CLI_REAL_ROOM];
  (void)cli_write_real(text, value);
  return cli_refuse("%s %s = %s %s", reader->here.name, range->name, text,
                    cli_must(range));
}

// v and h: the one that is given is the start. Ranges of parameters are checked
// later.
static int read_number(reader_t *reader, size_t key, const char *text) {
  tf_scene_t *scene = &reader->file->scene;
  tf_real_t *const members[] = {&scene->r, &scene->v, &scene->omega, &scene->h,
                                &scene->t_end};
  tf_real_t value = 0;
  if (reader->given[CLI_V] != 0 && reader->given[CLI_H] != 0) {
    return cli_blame(CLI_USAGE, &reader->here,
                     "give h or v, each follows from the other");
  }
  if (key == CLI_V || key == CLI_H) {
    scene->v_is_given = key == CLI_V;
    scene->v = scene->h = 0;
  }
  CLI_TRY(cli_read_number(&reader->here, text, &value));
  if (!cli_parameter_fits(key, value)) {
    return cli_refuse("%s %s must be a whole number", reader->here.name,
                      reader->here.value);
  }
  if (key >= TF_PARAMETERS && !cli_is_in(number_of(key), value))
    return refuse(reader, number_of(key), value);
  memcpy(key < TF_PARAMETERS ? (char *)&scene->params + number_of(key)->offset
                             : (char *)members[key - CLI_R],
         &value, sizeof value);
  return CLI_DONE;
}

// One knot, T:OMEGA0, not earlier than the one before; two of one time jump.
static int read_knot(reader_t *reader, char *text) {
  static const tf_parameter_range_t times = {
      "profile", "s", 0, 0, -TF_STATE_LIMIT, TF_STATE_LIMIT};
  const tf_parameter_range_t *range = cli_number(cli_number_index("omega0"));
  tf_scene_t *scene = &reader->file->scene;
  tf_knot_t knot = {0, 0};
  char *omega0 = strchr(text, ':');
  if (omega0 == NULL)
    return cli_blame(CLI_USAGE, &reader->here, "'%s': expected T:OMEGA0", text);
  *omega0++ = '\0';
  CLI_TRY(cli_read_number(&reader->here, text, &knot.t));
  if (!cli_is_in(&times, knot.t)) return refuse(reader, &times, knot.t);
  CLI_TRY(cli_read_number(&reader->here, omega0, &knot.omega0));
  if (!cli_is_in(range, knot.omega0)) {
    return cli_blame(CLI_REFUSED, &reader->here, "omega0 = %s %s", omega0,
                     cli_must(range));
  }
  if (scene->knots == TF_SCENE_KNOTS) {
    return cli_blame(CLI_USAGE, &reader->here,
                     "more than %d knots; a table of any length is given by "
                     "'run --inputs FILE'",
                     TF_SCENE_KNOTS);
  }
  const tf_knot_t *end = scene->profile + scene->knots;
  if ((scene->knots > 0 && !(knot.t >= end[-1].t)) ||
      (scene->knots > 1 && !(knot.t > end[-2].t))) {
    return cli_blame(CLI_REFUSED, &reader->here,
                     "%s s is not later than the knots before", text);
  }
  scene->profile[scene->knots++] = knot;
  return CLI_DONE;
}

static int read_profile(reader_t *reader, char *text) {
  reader->file->scene.knots = 0;
  memset(reader->file->scene.profile, 0, sizeof reader->file->scene.profile);
  if (strcmp(text, "none") == 0) return CLI_DONE;
  while (*text != '\0') {
    char *end = text + strcspn(text, " \t");
    const size_t blanks = strspn(end, " \t");
    *end = '\0';
    CLI_TRY(read_knot(reader, text));
    text = end + blanks;
  }
  return CLI_DONE;
}

const tf_scene_t *cli_find_scene(cli_closest_t *closest) {
  for (size_t i = 0; i < TF_SCENES; i++) {
    if (strcmp(tf_scenes[i]->name, closest->word) == 0) return tf_scenes[i];
    cli_closest_offer(closest, tf_scenes[i]->name);
  }
  return NULL;
}

static int read_base(reader_t *reader, char *text) {
  cli_closest_t closest = cli_closest_to(text);
  const tf_scene_t *base = cli_find_scene(&closest);
  if (reader->has_keys)
    return cli_blame(CLI_USAGE, &reader->here, "must be the first key");
  if (base == NULL) {
    return cli_blame(CLI_USAGE, &reader->here,
                     "unknown scene '%s'%s ('twofold scenes' lists them)", text,
                     closest.hint);
  }
  cli_scene_file_t *file = reader->file;
  file->scene = *base;
  (void)snprintf(file->shows, sizeof file->shows, "%s", base->shows);
  (void)snprintf(file->leaves_out, sizeof file->leaves_out, "%s",
                 base->leaves_out);
  return CLI_DONE;
}

// Text that others put between quotes.
static int read_about(reader_t *reader, char *text) {
  cli_scene_file_t *file = reader->file;
  if (strlen(text) >= CLI_SCENE_ABOUT || strpbrk(text, "\"\\") != NULL) {
    return cli_blame(CLI_USAGE, &reader->here,
                     "expected at most %d characters without \" and \\",
                     CLI_SCENE_ABOUT - 1);
  }
  memcpy(
      strcmp(reader->here.value, "shows") == 0 ? file->shows : file->leaves_out,
      text, strlen(text) + 1);
  return CLI_DONE;
}

static bool is_name(const char *text, size_t length) {
  static const char allowed[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return length > 0 && length < CLI_SCENE_NAME &&
         strspn(text, allowed) >= length;
}

static int read_name(reader_t *reader, char *text) {
  if (!is_name(text, strlen(text))) {
    return cli_blame(CLI_USAGE, &reader->here,
                     "'%s' must have 1 to %d letters, digits and _", text,
                     CLI_SCENE_NAME - 1);
  }
  memcpy(reader->file->name, text, strlen(text) + 1);
  return CLI_DONE;
}

static int read_word(reader_t *reader, char *text) {
  return cli_set_word(&reader->file->scene.params, reader->here.value,
                      &reader->here, text);
}

static int read_yes(reader_t *reader, char *text) {
  const bool yes = strcmp(text, "yes") == 0;
  reader->file->scene.params.with_angle = yes;
  if (yes || strcmp(text, "no") == 0) return CLI_DONE;
  return cli_blame(CLI_USAGE, &reader->here, "'%s' must be yes or no", text);
}

static const struct {
  const char *name;
  int (*read)(reader_t *reader, char *text);
} words[KEYS - BASED_ON] = {
    {"based-on", read_base},  {"name", read_name},
    {"shows", read_about},    {"leaves-out", read_about},
    {"law", read_word},       {"rest", read_word},
    {"rule", read_word},      {"with-angle", read_yes},
    {"profile", read_profile}};

static const char *name_of(size_t key) {
  return key < BASED_ON ? number_of(key)->name : words[key - BASED_ON].name;
}

static size_t key_of(cli_closest_t *closest) {
  size_t key = 0;
  for (; key < KEYS && strcmp(name_of(key), closest->word) != 0; key++)
    cli_closest_offer(closest, name_of(key));
  return key;
}

static int read_line(reader_t *reader, char *line) {
  line[strcspn(line, "#")] = '\0';
  line = cli_trim(line);
  if (*line == '\0') return CLI_DONE;
  char *end = line + strcspn(line, " \t=");
  char *value = end + strspn(end, " \t");
  value = cli_trim(*value == '=' ? value + 1 : value);
  *end = '\0';
  cli_closest_t closest = cli_closest_to(line);
  const size_t key = key_of(&closest);
  if (key == KEYS) {
    return cli_usage("%s unknown key '%s'%s ('twofold help scene' lists them)",
                     reader->place, line, closest.hint);
  }
  reader->here.value = line;
  if (*value == '\0')
    return cli_blame(CLI_USAGE, &reader->here, "expected a value");
  if (reader->given[key] != 0) {
    return cli_usage("%s %s was already given in line %lu", reader->here.name,
                     line, reader->given[key]);
  }
  reader->given[key] = reader->lines.line;
  CLI_TRY(key < BASED_ON ? read_number(reader, key, value)
                         : words[key - BASED_ON].read(reader, value));
  reader->has_keys = true;
  return CLI_DONE;
}

static int read_lines(reader_t *reader) {
  char line[LINE_ROOM];
  while (cli_next_line(&reader->lines, line, sizeof line)) {
    go_to(reader, reader->lines.line);
    if (reader->lines.length >= sizeof line) {
      return cli_usage("%s the line has more than %zu characters",
                       reader->here.name, sizeof line - 1);
    }
    for (size_t i = 0; i < reader->lines.length; i++) {
      const unsigned char byte = (unsigned char)line[i];
      if ((byte < ' ' && byte != '\t') || byte > '~') {
        return cli_usage("%s column %zu: byte %u is not ASCII text",
                         reader->here.name, i + 1, byte);
      }
    }
    CLI_TRY(read_line(reader, line));
  }
  return CLI_DONE;
}

static int need(const reader_t *reader, const char *const names[],
                size_t count) {
  for (size_t i = 0; i < count; i++) {
    cli_closest_t closest = cli_closest_to(names[i]);
    if (reader->given[key_of(&closest)] == 0) {
      return cli_usage(
          "%s: %s is missing; give it, or begin with 'based-on SCENE'",
          reader->lines.name, names[i]);
    }
  }
  return CLI_DONE;
}

// A scene that is based on no other one has to give its start, too, and what
// may be 0: the ranges demand the other parameters.
static int check(reader_t *reader) {
  static const char *const start[] = {"law", "r", "omega", "t-end"};
  static const char *const numbers[] = {"d",  "k2",     "c1", "c2",
                                        "r0", "omega0", "mu", "gamma"};
  const unsigned long *given = reader->given;
  if (given[BASED_ON] == 0) {
    CLI_TRY(need(reader, start, sizeof start / sizeof *start));
    if (given[CLI_V] == 0 && given[CLI_H] == 0)
      return cli_usage("%s: v or h is missing at the start",
                       reader->lines.name);
    CLI_TRY(need(reader, numbers, sizeof numbers / sizeof *numbers));
  }
  const tf_params_t *params = &reader->file->scene.params;
  const size_t out = cli_parameter_out(params);
  if (out == TF_PARAMETERS) return CLI_DONE;
  const tf_parameter_range_t *range = cli_number(out);
  if (given[out] != 0) {
    go_to(reader, given[out]);
    return refuse(reader, range, cli_parameter(params, out));
  }
  return cli_refuse(
      "%s: %s is missing, which law %s needs: give it a value in [%g, %g] %s, "
      "or begin with 'based-on SCENE'",
      reader->lines.name, range->name, tf_tyre_law_name(params->law),
      (double)range->low, (double)range->high, range->unit);
}

int cli_scene_parse(cli_scene_file_t *file, const char *path, const char *text,
                    size_t size) {
  reader_t reader = {.file = file, .lines = {path, text, size, 0, 0, false}};
  const char *slash = strrchr(path, '/');
  const char *base = slash != NULL ? slash + 1 : path;
  const size_t length = strcspn(base, ".");
  memset(file, 0, sizeof *file);
  if (size > CLI_SCENE_BYTES) {
    return cli_usage("%s: over %d bytes, not a scene", path, CLI_SCENE_BYTES);
  }
  if (is_name(base, length)) memcpy(file->name, base, length);
  CLI_TRY(read_lines(&reader));
  CLI_TRY(check(&reader));
  if (file->name[0] == '\0') {
    return cli_usage(
        "%s: the file's name is not a valid scene name (1 to %d letters, "
        "digits and _); give 'name NAME' in it",
        path, CLI_SCENE_NAME - 1);
  }
  file->scene.name = file->name;
  file->scene.shows = file->shows;
  file->scene.leaves_out = file->leaves_out;
  return CLI_DONE;
}

static int read_file(cli_scene_file_t *file, const char *path) {
  char *text = NULL;
  size_t size = 0;
  CLI_TRY(cli_read_text("", path, CLI_SCENE_BYTES, &text, &size));
  int code = cli_scene_parse(file, path, text, size);
  if (code == CLI_DONE && text[size - 1] != '\n') code = cli_note_open(path);
  free(text);
  return code;
}

// Scenes by name, or from a file. A word with a point or a slash names a file,
// so that what a word means does not depend on the files that are there.

int cli_take_scene(const tf_scene_t **scene, const char *word) {
  if (*scene != NULL) {
    return cli_usage("%s: one scene at a time (%s was given)", word,
                     (*scene)->name);
  }
  // One scene at a time, so one place is enough.
  static cli_scene_file_t file;
  if (strpbrk(word, "./") != NULL) {
    CLI_TRY(read_file(&file, word));
    *scene = &file.scene;
    return CLI_DONE;
  }
  cli_closest_t closest = cli_closest_to(word);
  *scene = cli_find_scene(&closest);
  if (*scene != NULL) return CLI_DONE;
  return cli_usage(
      "unknown scene '%s'%s ('twofold scenes' lists them; a file has a . or a "
      "/ in its name)",
      word, closest.hint);
}

// Scenes into text.

#define VALUES 18 // column of the values
#define UNITS 42  // column of the units

static void pad_to(cli_buffer_t *out, size_t line, size_t column) {
  do {
    cli_add(out, " ");
  } while (!out->truncated && out->used - line < column);
}

// A text that begins with = would lose it to the one that may stand before a
// value. What has no value has no line.
static void add_line(cli_buffer_t *out, const char *key, const char *value,
                     const char *unit) {
  const size_t line = out->used;
  if (value[0] == '\0') return;
  cli_add(out, key);
  pad_to(out, line, VALUES);
  cli_add_form(out, value[0] == '=' ? "= %s" : "%s", value);
  if (strcmp(unit, "1") != 0) {
    pad_to(out, line, UNITS);
    cli_add_form(out, "# %s", unit);
  }
  cli_add(out, "\n");
}

static void add_number(cli_buffer_t *out, size_t key, tf_real_t value) {
  char text[CLI_REAL_ROOM];
  (void)cli_write_real(text, value);
  add_line(out, number_of(key)->name, text, number_of(key)->unit);
}

void cli_scene_print(const tf_scene_t *scene, const tf_params_t *params,
                     cli_buffer_t *out) {
  add_line(out, "name", scene->name, "1");
  add_line(out, "shows", scene->shows, "1");
  add_line(out, "leaves-out", scene->leaves_out, "1");
  cli_add(out, "\n# the machine\n");
  add_line(out, "law", tf_tyre_law_name(params->law), "1");
  add_line(out, "rest", tf_rest_law_name(params->rest), "1");
  add_line(out, "rule", tf_rule_name(params->rule), "1");
  add_line(out, "with-angle", params->with_angle ? "yes" : "no", "1");
  for (size_t i = 0; i < TF_PARAMETERS; i++)
    add_number(out, i, cli_parameter(params, i));
  cli_add(out, "\n# the start, by its speed v or its slip speed h\n");
  add_number(out, CLI_R, scene->r);
  add_number(out, CLI_OMEGA, scene->omega);
  add_number(out, scene->v_is_given ? CLI_V : CLI_H,
             scene->v_is_given ? scene->v : scene->h);
  add_number(out, T_END, scene->t_end);
  if (scene->knots > 0) {
    cli_add(out,
            "# speed of the turntable, linear between these times [s]\n"
            "profile          ");
    for (size_t i = 0; i < scene->knots; i++) {
      cli_add_form(out, " %g:%g", (double)scene->profile[i].t,
                   (double)scene->profile[i].omega0);
    }
    cli_add(out, "\n");
  }
}
