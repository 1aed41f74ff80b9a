// The line: any byte at any time, any length up to the longest.
#include <stddef.h>

#include "any.h"
#include "twofold/frame.h"

static uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];

// A frame of any length around any payload. A length beyond the longest is
// refused.
ENTRY(seal_any) {
  uint32_t sequence;
  ANY_BITS(wire);
  ANY_BITS(sequence);
  tf_frame_seal(wire, Frama_C_unsigned_char_interval(0, 255),
                Frama_C_size_t_interval(0, ~(size_t)0), &sequence,
                Frama_C_unsigned_long_interval(0, ~0ul));
  //@ check reached: \false;
}

// The payload of a frame is all there.
static unsigned read_whole(const tf_frame_t *frame) {
  unsigned sum = 0;
  for (unsigned i = 0; i < frame->length; i++) sum += frame->payload[i];
  return sum;
}

static void push_once(tf_decoder_t *decoder) {
  tf_frame_t frame;
  if (tf_decoder_push(decoder, Frama_C_unsigned_char_interval(0, 255), &frame))
    read_whole(&frame);
}

// One byte after the other, without an end, into the largest buffer and into
// one that holds no whole frame.
ENTRY(push_any) {
  static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  tf_decoder_t decoder;
  const int room = any_bool() ? (int)sizeof buffer : 3;
  //@ split room;
  tf_decoder_init(&decoder, buffer, (uint16_t)room);
  //@ loop widen_hints "all", 3, sizeof(buffer);
  while (any_bool()) push_once(&decoder);
  //@ check reached: \false;
}

// The same in blocks of any length.
ENTRY(block_any) {
  static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  uint8_t bytes[40];
  tf_decoder_t decoder;
  tf_frame_t frame;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
  //@ loop widen_hints "all", sizeof(buffer);
  while (any_bool()) {
    size_t taken;
    ANY_BITS(bytes);
    tf_decoder_block(&decoder, bytes, Frama_C_size_t_interval(0, sizeof bytes),
                     &taken, &frame);
  }
  //@ check reached: \false;
}

// And of a few bytes into a small buffer, with every fill of it apart: there
// the analyser knows that what is appended fits what is left.
ENTRY(block_small) {
  uint8_t buffer[TF_DECODER_SIZE(2)], bytes[3];
  tf_decoder_t decoder;
  tf_frame_t frame;
  size_t taken;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
  const int used = Frama_C_interval(0, sizeof buffer);
  //@ split used;
  const int length = Frama_C_interval(0, sizeof bytes);
  //@ split length;
  ANY_BITS(buffer);
  ANY_BITS(bytes);
  decoder.used = (uint16_t)used;
  decoder.overflowed = any_bool();
  decoder.started = any_bool();
  tf_decoder_block(&decoder, bytes, (size_t)length, &taken, &frame);
  //@ check reached: \false;
}
