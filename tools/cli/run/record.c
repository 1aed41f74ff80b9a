// What a run counts, step by step.

#include "record.h"

#include <math.h>

double cli_run_time(const cli_run_t *run, uint64_t steps) {
  return (double)steps * (double)run->setup->machine.dt;
}

void cli_run_observe(cli_run_t *run, const tf_report_t *after) {
  const double t = cli_run_time(run, run->done);
  cli_events_observe(&run->events, &run->report, after, &run->system.state, t);
  if (after->choices > 1 && run->ambiguous_steps++ == 0) {
    run->ambiguous_since = t;
  }
  tf_tally_count(&run->tally, run->done, after->status);
  if (after->mode > TF_SLIP_MINUS) {
    run->largest_h = fmax(run->largest_h, fabs((double)after->slip.h));
  }
  run->largest_residual = fmax(run->largest_residual, (double)after->residual);
  run->report = *after;
}
