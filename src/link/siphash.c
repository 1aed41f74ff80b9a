// SipHash-2-4: two rounds a word of eight bytes, four at the end. Additions,
// rotations and exclusive ors: no table, no branch on a secret.
#include "siphash.h"

#include "twofold/wire.h"

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
