/* The application of the firmware (port/firmware.c) with an uplink, tick by
 * tick, on a board made of numbers: its counters at the ends of their ranges,
 * its session, and inputs that nobody renews. */
#define FRAMES
#define UPLINK
#define RATE 1000
#define SCENE_RATE 1000
#define EVERY 10
/* The core is compiled here as in a firmware: local to this file. */
#include "../../port/firmware.c" /* NOLINT(bugprone-suspicious-include) */
/* And the text and the CSV that a firmware without frames sends. */
#define telemetry_record text_record
#define telemetry_heartbeat text_heartbeat
#define telemetry_other text_other
#include "../../port/telemetry_plotter.h"
#undef telemetry_record
#undef telemetry_heartbeat
#undef telemetry_other
#define telemetry_record csv_record
#define telemetry_heartbeat csv_heartbeat
#define telemetry_other csv_other
#include "../../port/telemetry_csv.h"
#include "frame_in.h"
#include "tap.h"

const uint8_t chosen_scene = 0;
static uint32_t clock_now, clock_rate;
uint32_t port_clock_rate(void) { return clock_rate; }

static void switch_on(void) {
  memset(&sim, 0, sizeof sim);
  clock_rate = 1000000000u;
  CHECK(app_begin());
}

static uint8_t line[LOOP_RECORD];

static void send(uint8_t type, size_t length) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  const tf_input_t push = {-1, 0, 0, TF_R(0.5), 0};
  const tf_real_t values[5] = {push.omega0, push.r0, push.force, push.torque,
                               push.alpha};
  uint32_t number = sim.link.next;
  for (size_t i = 0; i < 5; i++)
    tf_wire_put_real(wire + TF_COMMAND_AT + i * TF_REAL_BYTES, values[i]);
  const size_t size =
      tf_command_seal(wire, type, length, sim.link.session, &number, 0, NULL);
  for (size_t i = 0; i < size; i++) {
    clock_now += 86806;
    app_receive(wire[i], clock_now);
  }
}

static tf_heartbeat_t heartbeat_of(const loop_counts_t *counts) {
  tf_heartbeat_t beat;
  tf_read_heartbeat(
      frame_in(line, app_heartbeat(counts, line), TF_DOWN_HEARTBEAT).payload,
      &beat);
  return beat;
}

/* The values that take the most room in a text. */
static void fill_with_extremes(void) {
  sim.simulation.state.r = sim.simulation.state.v = sim.simulation.state.w =
      -TF_REAL_MAX;
  sim.simulation.report.slip.h = sim.simulation.report.slip.g = -TF_REAL_MIN;
  sim.simulation.report.force = (tf_force_t){-TF_REAL_MAX, -TF_REAL_MIN};
}

/* Ticks as the loop gives them. Returns: how many records were at a tick that
 * is not a multiple of EVERY, or were missing. */
static unsigned wrong_records(uint64_t from, unsigned ticks) {
  uint32_t until = EVERY;
  unsigned wrong = 0;
  sim.simulation.state.tick = from;
  sim.simulation.running = true;
  for (unsigned n = 0; n < ticks; n++) {
    CHECK(app_latch() == 0);
    CHECK(app_step(&until) == LOOP_STEPPED);
    const bool due = --until == 0;
    if (due) until = EVERY;
    wrong += due != (sim.simulation.state.tick % EVERY == 0);
  }
  return wrong;
}

/* Wherever the tick is put, by a restore or by time: at the end of 32 bits, of
 * what may be restored, and just below 2^64. */
TEST(records_are_at_multiples_of_every) {
  static const uint64_t ends[] = {0, (uint64_t)1 << 32, (uint64_t)1 << 33,
                                  (uint64_t)1 << 63};
  for (unsigned i = 0; i < 4; i++)
    for (uint64_t k = 0; k < 25; k++) {
      switch_on();
      CHECK(wrong_records(ends[i] + 40 - k, 100) == 0);
      if (ends[i] > 0) CHECK(wrong_records(ends[i] - k, 100) == 0);
    }
  for (uint64_t k = 31; k < 60; k++) {
    switch_on();
    CHECK(wrong_records(UINT64_MAX - k, 30) == 0);
  }
}

/* The mean is that of all steps, after any number of them. */
TEST(mean_survives_the_counters) {
  static const uint64_t ends[] = {(uint64_t)1 << 32, (uint64_t)5 << 32,
                                  (uint64_t)1 << 48};
  for (unsigned i = 0; i < 3; i++)
    for (uint64_t k = 0; k < 6; k++) {
      const uint64_t steps = ends[i] - 3 + k;
      const loop_counts_t counts = {
          .steps = steps, .shortest = 200, .longest = 900, .sum = steps * 300};
      switch_on();
      const tf_heartbeat_t beat = heartbeat_of(&counts);
      CHECK(beat.steps == (uint32_t)steps && beat.exec_mean == 300);
      CHECK(beat.exec_min == 200 && beat.exec_max == 900);
      char text[LOOP_RECORD + 1] = {0};
      text_heartbeat(&counts, (uint8_t *)text);
      CHECK(strstr(text, " min:200 mean:300 max:900") != NULL);
    }
}

