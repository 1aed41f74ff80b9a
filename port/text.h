/// @file
/// Whole numbers and words as text, without a C library.
#ifndef TWOFOLD_PORT_TEXT_H
#define TWOFOLD_PORT_TEXT_H

#include <stdint.h>

/// A line being written. The caller provides room for it.
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

/// A name and a whole number.
static inline void text_pair(text_t *text, const char *name, uint32_t value) {
  text_string(text, name);
  text_whole(text, value, 1);
}

/// 64 bits in hexadecimal, 16 digits.
static inline void text_hex(text_t *text, uint64_t bits) {
  for (int shift = 60; shift >= 0; shift -= 4)
    text_byte(text, "0123456789ABCDEF"[(bits >> shift) & 15u]);
}

#endif
