/* The application of the firmware (port/firmware.c) with an uplink, tick by
 * tick, on a board made of numbers: its counters at the ends of their ranges,
 * and its session. */
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
uint32_t port_unread(void) { return 0; }
uint32_t port_clock_rate(void) { return clock_rate; }
static uint32_t ticks_now;
uint32_t port_ticks(void) { return ticks_now; }

static void switch_on(void) {
  memset(&sim, 0, sizeof sim);
  clock_rate = 1000000000u;
  CHECK(app_begin());
}

static uint8_t line[LOOP_RECORD];

static void ask(void) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  uint32_t number = sim.link.next;
  const size_t size = tf_command_seal(wire, TF_UP_DESCRIBE, 0, sim.link.session,
                                      &number, 0, NULL);
  for (size_t i = 0; i < size; i++) {
    clock_now += 86806;
    app_receive(wire[i], clock_now);
  }
}

/* A tick of the board's clock, by which so many have passed. */
static void tick_after(uint32_t ticks) {
  uint32_t until = EVERY;
  ticks_now += ticks;
  CHECK(app_latch() == 0);
  (void)app_step(&until);
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
  sim.simulation.report.set = (1u << TF_MODES) - 1;
}

/* Ticks as the loop gives them. Returns: how many records were at a tick that
 * is not a multiple of `every`, or were missing. */
static unsigned wrong_records(uint64_t from, unsigned ticks) {
  const uint32_t every = sim.link.every;
  uint32_t until = EVERY;
  unsigned wrong = 0;
  sim.simulation.state.tick = from;
  sim.simulation.running = true;
  for (unsigned n = 0; n < ticks; n++) {
    CHECK(app_latch() == 0);
    CHECK(app_step(&until) == LOOP_STEPPED);
    const bool due = --until == 0;
    if (due) until = EVERY;
    wrong += due != (sim.simulation.state.tick % every == 0);
  }
  return wrong;
}

/* However many steps a command puts between, and wherever the tick is put, by a
 * restore or by time: at the end of 32 bits, of what may be restored, and just
 * below 2^64. */
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
    CHECK(sim.link.every == EVERY && sim.link.line.rate == RATE);
    sim.link.every = (uint32_t)k % 7 + 1; /* as by a command */
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
      const loop_counts_t counts = {.steps = steps,
                                    .shortest = 200,
                                    .longest = 900,
                                    .sum = steps * 300,
                                    .skipped = 93};
      switch_on();
      const tf_heartbeat_t beat = heartbeat_of(&counts);
      CHECK(beat.steps == (uint32_t)steps && beat.exec_mean == 300);
      CHECK(beat.exec_min == 200 && beat.exec_max == 900);
      CHECK(beat.skipped == 93);
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
  sim.simulation.tally = (tf_tally_t){UINT64_MAX, UINT64_MAX, UINT64_MAX,
                                      UINT64_MAX, UINT64_MAX, 1};
  sim.simulation.state.tick = UINT64_MAX;
  const tf_heartbeat_t beat = heartbeat_of(&counts);
  CHECK(beat.exec_max == UINT32_MAX && beat.exec_min == UINT32_MAX);
  CHECK(beat.degraded == UINT32_MAX && beat.refused == UINT32_MAX);
  CHECK(beat.coarse == UINT32_MAX && beat.stalled == UINT32_MAX);
  uint8_t text[2 * LOOP_RECORD];
  /* At most what `make firmware` reckons with, and LOOP_RECORD of text. */
  CHECK(text_heartbeat(&counts, text) <= 157);
  fill_with_extremes();
  CHECK(text_record(text) <= 114);
  CHECK(app_record(line) <= LOOP_RECORD);
}

/* Behind a heartbeat the parts of a description come one after the other, and
 * after `describe` at once. */
TEST(descriptions_delay_no_records) {
  const loop_counts_t counts = {.steps = 1};
  switch_on();
  while (app_other(line) > 0) continue;
  ticks_now += RATE;
  heartbeat_of(&counts);
  for (unsigned part = 0, tick = 0; tick < 20; tick++, ticks_now++) {
    const unsigned length = app_other(line);
    CHECK((length > 0) == (tick % (RATE / 250) == 0 && part < 4));
    part += length > 0;
    CHECK(app_other(line) == 0);
  }
  heartbeat_of(&counts);
  ask();
  CHECK(app_latch() == 0);
  for (unsigned frames = 0; frames < 5; frames++) CHECK(app_other(line) > 0);
  CHECK(app_other(line) == 0);
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
      CHECK(length == 38 && !memcmp(text, "t,r,v,omega,h,g,F,M,mode,", 25));
    CHECK(csv_other(text) == 0);
  }
  sim.simulation.state.tick = (uint64_t)4294967295 * RATE + 7;
  fill_with_extremes();
  const unsigned length = csv_record(text);
  CHECK(length <= 121); /* LOOP_RECORD of text */
  text[length] = 0;
  CHECK(!memcmp(text, "4294967295.007000,-", 19));
  unsigned commas = 0;
  for (unsigned i = 0; i < length; i++) commas += text[i] == ',';
  CHECK(commas == 10 && !memcmp(text + length - 2, "\r\n", 2));
}

/* Half a second of the board's clock is that, however many of its ticks get a
 * step, and where the clock goes round; a board that stands loses none. When
 * inputs expire is told behind the answers of before. */
TEST(dead_man_is_of_the_clock) {
  for (uint32_t gap = 1; gap < 600; gap += 7) {
    ticks_now = 0u - 3 * gap;
    switch_on();
    while (app_other(line) > 0) continue;
    tick_after(1);
    const tf_input_t push = tf_input_default(&sim.simulation.machine);
    tf_simulation_set_input(&sim.simulation, &push);
    sim.simulation.running = false;
    tick_after(1000);
    sim.simulation.running = true;
    tick_after(1);
    for (uint32_t since = gap; since < RATE / 2; since += gap) {
      tick_after(gap);
      CHECK(sim.simulation.stepped == TF_INPUT_SET && app_other(line) == 0);
    }
    tick_after(gap);
    const uint64_t steps = sim.simulation.state.tick;
    CHECK(sim.simulation.stepped == TF_INPUT_SAFE);
    const tf_frame_t told = frame_in(line, app_other(line), TF_DOWN_EXPIRED);
    CHECK(tf_wire_get(told.payload, TF_EXPIRED_BYTES) == 1);
    CHECK(told.tick == steps - 1 && app_other(line) == 0);
    /* An answer that waits goes before it. */
    ask();
    tf_simulation_set_input(&sim.simulation, &push);
    sim.simulation.left = 0;
    tick_after(1);
    CHECK(frame_in(line, app_other(line), TF_DOWN_ANSWER).type != 0);
    CHECK(frame_in(line, app_other(line), TF_DOWN_EXPIRED).type != 0);
  }
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
    ask();
    CHECK(app_latch() == 0);
    CHECK(frame_in(line, app_other(line), TF_DOWN_ANSWER).type != 0);
    const tf_frame_t after = frame_in(line, app_other(line), TF_DOWN_SCHEMA);
    seen[n] = (uint32_t)tf_wire_get(after.payload + 13, 4);
    CHECK(seen[n] != 0 && seen[n] == sim.link.session);
    CHECK(tf_wire_get(after.payload + 21, 4) == RATE / 2);
    for (unsigned i = 0; i < n; i++) CHECK(seen[i] != seen[n]);
  }
}
