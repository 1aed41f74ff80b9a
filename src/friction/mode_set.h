// Signs of h and g, and sets of modes, bits TF_MODE_BIT(mode).
#ifndef TF_MODE_SET_H
#define TF_MODE_SET_H

#include <stdint.h>

#include "../num/kernel.h"
#include "twofold/contact.h"

#define SLIPS (TF_MODE_BIT(TF_SLIP_PLUS) | TF_MODE_BIT(TF_SLIP_MINUS))
#define STICKS (TF_MODE_BIT(TF_STICK_PLUS) | TF_MODE_BIT(TF_STICK_MINUS))

// The sign of h or of g. It is also the index of an array that has an entry for
// each sign.
typedef enum { PLUS, MINUS } sign_t;

TF_INLINE sign_t sign_of(tf_real_t x) { return x < 0 ? MINUS : PLUS; }

TF_INLINE sign_t opposite(sign_t s) { return s == PLUS ? MINUS : PLUS; }

// With that sign: 1, and x.
TF_INLINE tf_real_t unit(sign_t s) {
  return s == PLUS ? TF_R(1.0) : TF_R(-1.0);
}

TF_INLINE tf_real_t with_sign(sign_t s, tf_real_t x) {
  return s == PLUS ? x : -x;
}

// The slip with that sign of h, the stick with that sign of g, and back.
TF_INLINE unsigned slip_with(sign_t s) { return TF_SLIP_PLUS + (unsigned)s; }

TF_INLINE unsigned stick_with(sign_t s) { return TF_STICK_PLUS + (unsigned)s; }

TF_INLINE sign_t sign_in(unsigned mode) { return mode & 1u ? MINUS : PLUS; }

TF_INLINE bool is_slip(unsigned mode) { return tf_mode_is_slip(mode); }

TF_INLINE bool is_stick(unsigned mode) {
  return mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
}

TF_INLINE bool has(unsigned set, unsigned mode) { return (set >> mode) & 1u; }

// Whether a mode that is consistent goes on under every rule, so that
// tf_contact_choose has nothing to decide.
TF_INLINE bool continues(unsigned set, unsigned attracting, unsigned mode) {
  return set & TF_MODE_BIT(mode) & (SLIPS | attracting);
}

TF_INLINE unsigned size_of(unsigned set) {
  static const uint8_t sizes[1u << TF_MODES] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2,
                                                3, 2, 3, 3, 4, 1, 2, 2, 3, 2, 3,
                                                3, 4, 2, 3, 3, 4, 3, 4, 4, 5};
  return sizes[set];
}

// The slip that an end has; at h = 0, which no set-valued law lets it have in
// slip, the side on which it was.
TF_INLINE unsigned slip_of_sign(tf_real_t h, unsigned before) {
  return slip_with(h > 0 || h < 0 ? sign_of(h) : sign_in(before));
}

#endif
