/* frame_in.h - frames among the bytes of a line, for tests that know what has
 * to be there. A payload is valid until the next call. */
#ifndef TESTS_SUPPORT_FRAME_IN_H
#define TESTS_SUPPORT_FRAME_IN_H

#include "link/parts.h"
#include "tap.h"
#include "twofold.h"

/* The first frame of a type, or of any for 0; its type is 0 if none came. */
static inline tf_frame_t frame_in(const uint8_t *bytes, size_t length,
                                  uint8_t type) {
  static uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  tf_decoder_t decoder;
  tf_frame_t frame = {.payload = buffer};
  size_t taken = 0;
  tf_decoder_init(&decoder, buffer, sizeof buffer);
  while (tf_decoder_block(&decoder, bytes, length, &taken, &frame)) {
    if (type == 0 || frame.type == type) return frame;
    bytes += taken;
    length -= taken;
  }
  frame.type = frame.length = 0;
  return frame;
}

/* Bytes that are one frame and nothing else. */
static inline tf_frame_t frame_of(const uint8_t *wire, size_t size) {
  const tf_frame_t frame = frame_in(wire, size, 0);
  CHECK(frame.type != 0 && size == TF_FRAME_SIZE((size_t)frame.length));
  return frame;
}

/* Gives a frame that was changed the CRC that it then has. */
static inline void reseal(uint8_t *wire, size_t size) {
  uint32_t crc = tf_crc32(0, wire + 1, size - 7);
  for (size_t i = 0; i < 5; i++, crc >>= 7)
    wire[size - 6 + i] = (uint8_t)(0x80 | (crc & 0x7f));
}

/* The code of an answer. */
static inline int code_in(const tf_frame_t *answer) {
  const uint8_t code = answer->payload[5];
  return code < 128 ? code : code - 256;
}

#endif
