// Command line and machine of the commands that examine a machine without
// running it.

#include "analysis.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "../setup/names.h"
#include "../setup/scene.h"
#include "../text/commit.h"
#include "../text/message.h"
#include "../text/number.h"
#include "../text/options.h"

#define MAX_VALUES 1000000u // in one range

static int check_number(const cli_given_t *option, tf_real_t value) {
  if (value >= -TF_STATE_LIMIT && value <= TF_STATE_LIMIT) {
    return CLI_DONE;
  }
  return cli_message(CLI_REFUSED, "%s %s: %s must lie in [%g, %g] %s",
                     option->name, option->value, option->name + 2,
                     -(double)TF_STATE_LIMIT, (double)TF_STATE_LIMIT,
                     strcmp(option->name, "--r") == 0 ? "m" : "rad/s");
}

// One number.
static int read_point(const cli_given_t *option, cli_range_t *range) {
  const char *why = "";
  if (!cli_read_real(option->value, &range->from, &why)) {
    return cli_message(CLI_USAGE, "%s %s: '%s' %s", option->name, option->value,
                       option->value, why);
  }
  range->text = option->value;
  range->to = range->from;
  range->count = 1;
  return CLI_DONE;
}

static int read_range(const cli_analysis_t *a, const cli_given_t *option,
                      cli_range_t *range) {
  int code = a->takes == CLI_TAKES_GRID
                 ? cli_read_range(option->name, option->value, option->value,
                                  MAX_VALUES, range)
                 : read_point(option, range);
  if (code == CLI_DONE) {
    code = check_number(option, range->from);
  }
  return code == CLI_DONE ? check_number(option, range->to) : code;
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

static int read_provenance(void *to, const cli_given_t *option) {
  cli_analysis_t *a = to;
  (void)option;
  a->provenance = true;
  return CLI_DONE;
}

static int take(void *to, const char *word) {
  cli_analysis_t *a = to;
  return cli_take_scene(&a->scene, word);
}

// By what a command takes: the first ones, those of a point, those of a grid.
static const cli_option_t options[] = {
    {"--set", read_set, CLI_REPEATABLE},
    {"--out", read_out, CLI_WRITES},
    {"--r", read_r, CLI_ONCE},
    {"--omega", read_omega, CLI_ONCE},
    {"--provenance", read_provenance, CLI_FLAG},
};
static const size_t options_of[] = {
    [CLI_TAKES_NOTHING] = 2, [CLI_TAKES_POINT] = 4, [CLI_TAKES_GRID] = 5};

static int read_words(cli_analysis_t *a, int argc, char *const argv[]) {
  const cli_syntax_t syntax = {a->command, options, options_of[a->takes], take};
  int code = cli_read_words(&syntax, a, argc, argv);
  if (code == CLI_DONE) {
    code = cli_need_scene(a->scene, a->command);
  }
  if (code == CLI_DONE && a->takes != CLI_TAKES_NOTHING &&
      (a->r.text == NULL || a->omega.text == NULL)) {
    const bool grid = a->takes == CLI_TAKES_GRID;
    code = cli_message(CLI_USAGE, "%s: %s %s is missing", a->command,
                       a->r.text == NULL ? "--r" : "--omega",
                       grid                ? "A:B:N"
                       : a->r.text == NULL ? "R"
                                           : "W");
  }
  return code;
}

// Reports which settings have no effect because only `run` uses them, or
// because the command computes their value itself.
static void print_notes(const cli_analysis_t *a, bool finds_kappa) {
  static const char *const unused[] = {
      "kappa", "k2", "dt", "theta", "tolerance", "r", "v", "omega", "h", "phi"};
  cli_setup_notes(&a->setup, "", "");
  for (size_t i = finds_kappa ? 0 : 2; i < sizeof unused / sizeof unused[0];
       i++) {
    const cli_setting_t *setting = cli_settings_find(&a->settings, unused[i]);
    if (setting != NULL) {
      (void)cli_message(CLI_DONE, "note: %s %s has no effect: %s %s",
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
  if (code == CLI_DONE && finds_kappa && !(a->setup.params.kappa > 0) &&
      cli_settings_find(&a->settings, "kappa") == NULL) {
    a->setup.params.kappa = 1; // any value in its range
  }
  if (code == CLI_DONE) {
    code = cli_setup_machine(&a->setup);
  }
  if (code == CLI_DONE) {
    print_notes(a, finds_kappa);
  }
  return code;
}

cli_origin_t cli_analysis_origin(const cli_analysis_t *a, const char *name) {
  const cli_setting_t *setting = cli_settings_find(&a->settings, name);
  const cli_origin_t scene = {"scene", a->scene->name};
  const cli_origin_t typed = {setting != NULL ? setting->option : "",
                              setting != NULL ? setting->text : ""};
  return setting != NULL ? typed : scene;
}

int cli_analysis_needs_jump(const cli_analysis_t *a, bool needs_moment) {
  const tf_tyre_law_t law = a->setup.params.law;
  const cli_origin_t origin = cli_analysis_origin(a, "law");
  if (needs_moment ? law == TF_TYRE_JUMP : tf_tyre_is_set_valued(law)) {
    return CLI_DONE;
  }
  return cli_message(CLI_REFUSED, "%s %s: %s needs law %s, not %s: %s",
                     origin.option, origin.text, a->command,
                     needs_moment ? "jump" : "jump or coulomb",
                     tf_tyre_law_name(law),
                     tf_tyre_is_set_valued(law) ? "stick has no moment under it"
                                                : "it does not jump at h = 0");
}

int cli_analysis_refuse_mu(const cli_analysis_t *a) {
  const cli_origin_t mu = cli_analysis_origin(a, "mu");
  return cli_message(CLI_REFUSED, "%s %s: %s needs mu > 0", mu.option, mu.text,
                     a->command);
}

int cli_analysis_refuse_gamma(const cli_analysis_t *a) {
  const cli_origin_t gamma = cli_analysis_origin(a, "gamma");
  return cli_message(
      CLI_REFUSED,
      "%s %s: %s needs |sin(gamma)| and |cos(gamma)| in [1e-06, 1], they are "
      "%g and %g",
      gamma.option, gamma.text, a->command, (double)a->setup.machine.sin_gamma,
      (double)a->setup.machine.cos_gamma);
}

void cli_analysis_begin_json(const cli_analysis_t *a, const char *units,
                             cli_buffer_t *text) {
  char hash[9];
  (void)snprintf(hash, sizeof hash, "%08" PRIx32,
                 tf_params_hash(&a->setup.params));
  cli_add(text, "{\n  \"version\": \"" TF_VERSION "\", \"commit\": \"");
  cli_add(text, cli_commit);
  cli_add(text, sizeof(tf_real_t) == sizeof(float)
                    ? "\", \"number\": \"float\",\n  \"scene\": \""
                    : "\", \"number\": \"double\",\n  \"scene\": \"");
  cli_add(text, a->scene->name);
  cli_add(text, "\", \"parameters\": \"");
  cli_add(text, hash);
  cli_add(text, "\",\n  \"units\": {");
  cli_add(text, units);
  cli_add(text, "},\n");
}

int cli_analysis_write(cli_analysis_t *a, const char *text, size_t length) {
  const int code = cli_output_begin(&a->output, "--out", a->out);
  if (code != CLI_DONE) {
    return code;
  }
  (void)cli_output_lines(&a->output, text, length);
  return cli_output_end(&a->output, CLI_DONE);
}
