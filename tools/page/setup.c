// The set-up of the page: numbers that it writes, which start as those of a
// scene, and the tables of names, units and ranges, of which the page has no
// copy. Files and numbers in words are read by the readers of the command line:
// an address, a field and an option mean the same bits. Its messages become
// text that the page shows.
#include "cli/setup/setup.h"

#include <stdio.h>
#include <string.h>

#include "module.h"

#define NUMBER_ROOM 1024 // beyond any number that people or programs write
#define NAME_ROOM 256
#define TOLD_ROOM 1024
char page_text[TEXT_ROOM];
static tf_scene_t scene; // of the set-up, with the scene's own numbers
static char name[NAME_ROOM], told[TOLD_ROOM];
static double taken;
static cli_scene_file_t file[2]; // the one that holds, and the next one
static unsigned present;

// The numbers of the set-up: those of tf_parameter_ranges, and behind them:
enum {
  SETUP_LAW = TF_PARAMETERS,
  SETUP_RULE,
  SETUP_REST,
  SETUP_R,
  SETUP_OMEGA,
  SETUP_H,
  SETUP_V,
  SETUP_V_IS_GIVEN,
  SETUP_SEED,
  SETUP_NUMBERS
};
static double number[SETUP_NUMBERS];

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
  return true;
}

const char *EXPORT(scene_told)(void) { return told; }

uint32_t EXPORT(scenes)(void) { return TF_SCENES; }

// The number behind those of the core is that of a file.
static const tf_scene_t *scene_at(uint32_t i) {
  return i < TF_SCENES ? tf_scenes[i] : &file[present].scene;
}

const char *EXPORT(scene_name)(uint32_t i) { return scene_at(i)->name; }

const char *EXPORT(scene_shows)(uint32_t i) { return scene_at(i)->shows; }

// The set-up becomes that of a scene.
void EXPORT(load)(uint32_t i) {
  scene = *scene_at(i);
  for (size_t k = 0; k < TF_PARAMETERS; k++)
    number[k] = cli_parameter(&scene.params, k);
  number[SETUP_LAW] = scene.params.law;
  number[SETUP_RULE] = scene.params.rule;
  number[SETUP_REST] = scene.params.rest;
  number[SETUP_R] = scene.r;
  number[SETUP_OMEGA] = scene.omega;
  number[SETUP_H] = scene.h;
  number[SETUP_V] = scene.v;
  number[SETUP_V_IS_GIVEN] = scene.v_is_given;
  number[SETUP_SEED] = 0;
}

double *EXPORT(numbers)(void) { return number; }

tf_scene_t page_setup(uint32_t *seed) {
  tf_scene_t own = scene;
  for (size_t k = 0; k < TF_PARAMETERS; k++)
    memcpy((char *)&own.params + tf_parameter_ranges[k].offset, &number[k],
           sizeof number[k]);
  own.params.law = (tf_tyre_law_t)number[SETUP_LAW];
  own.params.rule = (tf_rule_t)number[SETUP_RULE];
  own.params.rest = (tf_rest_law_t)number[SETUP_REST];
  own.r = number[SETUP_R];
  own.omega = number[SETUP_OMEGA];
  own.h = number[SETUP_H];
  own.v = number[SETUP_V];
  own.v_is_given = number[SETUP_V_IS_GIVEN] != 0;
  *seed = (uint32_t)number[SETUP_SEED];
  return own;
}

// The set-up as a file.
const char *EXPORT(scene_print)(void) {
  uint32_t seed = 0;
  const tf_scene_t own = page_setup(&seed);
  cli_buffer_t out = {page_text, 0, sizeof page_text, false};
  cli_add(&out, CLI_SCENE_TITLE);
  cli_scene_print(&own, &own.params, &out);
  return page_text;
}

// A parameter behind the last has the empty name.
const char *EXPORT(parameter_name)(uint32_t i) {
  return i < TF_PARAMETERS ? tf_parameter_ranges[i].name : "";
}

// Of the others there is no more than one for each of the names; laws: bits of
// those that use it.
#define COLUMN(type, member)                    \
  type EXPORT(parameter_##member)(uint32_t i) { \
    return tf_parameter_ranges[i].member;       \
  }
COLUMN(const char *, unit)
const char *EXPORT(parameter_words)(uint32_t i) {
  return cli_parameter_about[i];
}
COLUMN(double, low)
COLUMN(double, high)
COLUMN(uint32_t, laws)

// Whether it may have a value, its range apart.
bool EXPORT(parameter_fits)(uint32_t i, double value) {
  return cli_parameter_fits(i, value);
}

// The first scene of the core whose law uses it; each has one.
uint32_t EXPORT(parameter_scene)(uint32_t i) {
  uint32_t user = 0;
  while (!(parameter_laws(i) >> tf_scenes[user]->params.law & 1u)) user++;
  return user;
}

// Its value in that scene.
double EXPORT(parameter_there)(uint32_t i) {
  return cli_parameter(&tf_scenes[parameter_scene(i)]->params, i);
}

const char *EXPORT(arithmetic)(void) {
  return tf_arithmetic_name(tf_arithmetic());
}

double EXPORT(state_limit)(void) { return TF_STATE_LIMIT; }

double EXPORT(least_sine)(void) { return TF_MIN_SINE; }

const char *EXPORT(mode_name)(uint32_t mode) {
  return mode < TF_MODES ? tf_mode_name(mode) : "";
}

const char *EXPORT(law_name)(uint32_t law) { return tf_tyre_law_name(law); }

const char *EXPORT(rule_name)(uint32_t rule) { return tf_rule_name(rule); }

const char *EXPORT(rest_name)(uint32_t law) { return tf_rest_law_name(law); }

const char *EXPORT(status_name)(int32_t status) {
  return tf_status_name((tf_status_t)status);
}
