// Commands from a line, applied between two steps. Every command is validated
// here, by the functions that validate a command line as well; one that is
// refused changes nothing.
#include "twofold/link.h"

#include "../model/mechanics.h"
#include "parts.h"

#define SESSION_ROUNDS 8u
#define REAL_SIZE TF_REAL_BYTES
#define INPUT_SIZE (5 * REAL_SIZE)
#define SET_SIZE (1 + REAL_SIZE)

TF_API void tf_link_open(tf_link_t *link, const tf_scene_t *scene,
                         const tf_params_t *params) {
  *link = (tf_link_t){.scene = scene, .describe = true};
  link->params = *params;
  tf_decoder_init(&link->decoder, link->buffer, sizeof link->buffer);
}

TF_API void tf_link_add_entropy(tf_link_t *link, uint32_t noise) {
  uint8_t bytes[4];
  (void)tf_wire_put(bytes, noise, sizeof bytes);
  link->noise = tf_crc32(link->noise, bytes, sizeof bytes);
}

// Feistel's network, which is a permutation whatever its rounds compute. Tags
// are of longer messages than its rounds.
static uint32_t permuted(uint32_t number, const uint8_t *key) {
  uint32_t left = number >> 16, right = number & 0xffffu;
  for (unsigned round = 0; round < SESSION_ROUNDS; round++) {
    const uint8_t bytes[3] = {(uint8_t)round, (uint8_t)right,
                              (uint8_t)(right >> 8)};
    const uint32_t mixed =
        left ^ ((uint32_t)tf_siphash(key, bytes, sizeof bytes) & 0xffffu);
    left = right;
    right = mixed;
  }
  return left << 16 | right;
}

TF_API void tf_link_begin_session(tf_link_t *link, uint32_t number,
                                  const uint8_t *key) {
  const uint32_t session = permuted(number, key);
  // 0 is no session; what 0 gives is that of no other number.
  link->session = session != 0 ? session : permuted(0, key);
  link->describe = true;
}

// Whether a command names the open session and comes for the first time. The
// last number is never taken, so that numbers never begin again. Returns:
// TF_ANSWER_DONE, or why not.
static int admit(const tf_link_t *link, const tf_frame_t *frame) {
  if (frame->length < TF_SESSION_BYTES) return TF_ANSWER_LENGTH;
  const uint32_t named = (uint32_t)tf_wire_get(frame->payload, 4);
  if (named == 0 || named != link->session) return TF_ANSWER_FOREIGN;
  return frame->sequence < link->next || frame->sequence == UINT32_MAX
             ? TF_ANSWER_OLD
             : TF_ANSWER_DONE;
}

// Takes a command, its data behind the session.
static void keep_command(tf_command_t *command, const tf_frame_t *frame,
                         size_t length) {
  *command = (tf_command_t){.tick = frame->tick,
                            .sequence = frame->sequence,
                            .type = frame->type,
                            .length = (uint8_t)length,
                            .index = 0xff};
  for (size_t i = 0; i < length; i++)
    command->data[i] = frame->payload[TF_SESSION_BYTES + i];
}

// What is done with on arrival waits in a place of its own to be answered.
static void set_aside(tf_link_t *link, const tf_frame_t *frame, int code) {
  if (link->has_aside) {
    link->ignored++;
    return;
  }
  keep_command(&link->aside, frame, 0);
  link->aside.code = (int8_t)code;
  link->has_aside = true;
}

// Anyone may request the session: nothing else changes.
static void describe(tf_link_t *link, const tf_frame_t *frame) {
  const bool has_nonce = frame->length == TF_SESSION_BYTES + TF_NONCE_BYTES;
  const int code =
      frame->length == 0 || has_nonce ? TF_ANSWER_DONE : TF_ANSWER_LENGTH;
  if (has_nonce)
    link->nonce =
        tf_wire_get(frame->payload + TF_SESSION_BYTES, TF_NONCE_BYTES);
  if (code == TF_ANSWER_DONE) {
    if (link->session == 0) link->session = link->noise == 0 ? 1 : link->noise;
    link->describe = true;
  }
  set_aside(link, frame, code);
}

