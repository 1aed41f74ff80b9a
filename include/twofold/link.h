/// @file
/// The uplink: commands that come over a line, applied at the boundary between
/// two steps. A program that never calls these functions does not contain them,
/// and its parameters cannot be changed from outside.
///
/// Bytes are handed to tf_link_receive as they arrive. A complete command waits
/// in a queue until tf_link_boundary is called at its tick or later. Its answer
/// waits in the same place until tf_link_answer is called, so memory is bounded
/// and no answer is lost. A command that finds the queue full is counted and
/// gets no answer.
///
///   for each byte received:           tf_link_receive(&link, byte);
///   at a tick, before the step:       tf_link_boundary(&link, &session);
///   while the line has room:          n = tf_link_answer(&link, wire, &seq);
#ifndef TWOFOLD_LINK_H
#define TWOFOLD_LINK_H

#include "twofold/frame.h"
#include "twofold/session.h"
#include "twofold/telemetry.h"

/// Commands that can wait, or whose answers can.
#define TF_LINK_QUEUE 4
/// How far ahead a command may be dated [steps].
#define TF_LINK_AHEAD 65536
/// Longest payload of a command: TF_UP_RESTORE.
#define TF_UP_PAYLOAD (8 + TF_STATE_BYTES)
/// Longest payload of an answer.
#define TF_ANSWER_BYTES (5 + 3 * TF_REAL_BYTES)

/// Codes of an answer, beside tf_status_t.
typedef enum {
  TF_ANSWER_DONE = 0,      ///< it took effect
  TF_ANSWER_UNKNOWN = -16, ///< no such type of command
  TF_ANSWER_LENGTH = -17,  ///< its payload is too long or too short
  TF_ANSWER_EMPTY = -18,   ///< there is no snapshot to restore
  TF_ANSWER_FAR = -19      ///< dated too far ahead
} tf_answer_code_t;

/// A command and its result.
typedef struct {
  uint64_t tick; ///< when it is to take effect; once done, when it did
  uint16_t sequence;
  uint8_t type, length;
  int8_t code; ///< tf_answer_code_t or tf_status_t
  bool done;
  uint8_t index;   ///< of a parameter
  tf_real_t value; ///< of a parameter, as it is in effect
  uint8_t payload[TF_UP_PAYLOAD];
} tf_command_t;

typedef struct {
  const tf_scene_t *scene;
  tf_params_t params; ///< in effect
  tf_state_t saved;
  bool has_saved;
  bool describe;    ///< schema and layouts have to be sent; the program that
                    ///< sends them clears it
  uint8_t waiting;  ///< entries of the queue in use, in order of arrival
  uint32_t ignored; ///< commands without an answer: queue full, or cleared
  tf_decoder_t decoder;
  tf_command_t queue[TF_LINK_QUEUE];
  uint8_t buffer[TF_DECODER_SIZE(TF_UP_PAYLOAD)];
} tf_link_t;

/// Prepares a link.
/// Scheme: none.
/// link: out; it keeps a pointer into itself, so it must not move.
/// scene: kept, for TF_UP_RESET. params: in, those of the session's machine.
/// Returns: nothing.
/// Cost: at most 40 instructions. Stack: 32 B.
/// Memory: caller's, reentrant.
/// Claims: set_parameter_is_validated_and_answered
#define tf_link_open TF_LINK(tf_link_open)
TF_API void tf_link_open(tf_link_t *link, const tf_scene_t *scene,
                         const tf_params_t *params);

/// Takes one byte from the line; it may be any byte at any time.
/// Scheme: none.
/// link: in/out. byte: in.
/// Returns: nothing.
/// Cost: at most 1800 instructions for the last byte of a command, else 20.
///   Stack: 112 B.
/// Memory: caller's; not reentrant for the same link: an interrupt handler
///   should put the byte into a queue of its own.
/// Claims: uplink_flood_changes_nothing, no_byte_changes_a_parameter_by_itself
#define tf_link_receive TF_LINK(tf_link_receive)
TF_API void tf_link_receive(tf_link_t *link, uint8_t byte);

/// Applies the commands that are due, in order of arrival.
/// Scheme: none.
/// link, session: in/out. A command that is refused changes neither.
/// Returns: how many took effect.
/// Cost: at most 5000 instructions, for TF_LINK_QUEUE commands, the longest
///   tf_prepare or tf_session_start; none: 10. Stack: 1264 B.
/// Memory: caller's, no overlap.
/// Claims: set_parameter_takes_effect_only_at_the_boundary,
///   set_parameter_is_validated_and_answered, inputs_act_at_their_tick,
///   snapshot_and_restore_continue_bit_for_bit, start_stop_reset_and_rule
#define tf_link_boundary TF_LINK(tf_link_boundary)
TF_API unsigned tf_link_boundary(tf_link_t *link, tf_session_t *session);

/// Makes the frame of the next answer and removes the command from the queue.
/// Scheme: none.
/// link: in/out.
/// wire: out, TF_FRAME_SIZE(TF_ANSWER_BYTES).
/// sequence: in/out, of the frames that go down.
/// Returns: bytes of the frame; 0 if no answer is waiting (wire untouched).
/// Cost: at most 1300 instructions. Stack: 96 B.
/// Memory: caller's, no overlap.
/// Claims: set_parameter_is_validated_and_answered,
///   uplink_flood_changes_nothing, documented_frames_decode
#define tf_link_answer TF_LINK(tf_link_answer)
TF_API size_t tf_link_answer(tf_link_t *link, uint8_t *wire,
                             uint16_t *sequence);

#endif
