// Commands from a line, applied between two steps. Every command is validated
// here, by the functions that validate a command line as well; one that is
// refused changes nothing.
#include "twofold/link.h"

#include "../model/kinematics.h"

TF_API void tf_link_open(tf_link_t *link, const tf_scene_t *scene,
                         const tf_params_t *params) {
  link->scene = scene;
  link->params = *params;
  link->has_saved = false;
  link->describe = true;
  link->waiting = 0;
  link->ignored = 0;
  tf_decoder_init(&link->decoder, link->buffer, sizeof link->buffer);
}

// Acts on arrival and not in its turn, because it may be needed to empty a
// queue that is blocked.
static void clear(tf_link_t *link) {
  link->ignored += link->waiting;
  link->waiting = 0;
}

TF_API void tf_link_receive(tf_link_t *link, uint8_t byte) {
  tf_frame_t frame;
  if (!tf_decoder_push(&link->decoder, byte, &frame)) return;
  if (frame.type == TF_UP_CLEAR && frame.length == 0) clear(link);
  if (link->waiting == TF_LINK_QUEUE) {
    link->ignored++;
    return;
  }
  tf_command_t *command = &link->queue[link->waiting++];
  command->tick = frame.tick;
  command->sequence = frame.sequence;
  command->type = frame.type;
  command->length = frame.length;
  command->done = false;
  // The buffer of the decoder bounds the length.
  for (unsigned i = 0; i < frame.length; i++)
    command->payload[i] = frame.payload[i];
}

static int set_input(tf_session_t *session, const tf_command_t *command) {
  if (command->length == 0) {
    session->input_is_set = false;
    return TF_ANSWER_DONE;
  }
  const size_t real_bytes = TF_REAL_BYTES;
  if (command->length != 5 * real_bytes) return TF_ANSWER_LENGTH;
  const uint8_t *at = command->payload;
  const tf_input_t input = {tf_wire_get_real(at),
                            tf_wire_get_real(at + real_bytes),
                            tf_wire_get_real(at + 2 * real_bytes),
                            tf_wire_get_real(at + 3 * real_bytes),
                            tf_wire_get_real(at + 4 * real_bytes)};
  if (!in_range(&session->state, &input)) return TF_BAD_STATE;
  session->input = input;
  session->input_is_set = true;
  return TF_ANSWER_DONE;
}

// The parameters are changed in place, and changed back if the machine cannot
// be prepared from them: a second copy would not fit a small stack.
static int set_parameter(tf_link_t *link, tf_session_t *session,
                         tf_command_t *command) {
  if (command->length != 1 + TF_REAL_BYTES) return TF_ANSWER_LENGTH;
  const unsigned index = command->payload[0];
  command->index = (uint8_t)index;
  command->value = 0;
  if (index >= TF_PARAMETERS) return TF_BAD_PARAMETER;
  const tf_parameter_range_t *range = &tf_parameter_ranges[index];
  tf_real_t *member =
      (tf_real_t *)(void *)((char *)&link->params + range->offset);
  const tf_real_t value = tf_wire_get_real(command->payload + 1);
  const tf_real_t before = *member;
  command->value = before;
  // tf_prepare ignores a parameter that the law does not use; here its range
  // holds nevertheless.
  if (!(value >= range->low && value <= range->high)) return TF_BAD_PARAMETER;
  *member = value;
  const tf_status_t status = tf_prepare(&session->machine, &link->params, NULL);
  if (status != TF_OK) {
    *member = before;
    return status;
  }
  command->value = value;
  link->describe = true;
  return TF_ANSWER_DONE;
}

static int set_rule(tf_link_t *link, tf_session_t *session,
                    const tf_command_t *command) {
  if (command->length != 5) return TF_ANSWER_LENGTH;
  const tf_rule_t before = link->params.rule;
  link->params.rule = (tf_rule_t)command->payload[0];
  const tf_status_t status = tf_prepare(&session->machine, &link->params, NULL);
  if (status != TF_OK) {
    link->params.rule = before;
    return status;
  }
  session->state.seed = (uint32_t)tf_wire_get(command->payload + 1, 4);
  link->describe = true;
  return TF_ANSWER_DONE;
}

