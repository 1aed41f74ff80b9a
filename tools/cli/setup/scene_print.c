// Scenes into text. Every member is written, also those that the law does not
// use, so that nothing depends on what a scene leaves out.

#include <string.h>

#include "scene_file.h"
#include "setup.h"

#define VALUES 18 // column of the values
#define UNITS 42  // column of the units

static void pad_to(cli_buffer_t *out, size_t line, size_t column) {
  do {
    cli_add(out, " ");
  } while (!out->truncated && out->used - line < column);
}

static size_t add_key(cli_buffer_t *out, const char *key) {
  const size_t line = out->used;
  cli_add(out, key);
  pad_to(out, line, VALUES);
  return line;
}

// A text that begins with = would lose it to the one that may stand before a
// value.
static void add_word(cli_buffer_t *out, const char *key, const char *word) {
  (void)add_key(out, key);
  cli_add_form(out, word[0] == '=' ? "= %s\n" : "%s\n", word);
}

static void add_number(cli_buffer_t *out, const char *key, const char *unit,
                       tf_real_t value) {
  const size_t line = add_key(out, key);
  cli_add_real(out, value);
  if (strcmp(unit, "1") != 0) {
    pad_to(out, line, UNITS);
    cli_add_form(out, "# %s", unit);
  }
  cli_add(out, "\n");
}

static void add_profile(cli_buffer_t *out, const tf_scene_t *scene) {
  if (scene->knots == 0) {
    return;
  }
  cli_add(out, "# speed of the turntable, linear between these times [s]\n");
  (void)add_key(out, "profile");
  for (size_t i = 0; i < scene->knots; i++) {
    cli_add_form(out, "%s%g:%g", i > 0 ? " " : "", (double)scene->profile[i].t,
                 (double)scene->profile[i].omega0);
  }
  cli_add(out, "\n");
}

void cli_scene_print(const tf_scene_t *scene, const tf_params_t *params,
                     cli_buffer_t *out) {
  add_word(out, "name", scene->name);
  if (scene->shows[0] != '\0') {
    add_word(out, "shows", scene->shows);
  }
  if (scene->leaves_out[0] != '\0') {
    add_word(out, "leaves-out", scene->leaves_out);
  }
  cli_add(out, "\n# the machine\n");
  add_word(out, "law", tf_tyre_law_name(params->law));
  add_word(out, "rest", tf_rest_law_name(params->rest));
  add_word(out, "rule", tf_rule_name(params->rule));
  add_word(out, "with-angle", params->with_angle ? "yes" : "no");
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    add_number(out, tf_parameter_ranges[i].name, tf_parameter_ranges[i].unit,
               cli_parameter(params, i));
  }
  cli_add(out, "\n# the start, by its speed v or its slip speed h\n");
  add_number(out, "r", "m", scene->r);
  add_number(out, "omega", "rad/s", scene->omega);
  add_number(out, scene->v_is_given ? "v" : "h", "m/s",
             scene->v_is_given ? scene->v : scene->h);
  add_number(out, "t-end", "s", scene->t_end);
  add_profile(out, scene);
}
