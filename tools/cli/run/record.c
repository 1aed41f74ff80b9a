// What a run counts, step by step.

#include "record.h"

#include <math.h>

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
