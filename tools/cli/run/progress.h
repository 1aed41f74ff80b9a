/// @file
/// The progress of a run, for a person who waits.
#ifndef TWOFOLD_CLI_PROGRESS_H
#define TWOFOLD_CLI_PROGRESS_H

#include "record.h"

typedef struct {
  bool silent;    ///< rows or a picture go to the same terminal
  bool one_line;  ///< standard error is a terminal: the line is overwritten
  bool shown;     ///< the line is on the screen
  double started; ///< cli_now()
  double next;    ///< cli_now() of the next message
} cli_progress_t;

/// Starts it. output: descriptor that the rows go to. live: a picture shows the
/// progress itself.
cli_progress_t cli_progress_start(double now, int output, bool live);

/// Prints a message if it is time for one.
void cli_progress_poll(cli_progress_t *progress, double now,
                       const cli_run_t *run);

/// Removes the line from the screen.
void cli_progress_clear(cli_progress_t *progress);

#endif
