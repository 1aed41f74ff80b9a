// Command line and machine of the commands that look at a machine without
// running it.

#include <string.h>

#include "analysis.h"
#include "options.h"
#include "text.h"

#define MOST_VALUES 1000000u // of one range

static int read_number(const char *option, const char *whole, const char *text,
                       tf_real_t *value) {
  const char *why = "";
  if (!cli_read_real(text, value, &why)) {
    return cli_complain(CLI_USAGE, "%s %s: '%s' %s", option, whole, text, why);
  }
  if (!(*value >= -TF_STATE_LIMIT && *value <= TF_STATE_LIMIT)) {
    return cli_complain(CLI_REFUSED, "%s %s: %s must lie in [%g, %g] %s",
                        option, whole, option + 2, -(double)TF_STATE_LIMIT,
                        (double)TF_STATE_LIMIT,
                        strcmp(option, "--r") == 0 ? "m" : "rad/s");
  }
  return CLI_DONE;
}

// A:B:N into its three parts.
static int read_grid(const char *option, const char *value,
                     cli_range_t *range) {
  char parts[3][CLI_REAL_ROOM];
  const char *rest = value;
  for (int i = 0; i < 3; i++) {
    const size_t length = strcspn(rest, ":");
    if (length >= CLI_REAL_ROOM || (rest[length] == ':') != (i < 2)) {
      return cli_complain(CLI_USAGE, "%s %s: expected A:B:N", option, value);
    }
    memcpy(parts[i], rest, length);
    parts[i][length] = '\0';
    rest += length + (i < 2 ? 1 : 0);
  }
  if (!cli_read_whole(parts[2], 1, MOST_VALUES, &range->count)) {
    return cli_complain(CLI_USAGE, "%s %s: N must be a whole number in [1, %u]",
                        option, value, MOST_VALUES);
  }
  int code = read_number(option, value, parts[0], &range->from);
  if (code == CLI_DONE) {
    code = read_number(option, value, parts[1], &range->to);
  }
  if (code == CLI_DONE && range->count == 1 &&
      (range->to > range->from || range->to < range->from)) {
    code = cli_complain(CLI_USAGE, "%s %s: one value cannot be both %s and %s",
                        option, value, parts[0], parts[1]);
  }
  return code;
}

static int read_range(const cli_analysis_t *a, const cli_given_t *option,
                      cli_range_t *range) {
  const char *value = option->value;
  range->text = value;
  if (a->takes == CLI_TAKES_GRID) {
    return read_grid(option->name, value, range);
  }
  range->count = 1;
  const int code = read_number(option->name, value, value, &range->from);
  range->to = range->from;
  return code;
}

static int read_set(void *to, const cli_given_t *option) {
  cli_analysis_t *a = to;
  return cli_settings_add(&a->settings, option->name, option->value);
}

static int read_out(void *to, const cli_given_t *option) {
  cli_analysis_t *a = to;
  return cli_read_path(option, &a->out);
}

static int read_r(void *to, const cli_given_t *option) {
  cli_analysis_t *a = to;
  return read_range(a, option, &a->r);
}

static int read_omega(void *to, const cli_given_t *option) {
  cli_analysis_t *a = to;
  return read_range(a, option, &a->omega);
}

static int take(void *to, const char *word) {
  cli_analysis_t *a = to;
  return cli_take_scene(&a->scene, word);
}

// Those from FIRST_PLACE on are of a place.
static const cli_option_t options[] = {
    {"--set", read_set, CLI_AGAIN},
    {"--out", read_out, CLI_ONCE},
    {"--r", read_r, CLI_ONCE},
    {"--omega", read_omega, CLI_ONCE},
};
#define OPTIONS (sizeof options / sizeof options[0])
#define FIRST_PLACE 2

