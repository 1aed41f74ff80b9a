// A command as a frame, and the tags of both directions: SipHash-2-4 of the
// frame's body before COBS, header included, which is all that the board acts
// on; behind the body of a frame from the board stands the nonce of its host.
// Types of frames go one way only, so no tag of one is a tag of the other.
#include "parts.h"
#include "twofold/link.h"

// SipHash has two rounds for each word of eight bytes and four at the end.
// Additions, rotations and exclusive ors: no table, no branch on a secret.
#define WORD 8u

typedef struct {
  uint64_t v0, v1, v2, v3;
} sip_t;

static uint64_t rotated(uint64_t x, unsigned by) {
  const unsigned back = 64u - by;
  return x << by | x >> back;
}

static void sip_rounds(sip_t *s, unsigned rounds) {
  for (; rounds > 0; rounds--) {
    s->v0 += s->v1;
    s->v2 += s->v3;
    s->v1 = rotated(s->v1, 13) ^ s->v0;
    s->v3 = rotated(s->v3, 16) ^ s->v2;
    s->v0 = rotated(s->v0, 32) + s->v3;
    s->v2 += s->v1;
    s->v1 = rotated(s->v1, 17) ^ s->v2;
    s->v3 = rotated(s->v3, 21) ^ s->v0;
    s->v2 = rotated(s->v2, 32);
  }
}

static void sip_word(sip_t *s, uint64_t word) {
  s->v3 ^= word;
  sip_rounds(s, 2);
  s->v0 ^= word;
}

TF_API uint64_t tf_siphash(const uint8_t *key, const uint8_t *bytes,
                           size_t length) {
  const uint64_t k0 = tf_wire_get(key, WORD),
                 k1 = tf_wire_get(key + WORD, WORD);
  sip_t s = {k0 ^ 0x736f6d6570736575u, k1 ^ 0x646f72616e646f6du,
             k0 ^ 0x6c7967656e657261u, k1 ^ 0x7465646279746573u};
  const size_t whole = length / WORD, at = whole * WORD;
  for (size_t i = 0; i < whole; i++)
    sip_word(&s, tf_wire_get(bytes + i * WORD, WORD));
  // The last word: the bytes that are left, and the length modulo 256.
  sip_word(&s, tf_wire_get(bytes + at, length - at) | (uint64_t)length << 56);
  s.v2 ^= 0xffu;
  sip_rounds(&s, 4);
  return s.v0 ^ s.v1 ^ s.v2 ^ s.v3;
}

// All of it is compared, so that the time does not betray how many bytes of a
// guess were right.
TF_API bool tf_has_tag(const tf_frame_t *frame, const uint8_t *key) {
  if (frame->length < TF_TAG_BYTES) return false;
  const uint8_t *body = frame->payload - TF_FRAME_HEADER;
  const size_t tagged = TF_FRAME_HEADER + (frame->length - TF_TAG_BYTES);
  const uint64_t wrong =
      tf_siphash(key, body, tagged) ^ tf_wire_get(body + tagged, TF_TAG_BYTES);
  return ((uint32_t)wrong | (uint32_t)(wrong >> 32)) == 0;
}

TF_API size_t tf_command_seal(uint8_t *wire, uint8_t type, size_t length,
                              uint32_t session, uint32_t *sequence,
                              uint64_t tick, const uint8_t *key) {
  if (length > TF_COMMAND_MOST) return 0;
  if (type == TF_UP_DESCRIBE) {
    if (length == 0) return tf_frame_seal(wire, type, 0, sequence, tick);
    session = 0;
    key = NULL;
  }
  (void)tf_wire_put(wire + TF_FRAME_AT, session, TF_SESSION_BYTES);
  size_t payload = TF_SESSION_BYTES + length;
  if (key != NULL) {
    const size_t tagged = TF_FRAME_HEADER + payload;
    payload += TF_TAG_BYTES;
    (void)tf_frame_header(wire, type, payload, *sequence, tick);
    (void)tf_wire_put(wire + 2 + tagged, tf_siphash(key, wire + 2, tagged),
                      TF_TAG_BYTES);
  }
  return tf_frame_seal(wire, type, payload, sequence, tick);
}

TF_API size_t tf_frame_vouch(uint8_t *wire, size_t size, const uint8_t *key,
                             uint64_t nonce) {
  const size_t stuffed = size - 2 - TF_FRAME_CRC, tagged = stuffed - 1;
  uint8_t *body = wire + 2;
  (void)tf_unstuff(wire + 1, stuffed);
  uint32_t sequence = (uint32_t)tf_wire_get(body + 3, 4);
  const size_t length = tagged - TF_FRAME_HEADER + TF_TAG_BYTES;
  body[2] = (uint8_t)length;
  (void)tf_wire_put(body + tagged, nonce, TF_NONCE_BYTES);
  (void)tf_wire_put(body + tagged,
                    tf_siphash(key, body, tagged + TF_NONCE_BYTES),
                    TF_TAG_BYTES);
  return tf_frame_seal(wire, body[1], length, &sequence,
                       tf_wire_get(body + 7, 8));
}

TF_API bool tf_frame_is_vouched(const tf_frame_t *frame, const uint8_t *key,
                                uint64_t nonce) {
  uint8_t bytes[TF_FRAME_HEADER + TF_FRAME_PAYLOAD];
  const uint8_t *body = frame->payload - TF_FRAME_HEADER;
  if (frame->length < TF_TAG_BYTES) return false;
  const size_t tagged = TF_FRAME_HEADER + (frame->length - TF_TAG_BYTES);
  for (size_t i = 0; i < tagged; i++) bytes[i] = body[i];
  (void)tf_wire_put(bytes + tagged, nonce, TF_NONCE_BYTES);
  return tf_siphash(key, bytes, tagged + TF_NONCE_BYTES) ==
         tf_wire_get(body + tagged, TF_TAG_BYTES);
}
