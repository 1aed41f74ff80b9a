/// @file
/// Commands: the frames that go up, from a host to a board, and the codes of
/// their answers, docs/PROTOCOL.md. A command acts once and on one board start
/// only: it names the board's session, which the schema states, and has a
/// number larger than those of all commands before it; on a line that others
/// reach it ends with a tag, which only who has the board's key can make:
///   session (4) | data | tag (8), if the board wants one
#ifndef TWOFOLD_COMMAND_H
#define TWOFOLD_COMMAND_H

#include "twofold/telemetry.h"

TF_BEGIN_C

/// Bytes of the session before the data of a command, and of the tag behind.
#define TF_SESSION_BYTES 4u
#define TF_TAG_BYTES 8u
/// Bytes of a key.
#define TF_KEY_BYTES 16u
/// Where the data of a command have to be for tf_command_seal.
#define TF_COMMAND_AT (TF_FRAME_AT + TF_SESSION_BYTES)
/// Longest data that a board of this real type takes: those of TF_UP_RESTORE.
#define TF_COMMAND_DATA (8 + TF_STATE_BYTES)
/// Longest payload that it takes.
#define TF_COMMAND_BYTES (TF_SESSION_BYTES + TF_COMMAND_DATA + TF_TAG_BYTES)
/// Longest data that a frame has room for.
#define TF_COMMAND_MOST (TF_FRAME_PAYLOAD - TF_SESSION_BYTES - TF_TAG_BYTES)

/// Codes of an answer, beside tf_status_t.
typedef enum {
  TF_ANSWER_DONE = 0,      ///< it took effect
  TF_ANSWER_UNKNOWN = -16, ///< no such type of command
  TF_ANSWER_LENGTH = -17,  ///< its payload is too long or too short
  TF_ANSWER_EMPTY = -18,   ///< there is no snapshot to restore
  TF_ANSWER_FAR = -19,     ///< dated too far ahead
  TF_ANSWER_OLD = -20,     ///< its number is not larger than those before
  TF_ANSWER_FOREIGN = -21, ///< it names another session
  TF_ANSWER_TAG = -22,     ///< its tag is not that of the board's key
  TF_ANSWER_LINE = -23     ///< the line does not carry so many records
} tf_answer_code_t;

/// Bytes that tf_frame_tag adds to a payload: session, and tag behind it.
#define TF_TAIL_BYTES (TF_SESSION_BYTES + TF_TAG_BYTES)

/// Completes a command around its data: a frame with session, data and tag.
/// TF_UP_DESCRIBE has neither session nor tag: by it a host learns the session.
/// wire: in/out, TF_FRAME_SIZE(TF_SESSION_BYTES + length + TF_TAG_BYTES) bytes;
///   in, the data at wire + TF_COMMAND_AT; out, the bytes for the line.
/// type: in. length: in, of the data, 0 to TF_COMMAND_MOST: a host may command
///   boards of the other real type. session: in, as the schema states it.
/// sequence: in/out, number of this command; then that of the next.
/// tick: in, when it is to take effect; 0: at once.
/// key: in, TF_KEY_BYTES, or NULL for a board that wants no tag.
/// Returns: bytes of the frame; 0 where length is too large (wire and sequence
///   untouched).
#define tf_command_seal TF_LINK(tf_command_seal)
TF_API size_t tf_command_seal(uint8_t *wire, uint8_t type, size_t length,
                              uint32_t session, uint32_t *sequence,
                              uint64_t tick, const uint8_t *key);

/// Adds session and tag to a frame that goes down, so that a host with the key
/// knows whose it is, and of which start. A schema says whether frames have it.
/// wire: in/out, a frame as tf_send made it, with room for TF_TAIL_BYTES more.
/// size: in, its bytes. session: in, that of the last schema before it.
/// key: in, TF_KEY_BYTES.
/// Returns: bytes of the frame; 0 where they are too many (wire untouched).
#define tf_frame_tag TF_LINK(tf_frame_tag)
TF_API size_t tf_frame_tag(uint8_t *wire, size_t size, uint32_t session,
                           const uint8_t *key);

/// Takes session and tag off again.
/// frame: in/out, in its decoder's buffer; the payload becomes shorter.
/// key: in, TF_KEY_BYTES; or NULL: the tag is not looked at.
/// session: out, that it names.
/// Returns: whether it had them; else nothing is changed.
#define tf_frame_untag TF_LINK(tf_frame_untag)
TF_API bool tf_frame_untag(tf_frame_t *frame, const uint8_t *key,
                           uint32_t *session);

TF_END_C

#endif
