// Frames on a serial line: COBS in place, the CRC over the bytes of the line,
// and a decoder that takes any byte at any time. Payloads are only bytes here.
#include "twofold/frame.h"

#include "parts.h"

// Of a frame without its zeros: COBS code, header and CRC.
#define SHORTEST (1 + TF_FRAME_HEADER + TF_FRAME_CRC)

// Reflected, polynomial 0xEDB88320, four bits at a time: a table of 16 words
// instead of 256, for boards whose constants lie in RAM.
TF_API uint32_t tf_crc32(uint32_t crc, const uint8_t *bytes, size_t length) {
  static const uint32_t table[16] = {
      0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu,
      0x76dc4190u, 0x6b6b51f4u, 0x4db26158u, 0x5005713cu,
      0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu,
      0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu};
  crc = ~crc;
  for (size_t i = 0; i < length; i++) {
    crc ^= bytes[i];
    crc = crc >> 4 ^ table[crc & 15u];
    crc = crc >> 4 ^ table[crc & 15u];
  }
  return ~crc;
}

// Seven bits a byte, the lowest first, and the top bit set: no byte is zero.
// The bits follow the data in the order of a code word of the CRC, so that
// bursts are detected across the boundary of the two as well.
static void put_crc(uint8_t *at, uint32_t crc) {
  for (unsigned i = 0; i < TF_FRAME_CRC; i++, crc >>= 7)
    at[i] = (uint8_t)(0x80u | (crc & 0x7fu));
}

static bool has_crc(const uint8_t *at, uint32_t crc) {
  uint8_t wanted[TF_FRAME_CRC];
  unsigned wrong = 0;
  put_crc(wanted, crc);
  for (unsigned i = 0; i < TF_FRAME_CRC; i++)
    wrong |= (unsigned)at[i] ^ wanted[i];
  return wrong == 0;
}

// COBS of fewer than 255 bytes: each zero becomes the distance to the next
// zero, or to the end; the distance to the first one is in front.
static void stuff(uint8_t *code, const uint8_t *end) {
  uint8_t *last = code;
  for (uint8_t *at = code + 1; at < end; at++) {
    if (*at != 0) continue;
    *last = (uint8_t)(at - last);
    last = at;
  }
  *last = (uint8_t)(end - last);
}

TF_API bool tf_unstuff(uint8_t *code, size_t length) {
  size_t next = code[0];
  for (size_t at = 1; at < length; at++)
    if (at == next) {
      next += code[at];
      code[at] = 0;
    }
  return next == length;
}

TF_API uint8_t *tf_frame_header(uint8_t *wire, uint8_t type, size_t length,
                                uint32_t sequence, uint64_t tick) {
  uint8_t *at = wire + 2;
  *at++ = TF_FRAME_VERSION;
  *at++ = type;
  *at++ = (uint8_t)length;
  return tf_wire_put(tf_wire_put(at, sequence, 4), tick, 8);
}

TF_API size_t tf_frame_seal(uint8_t *wire, uint8_t type, size_t length,
                            uint32_t *sequence, uint64_t tick) {
  if (length > TF_FRAME_PAYLOAD) return 0;
  uint8_t *at = tf_frame_header(wire, type, length, *sequence, tick) + length;
  stuff(wire + 1, at);
  put_crc(at, tf_crc32(0, wire + 1, (size_t)(at - wire) - 1));
  at += TF_FRAME_CRC;
  wire[0] = 0;
  *at++ = 0;
  ++*sequence;
  return (size_t)(at - wire);
}

TF_API uint32_t tf_frame_chain(uint32_t before, const uint8_t *crc) {
  return tf_crc32(before, crc, TF_FRAME_CRC);
}

TF_API void tf_decoder_init(tf_decoder_t *decoder, uint8_t *buffer,
                            uint16_t size) {
  *decoder = (tf_decoder_t){.buffer = buffer, .size = size};
}

// A gap in the sequence is a loss, unless the number went back: then the sender
// was restarted. A gap of less than half of all numbers that passes 0 may be
// either; there the tick decides. (The tick alone cannot: an answer may have an
// earlier tick than the records that were sent before it.)
static void count_accepted(tf_decoder_t *decoder, const tf_frame_t *frame) {
  const uint32_t gap = frame->sequence - decoder->sequence;
  if (decoder->started && gap != 0) {
    const bool through_0 = frame->sequence < gap;
    if (gap >= 0x80000000u || (through_0 && frame->tick < decoder->tick))
      decoder->restarts++;
    else
      decoder->lost += gap;
  }
  decoder->started = true;
  decoder->sequence = frame->sequence + 1u;
  decoder->tick = frame->tick;
  decoder->frames++;
}

// Undoes COBS in the buffer. Returns: the counter of the fault that its bytes
// have; NULL where they are a frame.
static uint32_t *fault_of(tf_decoder_t *decoder) {
  uint8_t *code = decoder->buffer;
  const size_t stuffed = (size_t)decoder->used - TF_FRAME_CRC; // if so many
  if (decoder->overflowed) return &decoder->too_long;
  if (decoder->used < SHORTEST ||
      !has_crc(code + stuffed, tf_crc32(0, code, stuffed)) ||
      !tf_unstuff(code, stuffed))
    return &decoder->bad;
  if (code[1] != TF_FRAME_VERSION) {
    decoder->version = code[1];
    return &decoder->bad_version;
  }
  return code[3] != stuffed - 1 - TF_FRAME_HEADER ? &decoder->bad : NULL;
}

// A zero ends what stands in the buffer. Returns: whether it is a frame.
static bool complete_frame(tf_decoder_t *decoder, tf_frame_t *frame) {
  if (decoder->used == 0) return false; // two zeros in a row
  uint32_t *fault = fault_of(decoder);
  decoder->used = 0;
  decoder->overflowed = false;
  if (fault != NULL) {
    ++*fault;
    return false;
  }
  const uint8_t *header = decoder->buffer + 1;
  *frame = (tf_frame_t){.tick = tf_wire_get(header + 7, 8),
                        .sequence = (uint32_t)tf_wire_get(header + 3, 4),
                        .type = header[1],
                        .length = header[2],
                        .payload = header + TF_FRAME_HEADER};
  count_accepted(decoder, frame);
  return true;
}

TF_API bool tf_decoder_push(tf_decoder_t *decoder, uint8_t byte,
                            tf_frame_t *frame) {
  if (byte == 0) return complete_frame(decoder, frame);
  if (decoder->used < decoder->size)
    decoder->buffer[decoder->used++] = byte;
  else
    decoder->overflowed = true;
  return false;
}

TF_API bool tf_decoder_block(tf_decoder_t *decoder, const uint8_t *bytes,
                             size_t length, size_t *taken, tf_frame_t *frame) {
  const size_t size = decoder->size;
  uint8_t *buffer = decoder->buffer;
  size_t at = 0;
  bool is_complete = false;
  while (at < length && !is_complete) {
    size_t used = decoder->used;
    while (at < length && bytes[at] != 0 && used < size)
      buffer[used++] = bytes[at++];
    decoder->used = (uint16_t)used;
    if (at < length) is_complete = tf_decoder_push(decoder, bytes[at++], frame);
  }
  *taken = at;
  return is_complete;
}
