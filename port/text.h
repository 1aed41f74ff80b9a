/// @file
/// Telemetry as text, without a C library: "name:value" in decimal, separated
/// by blanks, a line a record. Arduino's and Serial Studio's plotters read it.
#ifndef TWOFOLD_PORT_TEXT_H
#define TWOFOLD_PORT_TEXT_H

#include <stdint.h>

#include "twofold/real.h"

/// A line in the making. Who makes it sees to the room.
typedef struct {
  uint8_t *end; ///< where the next byte goes
} text_t;

static inline void text_byte(text_t *text, char byte) {
  *text->end++ = (uint8_t)byte;
}

static inline void text_string(text_t *text, const char *from) {
  while (*from) text_byte(text, *from++);
}

/// A whole number, at least `digits` digits of it.
static inline void text_whole(text_t *text, uint32_t value, unsigned digits) {
  char reversed[10];
  unsigned n = 0;
  while (value != 0 || n < digits) {
    reversed[n++] = (char)('0' + value % 10u);
    value /= 10u;
  }
  while (n > 0) text_byte(text, reversed[--n]);
}

/// A real, to six decimals; "over" where |value| >= 4000 or NaN.
static inline void text_real(text_t *text, tf_real_t value) {
  if (!(value > -4000 && value < 4000)) {
    text_string(text, "over");
    return;
  }
  const tf_real_t size = value < 0 ? -value : value;
  const uint32_t millionths = (uint32_t)(size * TF_R(1e6) + TF_R(0.5));
  if (value < 0 && millionths > 0) text_byte(text, '-');
  text_whole(text, millionths / 1000000u, 1);
  text_byte(text, '.');
  text_whole(text, millionths % 1000000u, 6);
}

/// 64 bits in hexadecimal, 16 digits.
static inline void text_hex(text_t *text, uint64_t bits) {
  for (int shift = 60; shift >= 0; shift -= 4)
    text_byte(text, "0123456789ABCDEF"[(bits >> shift) & 15u]);
}

#endif
