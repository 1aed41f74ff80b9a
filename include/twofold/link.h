/// @file
/// Commands: the frames that go up, from a host to a board, and what a board
/// does with them. docs/PROTOCOL.md describes their bytes and the codes of
/// their answers. A command acts once, and in one start of the board only: it
/// names the session that the schema states, and its number is larger than
/// those of all commands before it. On a line that others reach it ends with a
/// tag, made with the board's key:
///   session (4) | data | tag (8), if the board wants one
///
/// A board applies commands at the boundary between two steps. A command of the
/// open session with a new number waits in a queue until tf_link_boundary is
/// called at its tick or later, and its answer in the same place until
/// tf_link_answer is called: memory is bounded and no answer is lost. A command
/// that finds the queue full is counted, gets no answer, and may be sent again.
/// What is refused on arrival never fills the queue.
///
/// TF_UP_SETPOINT sets the inputs without an answer, for a controller that
/// sends them at every tick. The newest wins: it replaces all that are dated at
/// its tick or later, and of those that are due together the last takes effect.
/// Only one that is refused is answered.
///   when the program starts:          tf_link_open(&link, scene, &params);
///   with a number of this start:      tf_link_begin_session(&link, n, key);
///   else, with each byte until it has a session:
///                                     tf_link_add_entropy(&link, clock);
///   for each byte received:           tf_link_receive(&link, byte);
///   at a tick, before the step:       tf_link_boundary(&link, &simulation);
///   while the line has room:          n = tf_link_answer(&link, wire, &seq);
#ifndef TWOFOLD_LINK_H
#define TWOFOLD_LINK_H

#include "twofold/telemetry.h"

TF_BEGIN_C

/// Bytes of a command's session, of its tag, and of the key.
#define TF_SESSION_BYTES 4u
#define TF_TAG_BYTES 8u
#define TF_KEY_BYTES 16u
/// Bytes of a number that a host draws and has never drawn before.
#define TF_NONCE_BYTES 8u
/// Where the data of a command have to be for tf_command_seal.
#define TF_COMMAND_AT (TF_FRAME_AT + TF_SESSION_BYTES)
/// Longest data that a board of this real type takes, and longest payload.
#define TF_COMMAND_DATA (8 + TF_STATE_BYTES)
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
  TF_ANSWER_OLD = -20,     ///< its number, or every number, is used up
  TF_ANSWER_FOREIGN = -21, ///< it names another session
  TF_ANSWER_TAG = -22,     ///< its tag is not that of the board's key
  TF_ANSWER_LINE = -23     ///< the line does not carry so many records
} tf_answer_code_t;

/// Completes a command around its data: a frame with session, data and tag.
/// TF_UP_DESCRIBE has session 0 and no tag: by it a host learns the session.
/// Its data may be a nonce of TF_NONCE_BYTES.
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

/// Whether a board with a key tags frames of a type: schemas, heartbeats,
/// answers, TF_DOWN_EXPIRED.
static inline bool tf_is_vouched_for(uint8_t type) {
  return type == TF_DOWN_SCHEMA || type == TF_DOWN_HEARTBEAT ||
         type == TF_DOWN_ANSWER || type == TF_DOWN_EXPIRED;
}

/// Appends the tag to a frame of the board: the SipHash-2-4 of its body and of
/// the nonce of the host, 0 before the first. It shows that the frame is for
/// this host and no recording.
/// wire: in/out, the frame, with room for TF_TAG_BYTES more. size: in, its
/// bytes.
/// key: in, TF_KEY_BYTES.
/// Returns: bytes of the frame.
#define tf_frame_vouch TF_LINK(tf_frame_vouch)
TF_API size_t tf_frame_vouch(uint8_t *wire, size_t size, const uint8_t *key,
                             uint64_t nonce);

/// Whether a frame, in its decoder's buffer, ends with that tag.
#define tf_frame_is_vouched TF_LINK(tf_frame_is_vouched)
TF_API bool tf_frame_is_vouched(const tf_frame_t *frame, const uint8_t *key,
                                uint64_t nonce);

/// Commands or answers that can wait.
#define TF_LINK_QUEUE 4
/// Setpoints that can wait for their ticks. A further one replaces the last.
#define TF_LINK_SETPOINTS 8
/// How far ahead a command may be dated [steps].
#define TF_LINK_AHEAD 65536
/// A command may restore only ticks below this.
#define TF_LINK_TICKS ((uint64_t)1 << 63)
/// Longest payload of an answer.
#define TF_ANSWER_BYTES (8 + 3 * TF_REAL_BYTES)

