/// @file
/// Frames on a serial line. docs/PROTOCOL.md has them byte by byte:
///
///   00 | COBS( version type length sequence tick payload ) | CRC | 00
///
/// The CRC is taken over the bytes as they go over the line, after COBS, and
/// is spelled in five bytes that are never 0. Taken before COBS, as is usual,
/// it would promise nothing about a burst: one wrong bit in a code byte of COBS
/// moves zeros anywhere in the frame. So every burst of up to 32 bits is found
/// before anything is unpacked. A burst that makes or removes a zero cuts or
/// joins frames, which the length finds. The zero in front keeps what went
/// wrong before a frame from costing the frame.
///
/// A payload has at most TF_FRAME_PAYLOAD bytes, so that COBS always costs one
/// byte and works in place, in both directions.
#ifndef TWOFOLD_FRAME_H
#define TWOFOLD_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

#define TF_FRAME_VERSION 1
/// Version, type, length, sequence (2) and tick (8).
#define TF_FRAME_HEADER 13
/// Where the payload stands before tf_frame_seal.
#define TF_FRAME_AT (2 + TF_FRAME_HEADER)
/// Longest payload.
#define TF_FRAME_PAYLOAD 240
/// Bytes on the line, exactly, of a frame with such a payload.
#define TF_FRAME_SIZE(payload) ((payload) + TF_FRAME_HEADER + 8)
/// Buffer of a decoder that takes payloads of up to so many bytes.
#define TF_DECODER_ROOM(payload) ((payload) + TF_FRAME_HEADER + 6)

/// A frame as received.
typedef struct {
  uint64_t tick;     ///< steps taken by the machine when it was made
  uint16_t sequence; ///< one more than in the frame before, modulo 2^16
  uint8_t type;
  uint8_t length;         ///< of the payload [bytes]
  const uint8_t *payload; ///< in the decoder's buffer, until its next byte
} tf_frame_t;

/// A decoder. Its counters only grow (modulo 2^32).
typedef struct {
  uint8_t *buffer; ///< caller's
  uint16_t room, used;
  uint16_t sequence;    ///< expected next
  bool started;         ///< a frame was accepted before
  bool overflowed;      ///< the present frame is longer than the buffer
  uint64_t tick;        ///< of the last frame
  uint32_t frames;      ///< accepted
  uint32_t bad;         ///< CRC, COBS or length wrong
  uint32_t too_long;    ///< longer than the buffer
  uint32_t bad_version; ///< whole, but of another version of the protocol
  uint32_t lost;        ///< by gaps of the sequence number
  uint32_t restarts;    ///< the sequence went back: the sender started again
} tf_decoder_t;

/// Completes a frame around its payload.
/// Scheme: none.
/// wire: in/out, TF_FRAME_SIZE(length) bytes; the payload stands at
///   wire + TF_FRAME_AT. Holds the bytes for the line.
/// type: in. length: in, of the payload, 0 to TF_FRAME_PAYLOAD.
/// sequence: in/out, number of this frame; one more.
/// tick: in.
/// Returns: TF_FRAME_SIZE(length); 0 where length is too large (wire and
///   sequence untouched).
/// Cost: at most 440 instructions and 23 a byte of payload. Stack: 48 B.
/// Memory: caller's, reentrant.
/// Claims: frames_survive_the_line, documented_frames_decode
#define tf_frame_seal TF_LINK(tf_frame_seal)
TF_API size_t tf_frame_seal(uint8_t *wire, uint8_t type, size_t length,
                            uint16_t *sequence, uint64_t tick);

/// Prepares a decoder.
/// Scheme: none.
/// decoder: out.
/// buffer: kept, room bytes; TF_DECODER_ROOM gives the room.
/// Returns: nothing.
/// Cost: at most 7 instructions. Stack: 16 B.
/// Memory: caller's, reentrant.
/// Claims: frames_survive_the_line
#define tf_decoder_init TF_LINK(tf_decoder_init)
TF_API void tf_decoder_init(tf_decoder_t *decoder, uint8_t *buffer,
                            uint16_t room);

/// Takes one byte from the line. Any byte at any time is allowed.
/// Scheme: none.
/// decoder: in/out. byte: in.
/// frame: out, written where a frame is complete.
/// Returns: whether frame holds a frame.
/// Cost: at most 490 instructions and 22 a byte of the payload, for the last
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
/// decoder: in/out, as tf_decoder_push would leave it.
/// bytes: in, length of them.
/// taken: out, how many were used; call again with the rest.
/// frame: out, written where a frame is complete.
/// Returns: whether frame holds a frame; false: all bytes were taken.
/// Cost: at most 30 instructions and 33 a byte. Stack: 128 B.
/// Memory: caller's, no overlap with the buffer, reentrant.
/// Claims: block_decoder_is_the_byte_decoder
#define tf_decoder_block TF_LINK(tf_decoder_block)
TF_API bool tf_decoder_block(tf_decoder_t *decoder, const uint8_t *bytes,
                             size_t length, size_t *taken, tf_frame_t *frame);

#endif
