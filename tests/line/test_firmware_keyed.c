/* The firmware as it is built with KEY: the schema says that commands need a
 * tag, and those without it do nothing. */
#define FRAMES
#define UPLINK
#define RATE 1000
#define SCENE_RATE 1000
#define UPLINK_KEY \
  { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 }
/* The core is compiled here as in a firmware: local to this file. */
#include "../../port/firmware.c" /* NOLINT(bugprone-suspicious-include) */
#include "frame_in.h"
#include "tap.h"

const uint8_t chosen_scene = 0;
uint32_t port_clock_rate(void) { return 1000000; }

/* Sends a command of some number. Returns: the code of its answer. */
static int code_of(uint8_t type, uint32_t number, const uint8_t *key) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)], line[LOOP_RECORD];
  const size_t size =
      tf_command_seal(wire, type, 0, sim.link.session, &number, 0, key);
  for (size_t i = 0; i < size; i++) app_receive(wire[i], 7);
  CHECK(app_latch() == 0);
  const tf_frame_t frame = frame_of(line, app_other(line));
  CHECK(frame.type == TF_DOWN_ANSWER);
  return code_in(&frame);
}

TEST(commands_need_the_key_of_the_build) {
  uint8_t key[TF_KEY_BYTES] = UPLINK_KEY, line[LOOP_RECORD];
  CHECK(app_begin());
  CHECK(code_of(TF_UP_DESCRIBE, 0, NULL) == TF_ANSWER_DONE);
  const tf_frame_t frame = frame_of(line, app_other(line));
  CHECK(frame.type == TF_DOWN_SCHEMA && frame.payload[4] == (2 | 16));
  CHECK(code_of(TF_UP_STOP, 0, NULL) == TF_ANSWER_TAG);
  key[3] ^= 16;
  CHECK(code_of(TF_UP_STOP, 0, key) == TF_ANSWER_TAG);
  CHECK(sim.simulation.running);
  key[3] ^= 16;
  CHECK(code_of(TF_UP_STOP, 0, key) == TF_ANSWER_DONE);
  CHECK(!sim.simulation.running);
}
