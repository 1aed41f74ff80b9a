// What a run counts, step by step.

#include "record.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "../setup/setup.h"
#include "../text/text.h"

void cli_run_show(const cli_run_t *run) {
  if (run->live != NULL) {
    const tf_real_t t = (tf_real_t)cli_run_time(run, run->done);
    const cli_csv_t row = cli_row(t, &run->system.state, &run->report);
    cli_live_note(run->live, &row);
  }
}

cli_setup_t cli_run_setup(const cli_run_t *run) {
  cli_setup_t setup = *run->setup;
  if (run->replays) setup.params = run->replay.link.params;
  setup.seed = run->system.state.seed;
  return setup;
}

size_t cli_run_changes(const cli_run_t *run, char out[CLI_CHANGES_ROOM]) {
  cli_buffer_t text = {out, 0, CLI_CHANGES_ROOM, false};
  const cli_setup_t now = cli_run_setup(run);
  const tf_params_t *was = &run->setup->params;
  out[0] = '\0';
  for (size_t i = 0; i < TF_PARAMETERS; i++) {
    const tf_real_t value = cli_parameter(&now.params, i);
    const tf_real_t before = cli_parameter(was, i);
    if (memcmp(&value, &before, sizeof value) != 0) {
      cli_add_form(&text, " --set %s=%g", tf_parameter_ranges[i].name,
                   (double)value);
    }
  }
  const bool draws = now.params.rule == TF_RULE_RANDOM;
  if (was->rule != now.params.rule || (draws && run->setup->seed != now.seed)) {
    cli_add_form(&text, " --select %s", tf_rule_name(now.params.rule));
    if (draws) cli_add_form(&text, ":%" PRIu64, (uint64_t)now.seed);
  }
  return text.used;
}

double cli_run_time(const cli_run_t *run, uint64_t steps) {
  return (double)steps * (double)run->setup->machine.dt;
}

void cli_run_observe(cli_run_t *run, const tf_report_t *after) {
  const double t = cli_run_time(run, run->done);
  cli_events_observe(&run->events, &run->report, after, &run->system.state, t);
  tf_tally_count(&run->tally, run->done, after->status);
  if (!tf_mode_is_slip(after->mode))
    run->largest_h = fmax(run->largest_h, fabs((double)after->slip.h));
  run->largest_residual = fmax(run->largest_residual, (double)after->residual);
  run->report = *after;
  cli_run_show(run);
}

// What a run leaves to another one. Inputs of a table are no part of it: the
// table is there to be given again. Those by a command are nowhere else.

bool cli_run_save(cli_run_t *run, const char *path) {
  char text[CLI_STATE_BYTES];
  if (path == NULL) return true;
  const cli_setup_t setup = cli_run_setup(run);
  const cli_stand_t stand = {run->system.state,
                             run->system.low,
                             run->report,
                             cli_inputs_hash(&run->drive.table),
                             run->replay.simulation,
                             0};
  const size_t length = cli_state_print(&stand, &setup, text);
  if (run->output.error != 0) {
    (void)cli_message(CLI_STOPPED,
                      "--save %s: not written: the rows up to this state did "
                      "not reach %s",
                      path, run->output.name);
    return cli_output_end(&run->saved, CLI_STOPPED) == CLI_DONE;
  }
  (void)cli_output_lines(&run->saved, text, length);
  if (run->replays && run->replay.next < run->replay.session.count) {
    (void)cli_message(
        CLI_DONE, "note: --save %s: %zu rows of the record were not reached",
        path, run->replay.session.count - run->replay.next);
  }
  return cli_output_end(&run->saved, CLI_DONE) == CLI_DONE;
}

static void note(const cli_args_t *args, const char *what) {
  (void)cli_message(CLI_DONE, "note: --from %s: it came there %s", args->from,
                    what);
}

// Inputs are no part of the machine, so it may go on under others; but not
// without a word.
static void take_inputs(cli_run_t *run, const cli_args_t *args,
                        const cli_stand_t *stand) {
  const bool has_table = run->drive.table.count > 0;
  if (stand->inputs != cli_inputs_hash(&run->drive.table)) {
    note(args, stand->inputs == 0 ? "without --inputs"
               : has_table        ? "with another table of --inputs"
                                  : "with --inputs, and goes on without");
  }
  if (stand->held.source == TF_INPUT_SCENE) return;
  if (has_table) {
    note(args, "with inputs by a command, and goes on with --inputs");
    return;
  }
  tf_simulation_t *simulation = &run->replay.simulation;
  *simulation = stand->held;
  simulation->machine = run->system.machine.machine;
  simulation->stepped = simulation->source;
}

int cli_run_check_start(const cli_args_t *args, const cli_setup_t *setup,
                        const char *option, const char *path, uint32_t seed) {
  const cli_setting_t *setting = cli_setup_start_set(setup);
  if (setting != NULL) {
    return cli_message(CLI_USAGE, "%s %s: %s %s gives the state",
                       setting->option, setting->text, option, path);
  }
  if (args->select != NULL && strchr(args->select, ':') != NULL &&
      seed != setup->seed) {
    return cli_message(CLI_REFUSED,
                       "%s %s: the seed is %" PRIu32 " there and %" PRIu32
                       " here",
                       option, path, seed, setup->seed);
  }
  return CLI_DONE;
}

int cli_run_go_on(cli_run_t *run, const cli_args_t *args, cli_setup_t *setup) {
  const cli_stand_t *stand = &run->from;
  CLI_TRY(cli_run_check_start(args, setup, "--from", args->from,
                              stand->state.seed));
  if (stand->state.tick > run->steps) {
    return cli_message(CLI_REFUSED,
                       "--from %s: it stands at t = %.9g s, after the end at "
                       "%.9g s",
                       args->from, cli_run_time(run, stand->state.tick),
                       cli_run_time(run, run->steps));
  }
  take_inputs(run, args, stand);
  setup->seed = stand->state.seed;
  run->system.state = stand->state;
  run->system.low = stand->compensation;
  run->report = stand->report;
  run->first = run->done = stand->state.tick;
  (void)cli_drive_begin(&run->drive, &setup->machine, run->first);
  return CLI_DONE;
}
