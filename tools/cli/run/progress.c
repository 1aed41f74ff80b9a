// Progress of long runs: on a terminal one line that is overwritten, in a log a
// line now and then. Nothing is shown for the first seconds, nor where the rows
// go to the same terminal and show the progress themselves.

#include "progress.h"

#include <stdio.h>
#include <unistd.h>

#include "../host/host.h"

#define PATIENCE 2.0   // [s] before the first message
#define REDRAW 0.2     // [s] between messages on a terminal
#define LOG_EVERY 10.0 // [s] between lines in a log

cli_progress_t cli_progress_start(double now, int output, bool live) {
  const bool terminal = cli_is_terminal(STDERR_FILENO);
  const cli_progress_t progress = {
      .silent = live || cli_is_terminal(output),
      .one_line = terminal,
      .started = now,
      .next = now + (terminal ? PATIENCE : LOG_EVERY)};
  return progress;
}

void cli_progress_poll(cli_progress_t *progress, double now,
                       const cli_run_t *run) {
  if (progress->silent || now < progress->next) {
    return;
  }
  const double done = (double)(run->done - run->first);
  const double share =
      run->steps > run->first ? done / (double)(run->steps - run->first) : 1.0;
  const double elapsed = now - progress->started;
  const double t = cli_run_time(run, run->done);
  const double left = share > 0 ? elapsed * (1 - share) / share : 0;
  (void)fprintf(stderr,
                "%s%5.1f %%  t = %.6g s of %.6g s  %.3g steps/s  %.3g x real "
                "time  %.0f s left%s",
                progress->one_line ? "\r" : "twofold: ", 100 * share, t,
                cli_run_time(run, run->steps), done / elapsed,
                done * (double)run->setup->machine.dt / elapsed, left,
                progress->one_line ? "\033[K" : "\n");
  (void)fflush(stderr);
  progress->shown = progress->one_line;
  progress->next = now + (progress->one_line ? REDRAW : LOG_EVERY);
}

void cli_progress_clear(cli_progress_t *progress) {
  if (progress->shown) {
    (void)fputs("\r\033[K", stderr);
    progress->shown = false;
  }
}
