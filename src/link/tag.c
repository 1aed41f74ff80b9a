// The tags of frames. A tag is that of the frame's body before it, version
// included, which COBS has given back or not yet touched.
#include "header.h"
#include "siphash.h"
#include "twofold/command.h"
#include "twofold/wire.h"

// All of it is compared, so that the time does not tell how many bytes of a
// guess were right.
TF_API bool tf_has_tag(const tf_frame_t *frame, const uint8_t *key) {
  if (frame->length < TF_TAG_BYTES) return false;
  const uint8_t *body = frame->payload - TF_FRAME_HEADER;
  const size_t tagged = TF_FRAME_HEADER + (frame->length - TF_TAG_BYTES);
  const uint64_t wrong =
      tf_siphash(key, body, tagged) ^ tf_wire_get(body + tagged, TF_TAG_BYTES);
  return ((uint32_t)wrong | (uint32_t)(wrong >> 32)) == 0;
}

// The frame is opened, made longer and sealed again: so whoever makes frames
// knows nothing of tags.
TF_API size_t tf_frame_tag(uint8_t *wire, size_t size, uint32_t session,
                           const uint8_t *key) {
  const size_t length = size - TF_FRAME_SIZE(0);
  if (length > TF_FRAME_PAYLOAD - TF_TAIL_BYTES) return 0;
  (void)tf_unstuff(wire + 1, 1 + TF_FRAME_HEADER + length);
  const uint8_t type = wire[3];
  uint32_t sequence = (uint32_t)tf_wire_get(wire + 5, 4);
  const uint64_t tick = tf_wire_get(wire + 9, 8);
  const size_t longer = length + TF_TAIL_BYTES;
  uint8_t *at = tf_frame_header(wire, type, longer, sequence, tick) + length;
  at = tf_wire_put(at, session, TF_SESSION_BYTES);
  const size_t tagged = (size_t)(at - wire) - 2;
  (void)tf_wire_put(at, tf_siphash(key, wire + 2, tagged), TF_TAG_BYTES);
  return tf_frame_seal(wire, type, longer, &sequence, tick);
}

TF_API bool tf_frame_untag(tf_frame_t *frame, const uint8_t *key,
                           uint32_t *session) {
  if (frame->length < TF_TAIL_BYTES || (key != NULL && !tf_has_tag(frame, key)))
    return false;
  frame->length = (uint8_t)(frame->length - TF_TAIL_BYTES);
  *session =
      (uint32_t)tf_wire_get(frame->payload + frame->length, TF_SESSION_BYTES);
  return true;
}
