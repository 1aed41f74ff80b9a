// What a run counts, step by step.

#include "record.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "../setup/names.h"
#include "../text/buffer.h"

void cli_run_show(const cli_run_t *run) {
  const tf_state_t *state = &run->system.state;
  const tf_report_t *report = &run->report;
  const cli_live_point_t point = {cli_run_time(run, run->done),
                                  (double)state->r,
                                  (double)state->v,
                                  (double)state->w,
                                  (double)report->slip.h,
                                  (double)report->slip.g,
                                  report->mode,
                                  report->choices};
  cli_live_note(run->live, &point);
}

cli_setup_t cli_run_setup(const cli_run_t *run) {
  cli_setup_t setup = *run->setup;
  if (run->replays) {
    setup.params = run->replay.link.params;
  }
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
    if (draws) {
      cli_add_form(&text, ":%" PRIu64, (uint64_t)now.seed);
    }
  }
  return text.used;
}

double cli_run_time(const cli_run_t *run, uint64_t steps) {
  return (double)steps * (double)run->setup->machine.dt;
}

void cli_run_observe(cli_run_t *run, const tf_report_t *after) {
  const double t = cli_run_time(run, run->done);
  cli_events_observe(&run->events, &run->report, after, &run->system.state, t);
  cli_ambiguity_see(&run->ambiguity, after, t);
  tf_tally_count(&run->tally, run->done, after->status);
  if (after->mode > TF_SLIP_MINUS) {
    run->largest_h = fmax(run->largest_h, fabs((double)after->slip.h));
  }
  run->largest_residual = fmax(run->largest_residual, (double)after->residual);
  run->report = *after;
  cli_run_show(run);
}
