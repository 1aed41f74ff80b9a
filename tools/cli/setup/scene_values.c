// The value of one line of a scene. What is a text here becomes the member of a
// tf_scene_t; a word that is unknown is answered with the closest one.

#include <stdio.h>
#include <string.h>

#include "../text/message.h"
#include "../text/number.h"
#include "names.h"
#include "scene_file.h"

const char *cli_scene_place_of(cli_scene_reader_t *reader, unsigned line) {
  (void)snprintf(reader->place, sizeof reader->place, "%s:%u:", reader->path,
                 line);
  return reader->place;
}

tf_real_t *cli_scene_parameter_of(tf_scene_t *scene, size_t key) {
  return (tf_real_t *)(void *)((unsigned char *)&scene->params +
                               tf_parameter_ranges[key].offset);
}

int cli_scene_refuse_range(cli_scene_reader_t *reader, size_t key,
                           tf_real_t value, double low, double high) {
  char text[CLI_REAL_ROOM];
  const char *unit = cli_key_unit(key);
  const bool plain = strcmp(unit, "1") == 0;
  (void)cli_write_real(text, value);
  return cli_message(CLI_REFUSED, "%s %s = %s must lie in [%g, %g]%s%s",
                     cli_scene_place_of(reader, reader->given[key]),
                     cli_key_name(key), text, low, high, plain ? "" : " ",
                     plain ? "" : unit);
}

static int read_number(cli_scene_reader_t *reader, size_t key, const char *text,
                       tf_real_t *value) {
  return cli_read_number(reader->place, cli_key_name(key), text, value);
}

// The speed of a knot, in the range of the parameter omega0.
static int read_speed_of_knot(cli_scene_reader_t *reader, const char *text,
                              tf_real_t *value) {
  const tf_parameter_range_t *range =
      &tf_parameter_ranges[cli_parameter_index("omega0")];
  const int code = read_number(reader, CLI_KEY_PROFILE, text, value);
  return code != CLI_DONE || (*value >= range->low && *value <= range->high)
             ? code
             : cli_message(CLI_REFUSED,
                           "%s profile: omega0 = %s must lie in [%g, %g] %s",
                           reader->place, text, (double)range->low,
                           (double)range->high, range->unit);
}

// A number that no law has a range for.
static int read_bounded(cli_scene_reader_t *reader, size_t key,
                        const char *text, tf_real_t *value) {
  const double low = key == CLI_KEY_T_END ? 0 : -(double)TF_STATE_LIMIT;
  const double high = (double)TF_STATE_LIMIT;
  const int code = read_number(reader, key, text, value);
  return code != CLI_DONE || ((double)*value >= low && (double)*value <= high)
             ? code
             : cli_scene_refuse_range(reader, key, *value, low, high);
}

// One knot, T:OMEGA0, later than the one before.
static int read_knot(cli_scene_reader_t *reader, char *text) {
  tf_scene_t *scene = &reader->file->scene;
  tf_knot_t knot = {0, 0};
  char *colon = strchr(text, ':');
  if (colon == NULL) {
    return cli_message(CLI_USAGE, "%s profile: '%s': expected T:OMEGA0",
                       reader->place, text);
  }
  *colon = '\0';
  int code = read_bounded(reader, CLI_KEY_PROFILE, text, &knot.t);
  if (code == CLI_DONE) {
    code = read_speed_of_knot(reader, colon + 1, &knot.omega0);
  }
  if (code != CLI_DONE) {
    return code;
  }
  if (scene->knots == TF_SCENE_KNOTS) {
    return cli_message(CLI_USAGE,
                       "%s profile: more than %d knots; a table of any length "
                       "is given by 'run --inputs FILE'",
                       reader->place, TF_SCENE_KNOTS);
  }
  if (scene->knots > 0 && !(knot.t > scene->profile[scene->knots - 1].t)) {
    return cli_message(CLI_REFUSED,
                       "%s profile: %s s is not later than the knot before",
                       reader->place, text);
  }
  scene->profile[scene->knots++] = knot;
  return CLI_DONE;
}

static int read_profile(cli_scene_reader_t *reader, char *text) {
  int code = CLI_DONE;
  reader->file->scene.knots = 0;
  memset(reader->file->scene.profile, 0, sizeof reader->file->scene.profile);
  if (strcmp(text, "none") == 0) {
    return CLI_DONE;
  }
  while (*text != '\0' && code == CLI_DONE) {
    char *end = text + strcspn(text, " \t");
    const size_t blanks = strspn(end, " \t");
    *end = '\0';
    code = read_knot(reader, text);
    text = end + blanks;
  }
  return code;
}