static tf_input_t input_at(const uint8_t *at) {
  return (tf_input_t){tf_wire_get_real(at), tf_wire_get_real(at + REAL_SIZE),
                      tf_wire_get_real(at + 2 * REAL_SIZE),
                      tf_wire_get_real(at + 3 * REAL_SIZE),
                      tf_wire_get_real(at + 4 * REAL_SIZE)};
}

static bool is_far(uint64_t tick, uint64_t now) {
  return tick > now && tick - now > TF_LINK_AHEAD;
}

static int judge_setpoint(const tf_link_t *link, const tf_frame_t *frame,
                          size_t length) {
  if (length != INPUT_SIZE) return TF_ANSWER_LENGTH;
  if (is_far(frame->tick, link->now)) return TF_ANSWER_FAR;
  const tf_input_t input = input_at(frame->payload + TF_SESSION_BYTES);
  return input_in_range(&input) ? TF_ANSWER_DONE : (int)TF_BAD_STATE;
}

// They stay in the order of their ticks, and of their numbers as well.
static void keep_setpoint(tf_link_t *link, const tf_frame_t *frame) {
  while (link->dated > 0 &&
         (link->dated == TF_LINK_SETPOINTS ||
          link->setpoint[link->dated - 1].tick >= frame->tick)) {
    link->dated--;
    link->superseded++;
  }
  link->setpoint[link->dated++] =
      (tf_setpoint_t){frame->tick, frame->sequence,
                      input_at(frame->payload + TF_SESSION_BYTES)};
}

// Whether a new command may wait for its turn. A `clear` acts on arrival,
// because it may be needed to empty a queue that is blocked; so it has no date.
static int judge_arrival(const tf_link_t *link, const tf_frame_t *frame,
                         size_t length) {
  const bool is_clear = frame->type == TF_UP_CLEAR;
  if (frame->type == TF_UP_SETPOINT) return judge_setpoint(link, frame, length);
  if (length > (is_clear ? 0 : TF_COMMAND_DATA)) return TF_ANSWER_LENGTH;
  return is_clear && frame->tick != 0 ? TF_ANSWER_FAR : TF_ANSWER_DONE;
}

// Whether the same command waits for its turn or its answer: then the line has
// doubled a frame. One answer is due, that of the first; `old` before it would
// say that a command which acts was refused.
static bool is_waiting(const tf_link_t *link, const tf_frame_t *frame) {
  const uint8_t *data = frame->payload + TF_SESSION_BYTES;
  const size_t length = frame->length - TF_SESSION_BYTES;
  for (unsigned i = 0; i < link->waiting; i++) {
    const tf_command_t *command = &link->queue[i];
    size_t same = 0;
    if (command->sequence != frame->sequence || command->type != frame->type ||
        command->length != length)
      continue;
    while (same < length && command->data[same] == data[same]) same++;
    if (same == length) return true;
  }
  return false;
}

