// The profile of a scene and a table of one's own are the same kind of thing;
// the latter is applied over the former, column by column.

#include "drive.h"

#include <string.h>

#include "../text/message.h"

static int read_between(const char *between, bool *linear) {
  *linear = strcmp(between, "linear") == 0;
  if (*linear || strcmp(between, "held") == 0) {
    return CLI_DONE;
  }
  return cli_message(CLI_USAGE, "--between %s: must be held or linear",
                     between);
}

int cli_drive_read(cli_drive_t *drive, const tf_scene_t *scene,
                   const cli_drive_args_t *args) {
  memset(drive, 0, sizeof *drive);
  int code = cli_inputs_of_scene(&drive->profile, scene);
  if (code != CLI_DONE || (args->inputs == NULL && args->between == NULL)) {
    return code;
  }
  if (args->inputs == NULL) {
    return cli_message(CLI_USAGE, "--between %s: only with --inputs",
                       args->between);
  }
  if (args->between == NULL) {
    return cli_message(CLI_USAGE,
                       "--inputs %s: say what holds between two rows, by "
                       "--between held or --between linear",
                       args->inputs);
  }
  code = read_between(args->between, &drive->table.linear);
  return code == CLI_DONE ? cli_inputs_read(&drive->table, args->inputs) : code;
}

void cli_drive_begin(cli_drive_t *drive, cli_setup_t *setup) {
  cli_inputs_prepare(&drive->profile, setup->machine.dt);
  cli_inputs_prepare(&drive->table, setup->machine.dt);
  setup->input = tf_input_default(&setup->machine);
  cli_inputs_start(&drive->profile, 0, 0, &setup->input);
  cli_inputs_start(&drive->table, 0, 0, &setup->input);
}

void cli_drive_notes(const cli_drive_t *drive, const cli_setup_t *setup) {
  for (size_t i = 0; i < CLI_INPUTS; i++) {
    const cli_setting_t *setting =
        cli_setup_setting(setup, cli_input_columns[i].name);
    if (drive->table.given[i] && setting != NULL) {
      (void)cli_message(CLI_DONE, "note: %s %s has no effect: %s gives %s",
                        setting->option, setting->text, drive->table.name,
                        cli_input_columns[i].name);
    }
  }
}

void cli_drive_go_to(cli_drive_t *drive, uint64_t tick, tf_real_t t) {
  tf_input_t input = {0, 0, 0, 0, 0};
  cli_inputs_start(&drive->profile, tick, t, &input);
  cli_inputs_start(&drive->table, tick, t, &input);
}

tf_input_t cli_drive_step(cli_drive_t *drive, const tf_machine_t *machine,
                          uint64_t tick, tf_real_t t) {
  tf_input_t input = tf_input_default(machine);
  cli_inputs_step(&drive->profile, tick, t, machine->dt, &input);
  cli_inputs_step(&drive->table, tick, t, machine->dt, &input);
  return input;
}

void cli_drive_free(cli_drive_t *drive) {
  cli_inputs_free(&drive->profile);
  cli_inputs_free(&drive->table);
}