static int read_base(cli_scene_reader_t *reader, const char *name) {
  for (size_t key = 0; key < CLI_KEYS; key++) {
    if (reader->given[key] != 0 && key != CLI_KEY_BASED_ON) {
      return cli_message(CLI_USAGE, "%s based-on: must be the first key",
                         reader->place);
    }
  }
  char place[CLI_PLACE_ROOM + 16];
  const tf_scene_t *base = NULL;
  (void)snprintf(place, sizeof place, "%s based-on: ", reader->place);
  const int code = cli_find_scene(place, name, "", &base);
  if (code == CLI_DONE) {
    cli_scene_file_t *file = reader->file;
    file->scene = *base;
    (void)snprintf(file->shows, sizeof file->shows, "%s", base->shows);
    (void)snprintf(file->leaves_out, sizeof file->leaves_out, "%s",
                   base->leaves_out);
  }
  return code;
}

// Text that others put between quotes.
static int read_about(cli_scene_reader_t *reader, size_t key, const char *text,
                      char *out, size_t room) {
  if (strlen(text) >= room || strpbrk(text, "\"\\") != NULL) {
    return cli_message(CLI_USAGE,
                       "%s %s: expected at most %zu characters without \" "
                       "and \\",
                       reader->place, cli_key_name(key), room - 1);
  }
  memcpy(out, text, strlen(text) + 1);
  return CLI_DONE;
}

bool cli_scene_is_name(const char *text, size_t length) {
  static const char allowed[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return length > 0 && length < CLI_SCENE_NAME &&
         strspn(text, allowed) >= length;
}

static int read_name(cli_scene_reader_t *reader, const char *text) {
  if (!cli_scene_is_name(text, strlen(text))) {
    return cli_message(CLI_USAGE,
                       "%s name: '%s' must have 1 to %d letters, digits and _",
                       reader->place, text, CLI_SCENE_NAME - 1);
  }
  memcpy(reader->file->name, text, strlen(text) + 1);
  return CLI_DONE;
}

static int read_yes(cli_scene_reader_t *reader, const char *text, bool *out) {
  *out = strcmp(text, "yes") == 0;
  if (*out || strcmp(text, "no") == 0) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE, "%s with-angle: '%s' must be yes or no",
                     reader->place, text);
}

// v and h: the one that is given is the start.
static int read_speed(cli_scene_reader_t *reader, size_t key,
                      const char *text) {
  tf_scene_t *scene = &reader->file->scene;
  const bool is_v = key == CLI_KEY_V;
  if (reader->given[is_v ? CLI_KEY_H : CLI_KEY_V] != 0) {
    return cli_message(CLI_USAGE,
                       "%s %s: give h or v, each follows from the other",
                       reader->place, cli_key_name(key));
  }
  scene->v_is_given = is_v;
  scene->v = scene->h = 0;
  return read_bounded(reader, key, text, is_v ? &scene->v : &scene->h);
}

int cli_scene_value(cli_scene_reader_t *reader, size_t key, char *text) {
  cli_scene_file_t *file = reader->file;
  tf_scene_t *scene = &file->scene;
  const char *place = reader->place;
  if (key < TF_PARAMETERS) {
    return read_number(reader, key, text, cli_scene_parameter_of(scene, key));
  }
  switch (key) {
    case CLI_KEY_BASED_ON:
      return read_base(reader, text);
    case CLI_KEY_NAME:
      return read_name(reader, text);
    case CLI_KEY_SHOWS:
      return read_about(reader, key, text, file->shows, sizeof file->shows);
    case CLI_KEY_LEAVES_OUT:
      return read_about(reader, key, text, file->leaves_out,
                        sizeof file->leaves_out);
    case CLI_KEY_LAW:
      return cli_find_law(place, "law", text, &scene->params.law);
    case CLI_KEY_REST:
      return cli_find_rest(place, "rest", text, &scene->params.rest);
    case CLI_KEY_RULE:
      return cli_find_rule(place, "rule", text, &scene->params.rule);
    case CLI_KEY_WITH_ANGLE:
      return read_yes(reader, text, &scene->params.with_angle);
    case CLI_KEY_PROFILE:
      return read_profile(reader, text);
    case CLI_KEY_R:
      return read_bounded(reader, key, text, &scene->r);
    case CLI_KEY_OMEGA:
      return read_bounded(reader, key, text, &scene->omega);
    case CLI_KEY_T_END:
      return read_bounded(reader, key, text, &scene->t_end);
    default:
      return read_speed(reader, key, text);
  }
}