static void take_frame(tf_link_t *link, const tf_frame_t *frame) {
  if (frame->type == TF_UP_DESCRIBE) {
    describe(link, frame);
    return;
  }
  int code = admit(link, frame);
  if (code == TF_ANSWER_OLD && is_waiting(link, frame)) return;
  const bool is_new = code == TF_ANSWER_DONE;
  const size_t length = is_new ? frame->length - TF_SESSION_BYTES : 0;
  const bool sets = frame->type == TF_UP_SETPOINT;
  // A command that is ignored has come, although its number is not used up.
  if (is_new && frame->sequence >= link->seen) {
    link->lost += frame->sequence - link->seen;
    link->seen = frame->sequence + 1u;
  }
  if (is_new) code = judge_arrival(link, frame, length);
  if (code == TF_ANSWER_DONE && frame->type == TF_UP_CLEAR) {
    link->ignored += (uint32_t)link->waiting + link->dated;
    link->waiting = link->dated = 0;
  }
  if (code == TF_ANSWER_DONE && !sets && link->waiting == TF_LINK_QUEUE) {
    link->ignored++;
    return;
  }
  // The number is used up, whatever becomes of the command: one that is refused
  // today might act tomorrow if it were sent again.
  if (is_new) link->next = frame->sequence + 1u;
  if (code != TF_ANSWER_DONE)
    set_aside(link, frame, code);
  else if (sets)
    keep_setpoint(link, frame);
  else
    keep_command(&link->queue[link->waiting++], frame, length);
}

TF_API void tf_link_receive(tf_link_t *link, uint8_t byte) {
  tf_frame_t frame;
  if (tf_decoder_push(&link->decoder, byte, &frame)) take_frame(link, &frame);
}

TF_API void tf_link_receive_tagged(tf_link_t *link, uint8_t byte,
                                   const uint8_t *key) {
  tf_frame_t frame;
  if (!tf_decoder_push(&link->decoder, byte, &frame)) return;
  if (frame.type != TF_UP_DESCRIBE) {
    if (!tf_has_tag(&frame, key)) {
      set_aside(link, &frame, TF_ANSWER_TAG);
      return;
    }
    frame.length = (uint8_t)(frame.length - TF_TAG_BYTES);
  }
  take_frame(link, &frame);
}

static int set_input(tf_simulation_t *simulation, const tf_command_t *command) {
  if (command->length == 0) {
    simulation->source = TF_INPUT_SCENE;
    return TF_ANSWER_DONE;
  }
  const tf_input_t input = input_at(command->data);
  if (!in_range(&simulation->state, &input)) return TF_BAD_STATE;
  tf_simulation_set_input(simulation, &input);
  return TF_ANSWER_DONE;
}

// Inputs that hold now hold for the new time, from now on; those that have
// expired stay so.
static int set_deadman(tf_link_t *link, tf_simulation_t *simulation,
                       const tf_command_t *command) {
  simulation->deadman = (uint32_t)tf_wire_get(command->data, 4);
  simulation->left = simulation->deadman;
  link->describe = true;
  return TF_ANSWER_DONE;
}

static uint32_t every_of(const tf_command_t *command) {
  return (uint32_t)tf_wire_get(command->data, 4);
}

// What the line does not carry would be dropped, record by record.
static int set_every(tf_link_t *link, const tf_command_t *command) {
  const uint32_t every = every_of(command);
  if (every == 0) return TF_BAD_PARAMETER;
  if (link->line.carries > 0 &&
      tf_line_asks(&link->line, every) > link->line.carries)
    return TF_ANSWER_LINE;
  link->every = every;
  return TF_ANSWER_DONE;
}

// The machine of parameters that were changed in place. The caller changes them
// back if it is refused: a second copy would not fit a small stack.
static int prepare_machine(tf_link_t *link, tf_simulation_t *simulation) {
  const tf_status_t status =
      tf_prepare(&simulation->machine, &link->params, NULL);
  if (status == TF_OK) link->describe = true;
  return status;
}

static int set_parameter(tf_link_t *link, tf_simulation_t *simulation,
                         tf_command_t *command) {
  const unsigned index = command->data[0];
  command->index = (uint8_t)index;
  command->value = 0;
  if (index >= TF_PARAMETERS) return TF_BAD_PARAMETER;
  const tf_parameter_range_t *range = &tf_parameter_ranges[index];
  tf_real_t *member =
      (tf_real_t *)(void *)((char *)&link->params + range->offset);
  const tf_real_t value = tf_wire_get_real(command->data + 1);
  const tf_real_t before = *member;
  command->value = before;
  // tf_prepare ignores a parameter that the law does not use; here its range
  // holds nevertheless.
  if (!(value >= range->low && value <= range->high)) return TF_BAD_PARAMETER;
  *member = value;
  const int code = prepare_machine(link, simulation);
  if (code != TF_OK) *member = before;
  command->value = *member;
  return code;
}

