/// @file
/// Groups of modes, for the commands that follow a motion.
#ifndef TWOFOLD_CLI_MODES_H
#define TWOFOLD_CLI_MODES_H

#include <stdbool.h>

#include "twofold.h"

static inline bool cli_is_slip(unsigned mode) { return mode <= TF_SLIP_MINUS; }

/// Stick does not include pinned.
static inline bool cli_is_stick(unsigned mode) {
  return mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
}

/// The stick for a sign of g, and the sign of g of a stick.
static inline unsigned cli_stick_mode(double g) {
  return g < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
}
static inline double cli_stick_sign(unsigned mode) {
  return mode == TF_STICK_MINUS ? -1 : 1;
}

#endif
