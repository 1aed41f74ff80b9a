/* What `monitor` counts as missing, of a counter of 32 bits that goes round and
 * a board that is started again: what was lost once is never forgotten. */
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
               {{UINT32_MAX - 3, UINT32_MAX, 4, 16}, {0, 3, 8, 20}},
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