static int set_rule(tf_link_t *link, tf_simulation_t *simulation,
                    const tf_command_t *command) {
  const tf_rule_t before = link->params.rule;
  link->params.rule = (tf_rule_t)command->data[0];
  const int code = prepare_machine(link, simulation);
  if (code == TF_OK)
    simulation->state.seed = (uint32_t)tf_wire_get(command->data + 1, 4);
  else
    link->params.rule = before;
  return code;
}

// Without a payload: the snapshot on the board. With one: a state that the host
// has kept, its tick first.
static int restore(const tf_link_t *link, tf_simulation_t *simulation,
                   const tf_command_t *command) {
  if (command->length == 0) {
    if (!link->has_saved) return TF_ANSWER_EMPTY;
    simulation->state = link->saved;
    return TF_ANSWER_DONE;
  }
  tf_state_t state;
  tf_read_state(command->data + 8, tf_wire_get(command->data, 8), &state);
  if (state.tick >= TF_LINK_TICKS || state.mode >= TF_MODES ||
      !in_reach(state.r, state.v, state.w) || !within(state.phi, TF_REAL_MAX))
    return TF_BAD_STATE;
  simulation->state = state;
  return TF_ANSWER_DONE;
}

// Whether the data of a command are as long as its type wants. Of an input and
// a state to restore they may be missing.
static int judge_length(const tf_link_t *link, const tf_command_t *command) {
  static const uint8_t wanted[] = {INPUT_SIZE, SET_SIZE,        5, 0, 0, 0,
                                   0,          TF_COMMAND_DATA, 0, 0, 4, 4};
  const uint8_t last = link->every > 0 ? TF_UP_EVERY : TF_UP_DEADMAN;
  if (command->type < TF_UP_INPUT || command->type > last)
    return TF_ANSWER_UNKNOWN;
  const bool may_be_missing =
      command->type == TF_UP_INPUT || command->type == TF_UP_RESTORE;
  return command->length == wanted[command->type - TF_UP_INPUT] ||
                 (command->length == 0 && may_be_missing)
             ? TF_ANSWER_DONE
             : TF_ANSWER_LENGTH;
}

static int perform(tf_link_t *link, tf_simulation_t *simulation,
                   tf_command_t *command) {
  const int code = judge_length(link, command);
  if (code != TF_ANSWER_DONE) return code;
  switch (command->type) {
    case TF_UP_INPUT:
      return set_input(simulation, command);
    case TF_UP_PARAMETER:
      return set_parameter(link, simulation, command);
    case TF_UP_RULE:
      return set_rule(link, simulation, command);
    case TF_UP_RESTORE:
      return restore(link, simulation, command);
    case TF_UP_DEADMAN:
      return set_deadman(link, simulation, command);
    case TF_UP_EVERY:
      return set_every(link, command);
    case TF_UP_RESET:
      return tf_simulation_start(simulation, link->scene,
                                 simulation->state.seed);
    case TF_UP_START:
    case TF_UP_STOP:
      simulation->running = command->type == TF_UP_START;
      return TF_ANSWER_DONE;
    case TF_UP_SNAPSHOT:
      link->saved = simulation->state;
      link->has_saved = true;
      return TF_ANSWER_DONE;
    default: // TF_UP_CLEAR acted on its arrival
      return TF_ANSWER_DONE;
  }
}

static void finish(tf_command_t *command, const tf_simulation_t *simulation) {
  command->tick = simulation->state.tick;
  command->done = true;
  command->source = (uint8_t)simulation->source;
}

