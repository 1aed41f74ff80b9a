/// @file
/// The live view of `monitor`: a few lines of a terminal, overwritten.
#ifndef TWOFOLD_CLI_VIEW_H
#define TWOFOLD_CLI_VIEW_H

#include "picture.h"

/// Modes that the ribbon shows, the newest last.
#define CLI_VIEW_RIBBON 60

typedef struct {
  bool drawn;      ///< lines stand there
  double next;     ///< cli_now() of the next drawing
  double since;    ///< cli_now() of the last one, for the rate
  uint32_t frames; ///< by then
  double rate;     ///< frames a second
  uint8_t ribbon[CLI_VIEW_RIBBON];
  size_t used;
} cli_view_t;

/// Notes the mode of a row in the ribbon: a mark where it changes.
void cli_view_note(cli_view_t *view, uint8_t mode);

/// Draws, if it is time.
void cli_view_poll(cli_view_t *view, const cli_picture_t *picture,
                   const tf_decoder_t *decoder, const char *name, double now);

#endif
