// A command as a frame. The tag is that of the body before COBS, header
// included: all that the board acts on.
#include "twofold/command.h"

#include "header.h"
#include "siphash.h"
#include "twofold/wire.h"

TF_API size_t tf_command_seal(uint8_t *wire, uint8_t type, size_t length,
                              uint32_t session, uint32_t *sequence,
                              uint64_t tick, const uint8_t *key) {
  if (length > TF_COMMAND_MOST) return 0;
  if (type == TF_UP_DESCRIBE)
    return tf_frame_seal(wire, type, 0, sequence, tick);
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
