/// @file
/// Numbers as bytes: little endian, whatever the processor. A real is sent as
/// the bits of its own type, so that nothing is rounded in between.
#ifndef TWOFOLD_WIRE_H
#define TWOFOLD_WIRE_H

#include "twofold/real.h"

TF_BEGIN_C

/// The unsigned integer that is as wide as tf_real_t.
#ifdef TF_REAL_FLOAT
typedef uint32_t tf_bits_t;
#else
typedef uint64_t tf_bits_t;
#endif
/// Bytes of a real on the wire: 4 or 8.
#define TF_REAL_BYTES sizeof(tf_real_t)
/// Does not compile where double has 4 bytes (avr-gcc): build for float there.
typedef char
    tf_real_is_as_wide_as_its_bits[sizeof(tf_real_t) == sizeof(tf_bits_t) ? 1
                                                                          : -1];

/// Writes the low bytes of a whole number.
/// at: out. value: in, taken modulo 2^(8 bytes). bytes: in, how many, 0 to 8.
/// Returns: the byte after the last one written.
static inline uint8_t *tf_wire_put(uint8_t *at, uint64_t value, size_t bytes) {
  for (size_t i = 0; i < bytes; i++, value >>= 8) *at++ = (uint8_t)value;
  return at;
}

/// Reads a whole number.
/// at: in. bytes: in, how many, 0 to 8.
static inline uint64_t tf_wire_get(const uint8_t *at, size_t bytes) {
  uint64_t value = 0;
  while (bytes > 0) value = value << 8 | at[--bytes];
  return value;
}

/// Writes a real.
/// at: out, TF_REAL_BYTES. value: in, any, NaN included.
/// Returns: the byte after the last one written.
static inline uint8_t *tf_wire_put_real(uint8_t *at, tf_real_t value) {
  const union {
    tf_real_t real;
    tf_bits_t bits;
  } as = {value};
  return tf_wire_put(at, as.bits, TF_REAL_BYTES);
}

/// Reads a real, bit for bit.
/// at: in, TF_REAL_BYTES.
static inline tf_real_t tf_wire_get_real(const uint8_t *at) {
  union {
    tf_real_t real;
    tf_bits_t bits;
  } as;
  as.bits = (tf_bits_t)tf_wire_get(at, TF_REAL_BYTES);
  return as.real;
}

TF_END_C

#endif
