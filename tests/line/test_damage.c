/* What `monitor` counts as missing, over counters of 32 bits that go round, a
 * board that is started again, and a decoder that has lost more than 2^32
 * frames: what was lost once is never forgotten. */
#include "tap.h"
/* Of the command line, which tests are not linked with. */
#include "../../tools/cli/monitor/damage.c" /* NOLINT */

static cli_damage_t damage;
static cli_receiver_t receiver;
static tf_decoder_t decoder;

/* A stream of a file that has begun. */
static void begin(void) {
  memset(&damage, 0, sizeof damage);
  memset(&receiver, 0, sizeof receiver);
  memset(&decoder, 0, sizeof decoder);
  receiver.has_schema = true;
}

static void hear(void) {
  cli_damage_frame(&damage, false, TF_DOWN_STATE, &receiver, &decoder);
}

static void count(uint32_t *counter, uint32_t value) {
  *counter = value;
  hear();
}

static void beat(uint32_t dropped) {
  receiver.has_heartbeat = true;
  receiver.heartbeat.dropped = dropped;
  hear();
}

static uint64_t missing(void) {
  return cli_damage_missing(&damage, &receiver, &decoder);
}

/* What heartbeats tell in turn, and what is missing after each of them. */
TEST(drops_are_those_since_the_first_heartbeat) {
  static const struct {
    uint32_t dropped[4], missing[4];
  } cases[] = {{{3, 3, 3, 10}, {0, 0, 0, 7}},
               /* A board that was started again: it has dropped two since. */
               {{100, 0, 5, 2}, {0, 0, 5, 7}}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    begin();
    for (int n = 0; n < 4; n++) {
      beat(cases[i].dropped[n]);
      hear();
      CHECK(missing() == cases[i].missing[n]);
    }
  }
}

TEST(drops_go_round) {
  for (uint32_t k = 0; k < 20; k++) {
    begin();
    beat(UINT32_MAX - k);
    beat(UINT32_MAX - k + 8);
    CHECK(missing() == 8);
    beat(UINT32_MAX - k + 20);
    CHECK(missing() == 20);
  }
}

TEST(lost_frames_go_round) {
  uint32_t *const counters[] = {&decoder.lost, &decoder.bad, &decoder.too_long,
                                &decoder.bad_version};
  for (unsigned i = 0; i < 4; i++)
    for (uint32_t k = 0; k < 20; k++) {
      begin();
      hear();
      count(counters[i], 0x7fffffffu);
      count(counters[i], UINT32_MAX - k);
      CHECK(missing() == UINT32_MAX - k);
      *counters[i] += 12; /* by no frame that was accepted */
      CHECK(missing() == (uint64_t)UINT32_MAX - k + 12);
      hear();
      count(counters[i], 0); /* 2^32 of them, or twice that */
      CHECK(missing() >= (uint64_t)1 << 32);
    }
}

TEST(what_came_before_a_device_was_heard_is_no_loss) {
  begin();
  receiver.has_schema = false;
  decoder.bad = 7;
  receiver.incomplete = 2;
  cli_damage_frame(&damage, true, TF_DOWN_STATE, &receiver, &decoder);
  receiver.has_schema = true;
  cli_damage_frame(&damage, true, TF_DOWN_STATE, &receiver, &decoder);
  CHECK(missing() == 0);
  decoder.lost = 3;
  receiver.incomplete = 4;
  cli_damage_frame(&damage, true, TF_DOWN_STATE, &receiver, &decoder);
  CHECK(missing() == 5);
  receiver.has_state = true; /* whose report has not come */
  CHECK(missing() == 6);
}

/* A run's stream has an end, a board's has none. */
TEST(a_stream_is_open_until_its_heartbeat) {
  static const uint8_t types[] = {TF_DOWN_SCHEMA, TF_DOWN_LAYOUT, TF_DOWN_STATE,
                                  TF_DOWN_REPORT, TF_DOWN_COMPACT};
  for (unsigned ends = 0; ends < 2; ends++) {
    begin();
    receiver.ends = ends;
    CHECK(!damage.is_open);
    for (unsigned i = 0; i < sizeof types; i++) {
      cli_damage_frame(&damage, false, types[i], &receiver, &decoder);
      CHECK(damage.is_open == (ends == 1));
      cli_damage_frame(&damage, false, TF_DOWN_HEARTBEAT, &receiver, &decoder);
      CHECK(!damage.is_open);
    }
  }
}