// Without a payload: the snapshot on the board. With one: a state that the host
// has kept, its tick first.
static int restore(const tf_link_t *link, tf_session_t *session,
                   const tf_command_t *command) {
  if (command->length == 0) {
    if (!link->has_saved) return TF_ANSWER_EMPTY;
    session->state = link->saved;
    return TF_ANSWER_DONE;
  }
  if (command->length != 8 + TF_STATE_BYTES) return TF_ANSWER_LENGTH;
  tf_state_t state;
  tf_read_state(command->payload + 8, tf_wire_get(command->payload, 8), &state);
  if (state.mode >= TF_MODES || !in_reach(state.r, state.v, state.w) ||
      !within(state.phi, TF_REAL_MAX))
    return TF_BAD_STATE;
  session->state = state;
  return TF_ANSWER_DONE;
}

// Commands without a payload.
static int perform_plain(tf_link_t *link, tf_session_t *session,
                         const tf_command_t *command) {
  if (command->length != 0) return TF_ANSWER_LENGTH;
  switch (command->type) {
    case TF_UP_START:
      session->running = true;
      break;
    case TF_UP_STOP:
      session->running = false;
      break;
    case TF_UP_RESET:
      return tf_session_start(session, link->scene, session->state.seed);
    case TF_UP_SNAPSHOT:
      link->saved = session->state;
      link->has_saved = true;
      break;
    case TF_UP_DESCRIBE:
      link->describe = true;
      break;
    default: // TF_UP_CLEAR acted on its arrival
      break;
  }
  return TF_ANSWER_DONE;
}

static int perform(tf_link_t *link, tf_session_t *session,
                   tf_command_t *command) {
  switch (command->type) {
    case TF_UP_INPUT:
      return set_input(session, command);
    case TF_UP_PARAMETER:
      return set_parameter(link, session, command);
    case TF_UP_RULE:
      return set_rule(link, session, command);
    case TF_UP_RESTORE:
      return restore(link, session, command);
    case TF_UP_START:
    case TF_UP_STOP:
    case TF_UP_RESET:
    case TF_UP_SNAPSHOT:
    case TF_UP_CLEAR:
    case TF_UP_DESCRIBE:
      return perform_plain(link, session, command);
    default:
      return TF_ANSWER_UNKNOWN;
  }
}

TF_API unsigned tf_link_boundary(tf_link_t *link, tf_session_t *session) {
  unsigned effective = 0;
  for (unsigned i = 0; i < link->waiting; i++) {
    tf_command_t *command = &link->queue[i];
    const uint64_t now = session->state.tick;
    int code = TF_ANSWER_FAR;
    if (command->done) continue;
    if (command->tick <= now)
      code = perform(link, session, command);
    else if (command->tick - now <= TF_LINK_AHEAD)
      continue;
    command->code = (int8_t)code;
    command->done = true;
    command->tick = now;
    effective += code == TF_ANSWER_DONE;
  }
  return effective;
}

TF_API size_t tf_link_answer(tf_link_t *link, uint8_t *wire,
                             uint16_t *sequence) {
  unsigned i = 0;
  while (i < link->waiting && !link->queue[i].done) i++;
  if (i == link->waiting) return 0;
  const tf_command_t *command = &link->queue[i];
  const bool about_parameter =
      command->type == TF_UP_PARAMETER && command->code != TF_ANSWER_LENGTH &&
      command->code != TF_ANSWER_FAR && command->index < TF_PARAMETERS;
  uint8_t *at = wire + TF_FRAME_AT;
  at = tf_wire_put(at, command->sequence, 2);
  *at++ = command->type;
  *at++ = (uint8_t)command->code;
  *at++ = about_parameter ? command->index : 0xff;
  if (about_parameter) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[command->index];
    at = tf_wire_put_real(at, command->value);
    at = tf_wire_put_real(at, range->low);
    at = tf_wire_put_real(at, range->high);
  }
  const size_t length = (size_t)(at - wire) - TF_FRAME_AT;
  const size_t size =
      tf_frame_seal(wire, TF_DOWN_ANSWER, length, sequence, command->tick);
  link->waiting--;
  for (; i < link->waiting; i++) link->queue[i] = link->queue[i + 1];
  return size;
}