/// A command and its result.
typedef struct {
  uint64_t tick; ///< when it is to take effect; once done, when it did
  uint32_t sequence;
  uint8_t type, length;
  int8_t code; ///< tf_answer_code_t or tf_status_t
  bool done;
  uint8_t source;  ///< tf_input_source_t of the simulation before it
  uint8_t index;   ///< of a parameter
  tf_real_t value; ///< of a parameter, as it is in effect
  uint8_t data[TF_COMMAND_DATA];
} tf_command_t;

/// Inputs that wait for their tick; 0: for the next step.
typedef struct {
  uint64_t tick;
  uint32_t sequence;
  tf_input_t input;
} tf_setpoint_t;

typedef struct {
  const tf_scene_t *scene;
  tf_params_t params; ///< in effect
  tf_state_t saved;
  bool has_saved;
  bool describe;    ///< schema and layouts are due; their sender clears it
  bool has_aside;   ///< `aside` is in use
  uint8_t waiting;  ///< entries of the queue in use, in order of arrival
  uint8_t dated;    ///< setpoints in use, in order of their ticks
  uint32_t session; ///< that commands have to name; 0: none yet
  uint32_t noise;   ///< makes the session
  uint64_t nonce;   ///< of the host that last had one, for tf_frame_vouch
  uint32_t next;    ///< least number of a command that is still taken
  uint32_t seen;    ///< the smallest number not received yet
  uint32_t lost;    ///< numbers that were passed over, modulo 2^32
  uint32_t ignored; ///< commands without an answer: no room, or cleared
  uint32_t superseded, late; ///< as in a heartbeat
  uint64_t now;              ///< tick of the last boundary
  uint32_t every;            ///< steps a record; 0: no command may set it
  tf_line_t line;            ///< what they may need; the program sets both
  tf_decoder_t decoder;
  tf_command_t queue[TF_LINK_QUEUE];
  tf_command_t aside; ///< done with on arrival; its answer is still to be sent
  tf_setpoint_t setpoint[TF_LINK_SETPOINTS];
  uint8_t buffer[TF_DECODER_SIZE(TF_COMMAND_BYTES)];
} tf_link_t;

/// Prepares a link, which takes TF_UP_DESCRIBE alone until it has a session.
/// link: out; it keeps a pointer into itself, so it must not move.
/// scene: kept, for TF_UP_RESET. params: in, those of the simulation's machine.
#define tf_link_open TF_LINK(tf_link_open)
TF_API void tf_link_open(tf_link_t *link, const tf_scene_t *scene,
                         const tf_params_t *params);

/// Adds a fast-clock reading when a byte came in, or a random number, to the
/// CRC-32 that becomes the session at the first TF_UP_DESCRIBE.
/// link: in/out. noise: in.
#define tf_link_add_entropy TF_LINK(tf_link_add_entropy)
TF_API void tf_link_add_entropy(tf_link_t *link, uint32_t noise);

/// Begins a session that no other number gives: the key chooses a permutation
/// of 32 bits, so that the session is unpredictable without it.
/// link: in/out. number: in, > 0, never given in an earlier start of the
///   program. key: in, TF_KEY_BYTES.
#define tf_link_begin_session TF_LINK(tf_link_begin_session)
TF_API void tf_link_begin_session(tf_link_t *link, uint32_t number,
                                  const uint8_t *key);

/// Takes one byte from the line, any byte at any time. Not reentrant for the
/// same link: an interrupt handler puts bytes into a queue of its own.
/// link: in/out. byte: in.
#define tf_link_receive TF_LINK(tf_link_receive)
TF_API void tf_link_receive(tf_link_t *link, uint8_t byte);

/// The same, but takes only commands with the tag of a key, the SipHash-2-4 of
/// the frame's body; the comparison looks at every bit. A program calls this
/// one or the other; without a call, none of it is linked.
/// link: in/out. byte: in. key: in, TF_KEY_BYTES.
#define tf_link_receive_tagged TF_LINK(tf_link_receive_tagged)
TF_API void tf_link_receive_tagged(tf_link_t *link, uint8_t byte,
                                   const uint8_t *key);

/// Applies the commands that are due, in order of arrival.
/// link, simulation: in/out. A command that is refused changes neither.
/// Returns: how many took effect.
#define tf_link_boundary TF_LINK(tf_link_boundary)
TF_API unsigned tf_link_boundary(tf_link_t *link, tf_simulation_t *simulation);

/// Makes the frame of the next answer and removes the command.
/// link: in/out. wire: out, TF_FRAME_SIZE(TF_ANSWER_BYTES).
/// sequence: in/out, of the frames that go down.
/// Returns: bytes of the frame; 0 if no answer is waiting (wire untouched).
#define tf_link_answer TF_LINK(tf_link_answer)
TF_API size_t tf_link_answer(tf_link_t *link, uint8_t *wire,
                             uint32_t *sequence);

TF_END_C

#endif
