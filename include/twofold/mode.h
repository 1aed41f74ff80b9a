/// @file
/// The modes of contact.
#ifndef TWOFOLD_MODE_H
#define TWOFOLD_MODE_H

#include "twofold/real.h"

TF_BEGIN_C

/// The five modes of contact. + and - are the sign of h in slip, of g in stick.
typedef enum {
  TF_SLIP_PLUS,   ///< h > 0
  TF_SLIP_MINUS,  ///< h < 0
  TF_STICK_PLUS,  ///< h = 0, g > 0
  TF_STICK_MINUS, ///< h = 0, g < 0
  TF_PINNED       ///< h = g = 0
} tf_mode_t;
#define TF_MODES 5
#define TF_NO_MODE TF_MODES ///< none preferred, or none admissible
#define TF_MODE_BIT(mode) (1u << (mode))

/// "slip+" "slip-" "stick+" "stick-" "pinned".
#define tf_mode_name TF_LINK(tf_mode_name)
TF_API const char *tf_mode_name(unsigned mode);

/// Whether the contact slips.
static inline bool tf_mode_is_slip(unsigned mode) {
  return mode <= TF_SLIP_MINUS;
}

TF_END_C

#endif
