// Progress, so that no work of more than five seconds is silent.

#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

#include "host.h"

#define PATIENCE 2.0   // [s] before the first message
#define REDRAW 0.2     // [s] between messages on a terminal
#define LOG_EVERY 10.0 // [s] between lines in a log

cli_progress_t cli_progress_start(double now, int output) {
  return (cli_progress_t){.silent = output >= 0 && cli_is_terminal(output),
                          .one_line = cli_is_terminal(STDERR_FILENO),
                          .started = now,
                          .next = now + PATIENCE};
}

bool cli_progress_due(const cli_progress_t *progress, double now) {
  return !progress->silent && now >= progress->next;
}

void cli_progress_say(cli_progress_t *progress, double now, double share,
                      const char *format, ...) {
  va_list arguments;
  (void)fputs(progress->one_line ? "\r" : "twofold: ", stderr);
  va_start(arguments, format);
  (void)vfprintf(stderr, format, arguments);
  va_end(arguments);
  if (share > 0) {
    (void)fprintf(stderr, ", %.0f s left",
                  (now - progress->started) * (1 - share) / share);
  }
  (void)fputs(progress->one_line ? "\033[K" : "\n", stderr);
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
