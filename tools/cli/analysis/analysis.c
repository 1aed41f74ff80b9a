// The machine of the commands that examine a machine without
// running it.

#include "analysis.h"

#include <math.h>
#include <string.h>

#include "../setup/names.h"
#include "../text/commit.h"
#include "../text/message.h"

int cli_analysis_check(cli_args_t *args) {
  const bool grid = strcmp(args->command, "design") != 0;
  if (args->r.text == NULL) {
    return cli_message(CLI_USAGE, "%s: --r %s is missing", args->command,
                       grid ? "A:B:N" : "R");
  }
  return args->omega.text != NULL
             ? CLI_DONE
             : cli_message(CLI_USAGE, "%s: --omega %s is missing",
                           args->command, grid ? "A:B:N" : "W");
}

// Reports which settings have no effect because only `run` uses them, or
// because the command computes their value itself.
static void print_notes(const cli_analysis_t *a, bool finds_kappa) {
  static const char *const unused[] = {
      "kappa", "k2", "dt", "theta", "tolerance", "r", "v", "omega", "h", "phi"};
  cli_setup_notes(&a->setup, "", "");
  for (size_t i = finds_kappa ? 0 : 2; i < sizeof unused / sizeof unused[0];
       i++) {
    const cli_setting_t *setting =
        cli_settings_find(&a->args->settings, unused[i]);
    if (setting != NULL) {
      (void)cli_message(CLI_DONE, "note: %s %s has no effect: %s %s",
                        setting->option, setting->text, a->args->command,
                        i < 2 ? "finds it" : "does not run");
    }
  }
}

int cli_analysis_begin(cli_analysis_t *a, const cli_args_t *args,
                       bool finds_kappa) {
  memset(a, 0, sizeof *a);
  a->args = args;
  int code = cli_setup_read(&a->setup, args->scene, &args->settings, NULL);
  if (code == CLI_DONE && finds_kappa && !(a->setup.params.kappa > 0) &&
      cli_settings_find(&args->settings, "kappa") == NULL) {
    a->setup.params.kappa = 1; // any value in its range
  }
  code = code == CLI_DONE ? cli_setup_machine(&a->setup) : code;
  if (code == CLI_DONE) {
    print_notes(a, finds_kappa);
  }
  return code;
}

cli_origin_t cli_analysis_origin(const cli_analysis_t *a, const char *name) {
  const cli_setting_t *setting = cli_settings_find(&a->args->settings, name);
  return setting != NULL ? (cli_origin_t){setting->option, setting->text}
                         : (cli_origin_t){"scene", a->args->scene->name};
}

int cli_analysis_needs_jump(const cli_analysis_t *a, bool needs_moment) {
  const tf_tyre_law_t law = a->setup.params.law;
  const cli_origin_t origin = cli_analysis_origin(a, "law");
  if (needs_moment ? law == TF_TYRE_JUMP : tf_tyre_is_set_valued(law)) {
    return CLI_DONE;
  }
  return cli_message(CLI_REFUSED, "%s %s: %s needs law %s, not %s: %s",
                     origin.option, origin.text, a->args->command,
                     needs_moment ? "jump" : "jump or coulomb",
                     tf_tyre_law_name(law),
                     tf_tyre_is_set_valued(law) ? "stick has no moment under it"
                                                : "it does not jump at h = 0");
}

int cli_analysis_check_design(const cli_analysis_t *a) {
  const tf_machine_t *k = &a->setup.machine;
  const cli_origin_t mu = cli_analysis_origin(a, "mu");
  const cli_origin_t gamma = cli_analysis_origin(a, "gamma");
  const int code = cli_analysis_needs_jump(a, true);
  if (code != CLI_DONE) {
    return code;
  }
  if (!(k->tyre.mu > 0)) {
    return cli_message(CLI_REFUSED, "%s %s: %s needs mu > 0", mu.option,
                       mu.text, a->args->command);
  }
  if (fabs((double)k->sin_gamma) >= (double)TF_MIN_SINE &&
      fabs((double)k->cos_gamma) >= (double)TF_MIN_SINE) {
    return CLI_DONE;
  }
  return cli_message(
      CLI_REFUSED,
      "%s %s: %s needs |sin(gamma)| and |cos(gamma)| in [1e-06, 1], they are "
      "%g and %g",
      gamma.option, gamma.text, a->args->command, (double)k->sin_gamma,
      (double)k->cos_gamma);
}

void cli_analysis_begin_json(const cli_analysis_t *a, const char *units,
                             cli_buffer_t *text) {
  cli_add_form(text,
               "{\n  \"version\": \"%s\", \"commit\": \"%s\", "
               "\"number\": \"%s\",\n"
               "  \"scene\": \"%s\", \"parameters\": \"",
               TF_VERSION, cli_commit, CLI_NUMBER_TYPE, a->args->scene->name);
  cli_add_hash(text, tf_params_hash(&a->setup.params));
  cli_add_form(text, "\",\n  \"units\": {%s},\n", units);
}
