/* uplink.h - a board and the host at its line: what a firmware keeps, commands
 * that are sent to it, answers that are read. */
#ifndef TESTS_SUPPORT_UPLINK_H
#define TESTS_SUPPORT_UPLINK_H

#include "common.h"
#include "frame_in.h"

#define R TF_REAL_BYTES

/* A board: what a firmware keeps, and its two lines. */
typedef struct {
  const tf_scene_t *scene;
  tf_simulation_t simulation;
  tf_link_t link;
  uint32_t up, down;   /* sequence numbers */
  const uint8_t *lock; /* key of the board, or NULL */
} board_t;

static inline void switch_on(board_t *board, const char *scene) {
  memset(board, 0, sizeof *board);
  board->scene = scene_named(scene);
  CHECK(tf_simulation_open(&board->simulation, board->scene,
                           &board->scene->params, 5) == TF_OK);
  tf_link_open(&board->link, board->scene, &board->scene->params);
}

static inline void hear(board_t *board, const uint8_t *wire, size_t size) {
  for (size_t i = 0; i < size; i++)
    if (board->lock != NULL)
      tf_link_receive_tagged(&board->link, wire[i], board->lock);
    else
      tf_link_receive(&board->link, wire[i]);
}

typedef struct {
  uint32_t sequence;
  uint8_t type, index, source, length;
  int code;
  uint64_t tick;
  tf_real_t value, low, high;
} answer_t;

/* The next answer; length 0 where there is none. */
static inline answer_t answer_of(board_t *board) {
  uint8_t wire[TF_FRAME_SIZE(TF_ANSWER_BYTES)];
  const size_t size = tf_link_answer(&board->link, wire, &board->down);
  if (size == 0) return (answer_t){.length = 0};
  const tf_frame_t frame = frame_of(wire, size);
  CHECK(frame.type == TF_DOWN_ANSWER && frame.length >= 8);
  const uint8_t *at = frame.payload;
  answer_t answer = {.length = frame.length,
                     .tick = frame.tick,
                     .sequence = (uint32_t)tf_wire_get(at, 4),
                     .type = at[4],
                     .code = code_in(&frame),
                     .source = at[6],
                     .index = at[7]};
  if (frame.length == 8) return answer;
  CHECK(frame.length == 8 + 3 * R);
  answer.value = tf_wire_get_real(at + 8);
  answer.low = tf_wire_get_real(at + 8 + R);
  answer.high = tf_wire_get_real(at + 8 + 2 * R);
  return answer;
}
static inline void send(board_t *board, tf_type_t type, uint64_t at,
                        const uint8_t *data, size_t length) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  for (size_t i = 0; i < length; i++) wire[TF_COMMAND_AT + i] = data[i];
  uint32_t next = board->up;
  const size_t size = tf_command_seal(wire, (uint8_t)type, length,
                                      board->link.session, &next, at, NULL);
  if (type != TF_UP_DESCRIBE) board->up = next;
  hear(board, wire, size);
}

/* A board whose host has asked who it is. */
static inline void power_up(board_t *board, const char *scene) {
  switch_on(board, scene);
  tf_link_add_entropy(&board->link, (uint32_t)tap_bits() | 1u);
  send(board, TF_UP_DESCRIBE, 0, NULL, 0);
  CHECK(tf_link_boundary(&board->link, &board->simulation) == 0);
  CHECK(answer_of(board).code == TF_ANSWER_DONE);
  CHECK(board->link.session != 0);
}

static inline void tick(board_t *board) {
  tf_link_boundary(&board->link, &board->simulation);
  tf_simulation_t *simulation = &board->simulation;
  const tf_input_t input = tf_simulation_input(simulation, board->scene);
  if (simulation->running)
    CHECK(tf_step(&simulation->machine, &simulation->state, &input,
                  &simulation->report) >= 0);
}

static inline void send_plain(board_t *board, tf_type_t type) {
  send(board, type, 0, NULL, 0);
}
static inline void send_parameter(board_t *board, uint64_t at, unsigned index,
                                  tf_real_t value) {
  uint8_t payload[1 + sizeof(tf_real_t)];
  payload[0] = (uint8_t)index;
  tf_wire_put_real(payload + 1, value);
  send(board, TF_UP_PARAMETER, at, payload, sizeof payload);
}
static inline void send_inputs(board_t *board, tf_type_t type, uint64_t at,
                               const tf_input_t *input) {
  uint8_t payload[5 * sizeof(tf_real_t)];
  const tf_real_t values[5] = {input->omega0, input->r0, input->force,
                               input->torque, input->alpha};
  for (size_t i = 0; i < 5; i++) tf_wire_put_real(payload + i * R, values[i]);
  send(board, type, at, payload, sizeof payload);
}
static inline void send_input(board_t *board, uint64_t at,
                              const tf_input_t *input) {
  send_inputs(board, TF_UP_INPUT, at, input);
}

/* The boundary between two steps: how many commands take effect there. */
static inline unsigned boundary(board_t *board) {
  return tf_link_boundary(&board->link, &board->simulation);
}

/* Reads all answers that wait. Returns: how many they were. */
static inline uint32_t drain(board_t *board) {
  uint32_t count = 0;
  while (answer_of(board).length) count++;
  return count;
}

static inline void ticks(board_t *board, int count) {
  for (int n = 0; n < count; n++) tick(board);
}

/* Keeps the state as a host does, from its frame: the data of a restore. */
#define KEPT_BYTES (8 + TF_STATE_BYTES)
static inline void keep(board_t *board, uint8_t kept[KEPT_BYTES]) {
  uint8_t wire[TF_FRAME_SIZE(TF_STATE_BYTES)];
  const tf_frame_t frame = frame_of(
      wire, tf_send_state(wire, &board->down, &board->simulation.state));
  tf_wire_put(kept, frame.tick, 8);
  memcpy(kept + 8, frame.payload, TF_STATE_BYTES);
}

static inline int code_of(board_t *board) {
  const answer_t answer = answer_of(board);
  return answer.length ? answer.code : 999;
}

/* The boundary at which so many of the commands that were sent take effect, and
 * the answers to them. */
#define CHECK_TOLD(board, effective, ...)                      \
  do {                                                         \
    const int want[] = {__VA_ARGS__};                          \
    CHECK(boundary(board) == (effective));                     \
    for (size_t i_ = 0; i_ < sizeof want / sizeof *want; i_++) \
      CHECK(code_of(board) == want[i_]);                       \
  } while (0)

static inline unsigned index_of(const char *name) {
  unsigned i = 0;
  while (i < TF_PARAMETERS && strcmp(tf_parameter_ranges[i].name, name)) i++;
  CHECK(i < TF_PARAMETERS);
  return i;
}

/* What must not change unless a valid command came: all that acts. */
typedef struct {
  tf_machine_t machine;
  tf_params_t params;
  tf_input_source_t source;
  uint32_t deadman;
  bool running;
} acting_t;
static inline acting_t acting(const board_t *board) {
  acting_t now;
  memset(&now, 0, sizeof now);
  memcpy(&now.machine, &board->simulation.machine, sizeof now.machine);
  memcpy(&now.params, &board->link.params, sizeof now.params);
  now.source = board->simulation.source;
  now.deadman = board->simulation.deadman;
  now.running = board->simulation.running;
  return now;
}
static inline int acts_alike(const board_t *board, const acting_t *before) {
  const acting_t now = acting(board);
  return memcmp(&now, before, sizeof now) == 0;
}

#endif
