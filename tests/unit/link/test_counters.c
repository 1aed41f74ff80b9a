/* Every counter of 32 bits in what a board keeps starts at 2^32 - k: it goes on
 * at 0, counts the same, and nothing else changes by it. */
#include "same_state.h"
#include "tap.h"
#include "twofold.h"
#include "uplink.h"

#define MOST 12

/* The same events to two decoders, of which one has counted a lot. */
TEST(decoder_counts_go_round) {
  for (uint32_t k = 1; k <= MOST; k++) {
    uint8_t wire[TF_FRAME_SIZE(64)], room[2][TF_DECODER_SIZE(32)];
    tf_decoder_t one[2];
    uint32_t sequence = 0;
    for (int i = 0; i < 2; i++) tf_decoder_init(&one[i], room[i], sizeof *room);
    one[1].frames = one[1].bad = one[1].too_long = one[1].bad_version =
        one[1].lost = one[1].restarts = 0u - k;
    for (int n = 0; n < 200; n++) {
      const uint64_t kind = tap_bits() % 6;
      memset(wire, 3, sizeof wire);
      if (kind == 1) sequence += 1 + (uint32_t)(tap_bits() % 3);
      if (kind == 2) sequence = 0;
      const size_t size =
          tf_frame_seal(wire, 1, kind == 3 ? 64 : 8, &sequence, 5);
      if (kind == 4) wire[9] ^= 1;
      if (kind == 5) { /* another version */
        wire[2] = 7;
        reseal(wire, size);
      }
      for (size_t i = 0; i < size; i++) {
        tf_frame_t frame[2];
        CHECK(tf_decoder_push(&one[0], wire[i], &frame[0]) ==
              tf_decoder_push(&one[1], wire[i], &frame[1]));
      }
    }
    CHECK(one[0].frames > MOST && one[0].bad > MOST && one[0].too_long > MOST);
    CHECK(one[0].lost > MOST && one[0].restarts > MOST);
    CHECK(one[0].bad_version > MOST);
    CHECK(one[1].frames == one[0].frames - k && one[1].bad == one[0].bad - k);
    CHECK(one[1].lost == one[0].lost - k);
    CHECK(one[1].restarts == one[0].restarts - k);
    CHECK(one[1].too_long == one[0].too_long - k);
    CHECK(one[1].bad_version == one[0].bad_version - k);
  }
}

/* A line on which everything is lost or comes twice, to two boards of which one
 * has counted a lot already, and whose inputs expire. */
static void attack(board_t *board, int n) {
  const tf_input_t push = {TF_R(-1.0), TF_R(0.1), TF_R(0.1), 0, 0};
  if (n % 10 == 0) send_input(board, 0, &push);
  for (int i = 0; i < 7; i++) send_plain(board, TF_UP_SNAPSHOT);
  board->up += 3;
  tick(board);
  drain(board);
}

TEST(board_counts_go_round) {
  for (uint32_t k = 1; k <= MOST; k++) {
    board_t one, much;
    power_up(&one, "chaos");
    one.simulation.deadman = 2;
    much = one;
    much.link.decoder.buffer = much.link.buffer;
    much.link.lost = much.link.ignored = much.simulation.expired = 0u - k;
    for (int n = 0; n < 200; n++) {
      attack(&one, n);
      attack(&much, n);
      CHECK(same_state(&one.simulation.state, &much.simulation.state));
      CHECK(one.simulation.stepped == much.simulation.stepped);
    }
    CHECK(one.link.lost > MOST && one.link.ignored > MOST);
    CHECK(one.simulation.expired > MOST);
    CHECK(much.link.lost == one.link.lost - k);
    CHECK(much.link.ignored == one.link.ignored - k);
    CHECK(much.simulation.expired == one.simulation.expired - k);
  }
}
