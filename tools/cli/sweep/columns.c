// What stands before the rows of a sweep: the header, and under --provenance
// four comments. And the line by which --resume recognises its own rows.

#include <inttypes.h>
#include <string.h>

#include "../setup/setup.h"
#include "../text/text.h"
#include "point.h"

static const char *unit_of(const char *name) {
  const size_t number = cli_number_index(name);
  return number < CLI_NUMBERS ? cli_number(number)->unit : "1"; // of the seed
}

void cli_sweep_header(const cli_args_t *args, cli_buffer_t *text) {
  cli_add(text, "point");
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, ",%s", args->axis[i].name);
  }
  cli_add(text, ",status,reason,t");
  for (size_t i = 0; i < args->measures; i++) {
    cli_add_form(text, ",%s", cli_measures[args->measure[i]].name);
  }
  cli_add(text, "\n");
}

void cli_sweep_about(const cli_sweep_t *sweep, const char *newline,
                     cli_buffer_t *text) {
  const cli_args_t *args = sweep->args;
  cli_add_form(text, "twofold %s, commit %s, numbers are %s%sscene %s, hash ",
               TF_VERSION, cli_commit, CLI_NUMBER_TYPE, newline,
               args->scene->name);
  cli_add_hash(text, sweep->hash);
  cli_add_form(text, "%ssweep %s --scheme %s --t-end %g", newline,
               args->scene->name, sweep->scheme->name,
               (double)cli_end_of(args));
  if (args->select != NULL) {
    cli_add_form(text, " --select %s", args->select);
  }
  if (args->drive.inputs != NULL) {
    cli_add_form(text, " --inputs %s --between %s (", args->drive.inputs,
                 args->drive.between == 1 ? "linear" : "held");
    cli_add_hash(text, cli_inputs_hash(&sweep->drive.table));
    cli_add(text, ")");
  }
  for (size_t i = 0; i < args->settings.count; i++) {
    const cli_setting_t *setting = &args->settings.list[i];
    if (strcmp(setting->option, "--over") != 0) {
      cli_add_form(text, " %s %s", setting->option, setting->text);
    }
  }
  for (size_t i = 0; i < args->axes; i++) {
    cli_add_form(text, " --over %s", args->axis[i].range.text);
  }
  for (size_t i = 0; i < args->measures; i++) {
    cli_add_form(text, " --outcome %s", cli_measures[args->measure[i]].name);
  }
}

static void add_unit(cli_buffer_t *text, const char *name, const char *unit) {
  if (unit[0] != '\0') {
    cli_add_form(text, " %s %s,", name, unit);
  }
}

void cli_sweep_provenance(const cli_sweep_t *sweep, cli_buffer_t *text) {
  const cli_args_t *args = sweep->args;
  cli_add(text, "# ");
  cli_sweep_about(sweep, "\n# ", text);
  cli_add(text, "\n# units:");
  for (size_t i = 0; i < args->axes; i++) {
    add_unit(text, args->axis[i].name, unit_of(args->axis[i].name));
  }
  for (size_t i = 0; i < args->measures; i++) {
    const cli_measure_info_t *info = &cli_measures[args->measure[i]];
    add_unit(text, info->name, info->unit);
  }
  cli_add(text, " t s\n");
}