/* What a frame has no room for stays at its largest number, and the longest
 * text fits its record. */
TEST(counters_end_at_their_largest) {
  const loop_counts_t counts = {UINT64_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX,
                                UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT64_MAX};
  switch_on();
  clock_rate = 1000000; /* 4295 s are more nanoseconds than 32 bits hold */
  sim.simulation.tally =
      (tf_tally_t){UINT64_MAX, UINT64_MAX, UINT64_MAX, UINT64_MAX, 1};
  sim.simulation.state.tick = UINT64_MAX;
  const tf_heartbeat_t beat = heartbeat_of(&counts);
  CHECK(beat.exec_max == UINT32_MAX && beat.exec_min == UINT32_MAX);
  CHECK(beat.degraded == UINT32_MAX && beat.refused == UINT32_MAX);
  uint8_t text[2 * LOOP_RECORD];
  CHECK(text_heartbeat(&counts, text) <= 200); /* LOOP_RECORD of text */
  fill_with_extremes();
  CHECK(text_record(text) <= 200);
  CHECK(app_record(line) <= LOOP_RECORD);
}

/* CSV: the header first and every ten heartbeats, and nothing else beside the
 * rows. Time is exact after any number of ticks, and the longest row fits its
 * record. */
TEST(csv_has_its_header_again) {
  const loop_counts_t counts = {.steps = 1};
  uint8_t text[2 * LOOP_RECORD];
  switch_on();
  for (unsigned beat = 0; beat < 31; beat++) {
    CHECK(csv_heartbeat(&counts, text) == 0);
    const unsigned length = csv_other(text);
    CHECK((length > 0) == (beat % 10 == 0));
    if (length > 0)
      CHECK(length == 34 && !memcmp(text, "t,r,v,omega,h,g,F,M,mode,", 25));
    CHECK(csv_other(text) == 0);
  }
  sim.simulation.state.tick = (uint64_t)4294967295 * RATE + 7;
  fill_with_extremes();
  const unsigned length = csv_record(text);
  CHECK(length <= 160); /* LOOP_RECORD of text */
  text[length] = 0;
  CHECK(!memcmp(text, "4294967295.007000,-", 19));
  unsigned commas = 0;
  for (unsigned i = 0; i < length; i++) commas += text[i] == ',';
  CHECK(commas == 9 && !memcmp(text + length - 2, "\r\n", 2));
}

/* Sequence numbers of what goes down, through the end of 32 bits. */
TEST(frames_are_numbered_through_the_end) {
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
  tf_decoder_t decoder;
  switch_on();
  tf_decoder_init(&decoder, buffer, sizeof buffer);
  telemetry_sequence = UINT32_MAX - 20;
  for (int n = 0; n < 40; n++) {
    size_t length = app_record(line), taken = 0;
    tf_frame_t frame;
    for (const uint8_t *at = line;
         tf_decoder_block(&decoder, at, length, &taken, &frame); at += taken)
      length -= taken;
  }
  CHECK(decoder.frames == 80 && decoder.lost + decoder.restarts == 0);
}

/* Two boards that are asked at different times have different sessions, and
 * until it is asked a board has none. */
TEST(session_is_of_the_moment) {
  uint32_t seen[20];
  for (unsigned n = 0; n < 20; n++) {
    switch_on();
    clock_now = n;
    const tf_frame_t before = frame_in(line, app_other(line), TF_DOWN_SCHEMA);
    CHECK(tf_wire_get(before.payload + 13, 4) == 0);
    send(TF_UP_DESCRIBE, 0);
    CHECK(app_latch() == 0);
    CHECK(frame_in(line, app_other(line), TF_DOWN_ANSWER).type != 0);
    const tf_frame_t after = frame_in(line, app_other(line), TF_DOWN_SCHEMA);
    seen[n] = (uint32_t)tf_wire_get(after.payload + 13, 4);
    CHECK(seen[n] != 0 && seen[n] == sim.link.session);
    CHECK(tf_wire_get(after.payload + 21, 4) == RATE / 2);
    for (unsigned i = 0; i < n; i++) CHECK(seen[i] != seen[n]);
  }
}

/* With what a build does by default: half a second after the last input the
 * machine coasts, and reports and heartbeats say so. */
TEST(inputs_expire_by_default) {
  const loop_counts_t counts = {0};
  uint32_t until = EVERY;
  switch_on();
  send(TF_UP_DESCRIBE, 0);
  send(TF_UP_INPUT, 5 * TF_REAL_BYTES);
  for (unsigned n = 1; n <= RATE; n++) {
    CHECK(app_latch() == 0 && app_step(&until) == LOOP_STEPPED);
    const tf_frame_t frame = frame_in(line, app_record(line), TF_DOWN_REPORT);
    CHECK(frame.length == TF_REPORT_BYTES);
    CHECK(frame.payload[TF_REPORT_BYTES - 1] ==
          (n <= RATE / 2 ? TF_INPUT_SET : TF_INPUT_SAFE));
  }
  const tf_frame_t frame =
      frame_in(line, app_heartbeat(&counts, line), TF_DOWN_HEARTBEAT);
  CHECK(tf_wire_get(frame.payload + 52, 4) == 1);
}