// Of the setpoints that are due and came before a command, the last takes
// effect. Returns: how many did.
static unsigned apply_setpoint(tf_link_t *link, tf_simulation_t *simulation,
                               uint32_t before) {
  const uint64_t now = simulation->state.tick;
  unsigned due = 0;
  while (due < link->dated && link->setpoint[due].tick <= now &&
         link->setpoint[due].sequence < before)
    due++;
  if (due == 0) return 0;
  const tf_setpoint_t *last = &link->setpoint[due - 1];
  link->superseded += due - 1;
  link->late += last->tick != 0 && last->tick < now;
  tf_simulation_set_input(simulation, &last->input);
  link->dated = (uint8_t)(link->dated - due);
  for (unsigned i = 0; i < link->dated; i++)
    link->setpoint[i] = link->setpoint[i + due];
  return 1;
}

TF_API unsigned tf_link_boundary(tf_link_t *link, tf_simulation_t *simulation) {
  unsigned effective = 0;
  for (unsigned i = 0; i < link->waiting; i++) {
    tf_command_t *command = &link->queue[i];
    const uint64_t now = simulation->state.tick, due = command->tick;
    if (command->done || (due > now && !is_far(due, now))) continue;
    effective += apply_setpoint(link, simulation, command->sequence);
    finish(command, simulation);
    if (due > now)
      command->code = TF_ANSWER_FAR;
    else
      command->code = (int8_t)perform(link, simulation, command);
    effective += command->code == TF_ANSWER_DONE;
  }
  effective += apply_setpoint(link, simulation, UINT32_MAX);
  link->now = simulation->state.tick;
  if (link->has_aside && !link->aside.done) finish(&link->aside, simulation);
  return effective;
}

// The steps in effect; what those of the command need of the line; what it
// carries.
static uint8_t *put_line(uint8_t *at, const tf_link_t *link,
                         const tf_command_t *command) {
  const uint64_t asks = tf_line_asks(&link->line, every_of(command));
  at = tf_wire_put(at, link->every, 4);
  at = tf_wire_put(at, asks < UINT32_MAX ? asks : UINT32_MAX, 4);
  return tf_wire_put(at, link->line.carries, 4);
}

static size_t put_answer(const tf_link_t *link, const tf_command_t *command,
                         uint8_t *wire, uint32_t *sequence) {
  const bool about_parameter = command->index < TF_PARAMETERS;
  uint8_t *at = wire + TF_FRAME_AT;
  at = tf_wire_put(at, command->sequence, 4);
  *at++ = command->type;
  *at++ = (uint8_t)command->code;
  *at++ = command->source;
  *at++ = about_parameter ? command->index : 0xff;
  if (about_parameter) {
    const tf_parameter_range_t *range = &tf_parameter_ranges[command->index];
    at = tf_wire_put_real(at, command->value);
    at = tf_wire_put_real(at, range->low);
    at = tf_wire_put_real(at, range->high);
  }
  if (command->type == TF_UP_EVERY &&
      (command->code == TF_ANSWER_DONE || command->code == TF_ANSWER_LINE))
    at = put_line(at, link, command);
  const size_t length = (size_t)(at - wire) - TF_FRAME_AT;
  return tf_frame_seal(wire, TF_DOWN_ANSWER, length, sequence, command->tick);
}

TF_API size_t tf_link_answer(tf_link_t *link, uint8_t *wire,
                             uint32_t *sequence) {
  if (link->has_aside && link->aside.done) {
    link->has_aside = false;
    return put_answer(link, &link->aside, wire, sequence);
  }
  unsigned i = 0;
  while (i < link->waiting && !link->queue[i].done) i++;
  if (i == link->waiting) return 0;
  const size_t size = put_answer(link, &link->queue[i], wire, sequence);
  link->waiting--;
  for (; i < link->waiting; i++) link->queue[i] = link->queue[i + 1];
  return size;
}
