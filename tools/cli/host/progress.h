/// @file
/// The progress of long work, for a person who waits: on a terminal one line
/// that is overwritten, in a log a line now and then. Nothing is shown for the
/// first seconds.
#ifndef TWOFOLD_CLI_PROGRESS_H
#define TWOFOLD_CLI_PROGRESS_H

#include <stdbool.h>

#include "../text/message.h"

typedef struct {
  bool silent;    ///< something else shows how far the work is
  bool one_line;  ///< standard error is a terminal: the line is overwritten
  bool shown;     ///< the line is on the screen
  double started; ///< cli_now()
  double next;    ///< cli_now() of the next message
} cli_progress_t;

/// Starts it.
/// output: in, descriptor that the rows go to: on a terminal they show the
/// progress themselves. -1: none.
cli_progress_t cli_progress_start(double now, int output);

/// Whether it is time for a message.
bool cli_progress_due(const cli_progress_t *progress, double now);

/// Prints a message and the time left, as if the rest of the work went at the
/// mean speed of what is done.
/// share: in, of the work that is done, 0: none, and no time left is told.
/// format: in, of the message, which says what is done.
void cli_progress_say(cli_progress_t *progress, double now, double share,
                      const char *format, ...) CLI_PRINTF(4, 5);

/// Removes the line from the screen.
void cli_progress_clear(cli_progress_t *progress);

#endif
