// Scenes into text. Every member is written, also those that the law does not
// use, so that nothing depends on what a scene leaves out.

#include <string.h>

#include "scene_file.h"
#include "setup.h"

#define VALUES 18 // column of the values
#define UNITS 42  // column of the units

static const struct {
  const char *name, *unit;
} others[CLI_KEYS - TF_PARAMETERS] = {
    {"based-on", "1"}, {"name", "1"},      {"shows", "1"}, {"leaves-out", "1"},
    {"law", "1"},      {"rest", "1"},      {"rule", "1"},  {"with-angle", "1"},
    {"r", "m"},        {"omega", "rad/s"}, {"h", "m/s"},   {"v", "m/s"},
    {"t-end", "s"},    {"profile", "1"}};

const char *cli_key_name(size_t key) {
  return key < TF_PARAMETERS ? tf_parameter_ranges[key].name
                             : others[key - TF_PARAMETERS].name;
}

const char *cli_key_unit(size_t key) {
  return key < TF_PARAMETERS ? tf_parameter_ranges[key].unit
                             : others[key - TF_PARAMETERS].unit;
}

// Fills the line up to a column.
static void pad_to(cli_buffer_t *out, size_t line, size_t column) {
  do {
    cli_add(out, " ");
  } while (!out->truncated && out->used - line < column);
}

static size_t add_key(cli_buffer_t *out, size_t key) {
  const size_t line = out->used;
  cli_add(out, cli_key_name(key));
  pad_to(out, line, VALUES);
  return line;
}

// A text that begins with = would lose it to the one that may stand before a
// value.
static void add_word(cli_buffer_t *out, size_t key, const char *word) {
  (void)add_key(out, key);
  cli_add(out, word[0] == '=' ? "= " : "");
  cli_add(out, word);
  cli_add(out, "\n");
}

static void add_number(cli_buffer_t *out, size_t key, tf_real_t value) {
  const size_t line = add_key(out, key);
  cli_add_real(out, value);
  if (strcmp(cli_key_unit(key), "1") != 0) {
    pad_to(out, line, UNITS);
    cli_add(out, "# ");
    cli_add(out, cli_key_unit(key));
  }
  cli_add(out, "\n");
}

static void add_profile(cli_buffer_t *out, const tf_scene_t *scene) {
  if (scene->knots == 0) {
    return;
  }
  cli_add(out, "# speed of the turntable, linear between these times [s]\n");
  (void)add_key(out, CLI_KEY_PROFILE);
  for (size_t i = 0; i < scene->knots; i++) {
    cli_add(out, i > 0 ? " " : "");
    cli_add_real(out, scene->profile[i].t);
    cli_add(out, ":");
    cli_add_real(out, scene->profile[i].omega0);
  }
  cli_add(out, "\n");
}

void cli_scene_print(const tf_scene_t *scene, const tf_params_t *params,
                     cli_buffer_t *out) {
  add_word(out, CLI_KEY_NAME, scene->name);
  if (scene->shows[0] != '\0') {
    add_word(out, CLI_KEY_SHOWS, scene->shows);
  }
  if (scene->leaves_out[0] != '\0') {
    add_word(out, CLI_KEY_LEAVES_OUT, scene->leaves_out);
  }
  cli_add(out, "\n# the machine\n");
  add_word(out, CLI_KEY_LAW, tf_tyre_law_name(params->law));
  add_word(out, CLI_KEY_REST, tf_rest_law_name(params->rest));
  add_word(out, CLI_KEY_RULE, tf_rule_name(params->rule));
  add_word(out, CLI_KEY_WITH_ANGLE, params->with_angle ? "yes" : "no");
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    add_number(out, i, cli_parameter(params, i));
  }
  cli_add(out, "\n# the start, by its speed v or its slip speed h\n");
  add_number(out, CLI_KEY_R, scene->r);
  add_number(out, CLI_KEY_OMEGA, scene->omega);
  if (scene->v_is_given) {
    add_number(out, CLI_KEY_V, scene->v);
  } else {
    add_number(out, CLI_KEY_H, scene->h);
  }
  add_number(out, CLI_KEY_T_END, scene->t_end);
  add_profile(out, scene);
}
