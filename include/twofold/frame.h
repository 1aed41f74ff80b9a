/// @file
/// Frames on a serial line. docs/PROTOCOL.md describes them byte by byte:
///   00 | COBS( version type length sequence tick payload ) | CRC | 00
///
/// The CRC is that of the bytes as they go over the line: every burst of up to
/// 32 bits is detected before anything is decoded (but see section 1 there). A
/// payload is so short that COBS always takes one more byte and works in place,
/// in both directions.
///
/// Numbers in it are little endian, whatever the processor. A real is sent as
/// the bits of its own type, so that nothing is rounded in between.
#ifndef TWOFOLD_FRAME_H
#define TWOFOLD_FRAME_H

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

#define TF_FRAME_VERSION 5
/// Version, type, length, sequence (4) and tick (8); then the payload and CRC.
#define TF_FRAME_HEADER 15
#define TF_FRAME_CRC 5
/// Where the payload has to be for tf_frame_seal.
#define TF_FRAME_AT (2 + TF_FRAME_HEADER)
/// Longest payload.
#define TF_FRAME_PAYLOAD 238
/// Bytes that a frame with this payload takes on the line.
#define TF_FRAME_SIZE(payload) ((payload) + TF_FRAME_HEADER + 8)
/// Size of a decoder's buffer for payloads of up to this size.
#define TF_DECODER_SIZE(payload) ((payload) + TF_FRAME_HEADER + 6)

/// A frame as received.
typedef struct {
  uint64_t tick;     ///< steps that the machine had taken when it was sent
  uint32_t sequence; ///< one more than that of the frame before, modulo 2^32
  uint8_t type;
  uint8_t length;         ///< of the payload [bytes]
  const uint8_t *payload; ///< in the decoder's buffer, until its next byte
} tf_frame_t;

/// A decoder. Its counters only grow (modulo 2^32).
typedef struct {
  uint8_t *buffer; ///< the caller's
  uint16_t size, used;
  uint32_t sequence;    ///< the one expected next
  bool started;         ///< a frame has been accepted
  bool overflowed;      ///< the present frame is longer than the buffer
  uint64_t tick;        ///< of the last frame
  uint32_t frames;      ///< accepted
  uint32_t bad;         ///< CRC, COBS or length wrong
  uint32_t too_long;    ///< longer than the buffer
  uint32_t bad_version; ///< correct, but of another version of the protocol
  uint8_t version;      ///< that of the last of them
  uint32_t lost;        ///< missing sequence numbers
  uint32_t restarts;    ///< the sequence went back: the sender was restarted
} tf_decoder_t;

/// Completes a frame around its payload.
/// wire: in/out, TF_FRAME_SIZE(length) bytes; in, the payload at
///   wire + TF_FRAME_AT; out, the bytes for the line.
/// type, tick: in. length: in, of the payload, 0 to TF_FRAME_PAYLOAD.
/// sequence: in/out, number of this frame; then that of the next.
/// Returns: TF_FRAME_SIZE(length); 0 where length is too large (wire and
///   sequence untouched).
#define tf_frame_seal TF_LINK(tf_frame_seal)
TF_API size_t tf_frame_seal(uint8_t *wire, uint8_t type, size_t length,
                            uint32_t *sequence, uint64_t tick);

/// CRC-32 over all CRCs of a sender so far; heartbeats carry it.
/// before: in, the chain up to the last frame, 0 before the first. crc: in,
///   TF_FRAME_CRC bytes, on the line or behind the payload in a decoder.
#define tf_frame_chain TF_LINK(tf_frame_chain)
TF_API uint32_t tf_frame_chain(uint32_t before, const uint8_t *crc);

/// Prepares a decoder.
/// decoder: out. buffer: kept, size bytes (TF_DECODER_SIZE).
#define tf_decoder_init TF_LINK(tf_decoder_init)
TF_API void tf_decoder_init(tf_decoder_t *decoder, uint8_t *buffer,
                            uint16_t size);

/// Takes one byte from the line; it may be any byte at any time.
/// decoder: in/out. byte: in. frame: out, written when a frame is complete.
/// Returns: whether frame holds a frame.
#define tf_decoder_push TF_LINK(tf_decoder_push)
TF_API bool tf_decoder_push(tf_decoder_t *decoder, uint8_t byte,
                            tf_frame_t *frame);

/// Takes bytes from the line until a frame is complete.
/// decoder: in/out, left as tf_decoder_push would leave it.
/// bytes: in, length of them, outside the decoder's buffer. taken: out, how
///   many were taken; call again with the others. frame: out, as there.
/// Returns: whether frame holds a frame; if not, all bytes were taken.
#define tf_decoder_block TF_LINK(tf_decoder_block)
TF_API bool tf_decoder_block(tf_decoder_t *decoder, const uint8_t *bytes,
                             size_t length, size_t *taken, tf_frame_t *frame);

TF_END_C

#endif
