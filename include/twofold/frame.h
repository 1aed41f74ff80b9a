/// @file
/// Frames on a serial line. docs/PROTOCOL.md describes them byte by byte:
///
///   00 | COBS( version type length sequence tick payload ) | CRC | 00
///
/// The CRC is computed over the bytes as they go over the line, after COBS, and
/// is sent as five bytes that are never 0. Computed before COBS, as is usual,
/// it would not be certain to detect any burst, because one wrong bit in a code
/// byte of COBS moves zeros anywhere in the frame. As it is, every burst of up
/// to 32 bits is detected before anything is decoded, unless it makes or
/// removes a zero; then it cuts or joins frames, which their length field
/// shows. With the zero in front, errors before a frame cannot damage it.
///
/// A payload has at most TF_FRAME_PAYLOAD bytes, so that COBS always takes one
/// more byte and works in place, in both directions.
#ifndef TWOFOLD_FRAME_H
#define TWOFOLD_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TF_FRAME_VERSION 2
/// Version, type, length, sequence (4) and tick (8).
#define TF_FRAME_HEADER 15
/// Where the payload has to be for tf_frame_seal.
#define TF_FRAME_AT (2 + TF_FRAME_HEADER)
/// Longest payload.
#define TF_FRAME_PAYLOAD 238
/// Bytes that a frame with so long a payload takes on the line.
#define TF_FRAME_SIZE(payload) ((payload) + TF_FRAME_HEADER + 8)
/// Size of the buffer of a decoder for payloads of up to so many bytes.
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
  uint32_t sequence;    ///< that is expected next
  bool started;         ///< a frame has been accepted
  bool overflowed;      ///< the present frame is longer than the buffer
  uint64_t tick;        ///< of the last frame
  uint32_t frames;      ///< accepted
  uint32_t bad;         ///< CRC, COBS or length wrong
  uint32_t too_long;    ///< longer than the buffer
  uint32_t bad_version; ///< correct, but of another version of the protocol
  uint32_t lost;        ///< missing sequence numbers
  uint32_t restarts;    ///< the sequence went back: the sender was restarted
} tf_decoder_t;

/// Completes a frame around its payload.
/// Scheme: none.
/// wire: in/out, TF_FRAME_SIZE(length) bytes; in, the payload at
///   wire + TF_FRAME_AT; out, the bytes for the line.
/// type: in. length: in, of the payload, 0 to TF_FRAME_PAYLOAD.
/// sequence: in/out, number of this frame; then that of the next.
/// tick: in.
/// Returns: TF_FRAME_SIZE(length); 0 where length is too large (wire and
///   sequence untouched).
/// Cost: at most 500 instructions and 23 a byte of payload. Stack: 64 B.
/// Memory: caller's, reentrant.
/// Claims: frames_survive_the_line, documented_frames_decode
#define tf_frame_seal TF_LINK(tf_frame_seal)
TF_API size_t tf_frame_seal(uint8_t *wire, uint8_t type, size_t length,
                            uint32_t *sequence, uint64_t tick);

/// Prepares a decoder.
/// Scheme: none.
/// decoder: out.
/// buffer: kept, size bytes (TF_DECODER_SIZE).
/// Returns: nothing.
/// Cost: at most 8 instructions. Stack: 16 B.
/// Memory: caller's, reentrant.
/// Claims: frames_survive_the_line
#define tf_decoder_init TF_LINK(tf_decoder_init)
TF_API void tf_decoder_init(tf_decoder_t *decoder, uint8_t *buffer,
                            uint16_t size);

/// Takes one byte from the line; it may be any byte at any time.
/// Scheme: none.
/// decoder: in/out. byte: in.
/// frame: out, written when a frame is complete.
/// Returns: whether frame holds a frame.
/// Cost: at most 550 instructions and 22 a byte of the payload, for the last
///   byte of a frame; else 10. Stack: 64 B.
/// Memory: caller's, reentrant.
/// Claims: every_single_bit_error_is_caught, every_burst_of_16_bits_is_caught,
///   broken_bytes_cost_only_the_frames_they_touch,
///   random_bytes_are_not_taken_for_frames, lost_frames_are_counted
#define tf_decoder_push TF_LINK(tf_decoder_push)
TF_API bool tf_decoder_push(tf_decoder_t *decoder, uint8_t byte,
                            tf_frame_t *frame);

/// Takes bytes from the line until a frame is complete.
/// Scheme: none.
/// decoder: in/out, left as tf_decoder_push would leave it.
/// bytes: in, length of them.
/// taken: out, how many were taken; call again with the others.
/// frame: out, written when a frame is complete.
/// Returns: whether frame holds a frame; if not, all bytes were taken.
/// Cost: at most 27 instructions and 33 a byte. Stack: 128 B.
/// Memory: caller's, no overlap with the buffer, reentrant.
/// Claims: block_decoder_is_the_byte_decoder
#define tf_decoder_block TF_LINK(tf_decoder_block)
TF_API bool tf_decoder_block(tf_decoder_t *decoder, const uint8_t *bytes,
                             size_t length, size_t *taken, tf_frame_t *frame);

#ifdef __cplusplus
}
#endif

#endif