static int read_words(cli_analysis_t *a, int argc, char *const argv[]) {
  const cli_syntax_t syntax = {
      a->command, options,
      a->takes == CLI_TAKES_NOTHING ? FIRST_PLACE : OPTIONS, take};
  int code = cli_read_words(&syntax, a, argc, argv);
  if (code == CLI_DONE) {
    code = cli_need_scene(a->scene, a->command);
  }
  if (code == CLI_DONE && a->takes != CLI_TAKES_NOTHING &&
      (a->r.text == NULL || a->omega.text == NULL)) {
    const bool grid = a->takes == CLI_TAKES_GRID;
    code = cli_complain(CLI_USAGE, "%s: %s %s is missing", a->command,
                        a->r.text == NULL ? "--r" : "--omega",
                        grid                ? "A:B:N"
                        : a->r.text == NULL ? "R"
                                            : "W");
  }
  return code;
}

static bool has_kappa(const cli_setup_t *setup) {
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    if (strcmp(tf_parameter_ranges[i].name, "kappa") == 0) {
      return setup->set_param[i] != NULL || setup->params.kappa > 0;
    }
  }
  return false;
}

static const cli_setting_t *setting_of(const cli_analysis_t *a,
                                       const char *name) {
  for (size_t i = 0; i < a->settings.count; i++) {
    if (strcmp(a->settings.list[i].name, name) == 0) {
      return &a->settings.list[i];
    }
  }
  return NULL;
}

// Settings that are of a run alone, or that the command is to find.
static void notes(const cli_analysis_t *a, bool finds_kappa) {
  static const char *const idle[] = {
      "kappa", "k2", "dt", "theta", "tolerance", "r", "v", "omega", "h", "phi"};
  cli_setup_notes(&a->setup, "", "");
  for (size_t i = finds_kappa ? 0 : 2; i < sizeof idle / sizeof idle[0]; i++) {
    const cli_setting_t *setting = setting_of(a, idle[i]);
    if (setting != NULL) {
      (void)cli_complain(CLI_DONE, "note: %s %s has no effect: %s %s",
                         setting->option, setting->text, a->command,
                         i < 2 ? "finds it" : "does not run");
    }
  }
}

int cli_analysis_read(cli_analysis_t *a, const char *command, cli_takes_t takes,
                      bool finds_kappa, int argc, char *const argv[]) {
  memset(a, 0, sizeof *a);
  a->command = command;
  a->takes = takes;
  int code = read_words(a, argc, argv);
  if (code == CLI_DONE) {
    code = cli_setup_read(&a->setup, a->scene, &a->settings, NULL);
  }
  if (code == CLI_DONE && finds_kappa && !has_kappa(&a->setup)) {
    a->setup.params.kappa = 1;
  }
  if (code == CLI_DONE) {
    code = cli_setup_machine(&a->setup);
  }
  if (code == CLI_DONE) {
    notes(a, finds_kappa);
  }
  return code;
}

cli_culprit_t cli_analysis_culprit(const cli_analysis_t *a, const char *name) {
  const cli_setting_t *setting = setting_of(a, name);
  const cli_culprit_t scene = {"scene", a->scene->name};
  const cli_culprit_t typed = {setting != NULL ? setting->option : "",
                               setting != NULL ? setting->text : ""};
  return setting != NULL ? typed : scene;
}

int cli_analysis_needs_jump(const cli_analysis_t *a, bool needs_moment) {
  const tf_tyre_law_t law = a->setup.params.law;
  const cli_culprit_t culprit = cli_analysis_culprit(a, "law");
  if (needs_moment ? law == TF_TYRE_JUMP : tf_tyre_is_set_valued(law)) {
    return CLI_DONE;
  }
  return cli_complain(
      CLI_REFUSED, "%s %s: %s needs law %s, not %s: %s", culprit.option,
      culprit.text, a->command, needs_moment ? "jump" : "jump or coulomb",
      cli_law_name(law),
      tf_tyre_is_set_valued(law) ? "stick has no moment under it"
                                 : "it does not jump at h = 0");
}
