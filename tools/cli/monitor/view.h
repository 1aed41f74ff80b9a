/// @file
/// The live view of `monitor`: a few lines of a terminal that are overwritten.
#ifndef TWOFOLD_CLI_VIEW_H
#define TWOFOLD_CLI_VIEW_H

#include "receiver.h"

/// Length of the history of modes, the newest last.
#define CLI_VIEW_HISTORY 60

typedef struct {
  bool drawn;      ///< the lines are on the screen
  double next;     ///< cli_now() of the next drawing
  double since;    ///< cli_now() of the last one, for the rate
  uint32_t frames; ///< number of frames at that time
  double rate;     ///< frames per second
  uint8_t history[CLI_VIEW_HISTORY];
  size_t used;
} cli_view_t;

/// Appends the mode of a row to the history if it is a new one.
void cli_view_note(cli_view_t *view, uint8_t mode);

/// Draws the lines if it is time to.
void cli_view_poll(cli_view_t *view, const cli_receiver_t *receiver,
                   const tf_decoder_t *decoder, const char *name, double now);

#endif
