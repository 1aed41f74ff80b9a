/* Who may command a board, and for how long: each command once and of this
 * session, those without the key's tag not at all, and inputs only as long as
 * somebody renews them. Each test is an attack, and the motion is that of a
 * board which nobody attacked. */
#include "link/parts.h"
#include "same_state.h"
#include "tap.h"
#include "twofold.h"
#include "uplink.h"

/* A frame as it went over the line. */
typedef struct {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  size_t size;
} recorded_t;

static recorded_t record(tf_type_t type, uint32_t session, uint32_t number,
                         const uint8_t *key) {
  recorded_t frame;
  frame.size =
      tf_command_seal(frame.wire, (uint8_t)type, 0, session, &number, 0, key);
  return frame;
}

/* What a frame does to a board that stands at a boundary, as its answer. */
static int effect_of(board_t *board, const recorded_t *frame) {
  const acting_t before = acting(board);
  const tf_state_t state = board->simulation.state;
  hear(board, frame->wire, frame->size);
  const unsigned effective = boundary(board);
  const int code = code_of(board);
  CHECK((code == TF_ANSWER_DONE) == (effective == 1));
  if (code != TF_ANSWER_DONE)
    CHECK(acts_alike(board, &before) &&
          same_state(&state, &board->simulation.state));
  return code;
}

/* The session is made of all that was stirred in, and is never 0. */
TEST(session_depends_on_every_reading) {
  board_t board;
  uint32_t seen[33];
  for (unsigned n = 0; n < 33; n++) {
    switch_on(&board, "chaos");
    tf_link_add_entropy(&board.link, n < 32 ? 1u << n : 0);
    tf_link_add_entropy(&board.link, 12345);
    send_plain(&board, TF_UP_DESCRIBE);
    seen[n] = board.link.session;
    CHECK(seen[n] != 0);
    for (unsigned i = 0; i < n; i++) CHECK(seen[i] != seen[n]);
    /* It stays what it is. */
    tf_link_add_entropy(&board.link, n);
    send_plain(&board, TF_UP_DESCRIBE);
    CHECK(board.link.session == seen[n]);
  }
  switch_on(&board, "chaos"); /* a board without a clock */
  send_plain(&board, TF_UP_DESCRIBE);
  CHECK(board.link.session == 1);
}

static int answer_to(board_t *board, tf_type_t type, uint32_t session,
                     uint32_t number, const uint8_t *key) {
  const recorded_t frame = record(type, session, number, key);
  return effect_of(board, &frame);
}

/* Commands in turn, each with all numbers from the first to the last. */
TEST(numbers_act_once_and_end) {
  static const struct {
    tf_type_t type;
    uint32_t first, last;
    int code;
  } cases[] = {
      {TF_UP_STOP, 100, 100, TF_ANSWER_DONE},
      {TF_UP_START, 0, 100, TF_ANSWER_OLD},
      /* A number that was refused for another reason is used up too: nothing
       * was saved, and later something is. */
      {TF_UP_RESTORE, 101, 101, TF_ANSWER_EMPTY},
      {TF_UP_SNAPSHOT, 102, 102, TF_ANSWER_DONE},
      {TF_UP_RESTORE, 101, 101, TF_ANSWER_OLD},
      /* The last one is never taken, so that none comes again: the schema has
       * it as the least one. */
      {TF_UP_STOP, UINT32_MAX - 3, UINT32_MAX - 1, TF_ANSWER_DONE},
      {TF_UP_START, UINT32_MAX - 1, UINT32_MAX, TF_ANSWER_OLD},
      {TF_UP_START, 0, 1, TF_ANSWER_OLD}};
  board_t board;
  power_up(&board, "chaos");
  const uint32_t session = board.link.session;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    for (uint64_t n = cases[i].first; n <= cases[i].last; n++)
      CHECK(answer_to(&board, cases[i].type, session, (uint32_t)n, NULL) ==
            cases[i].code);
  CHECK(board.link.lost == 100 + (UINT32_MAX - 3 - 103));
  CHECK(board.link.next == UINT32_MAX && board.link.session == session);
  CHECK(!board.simulation.running);
}

/* Nor do they use up their number; without a session, too short to say
 * anything. */
TEST(foreign_commands_do_nothing) {
  board_t board;
  power_up(&board, "chaos");
  const uint32_t session = board.link.session;
  for (unsigned bit = 0; bit < 32; bit++)
    CHECK(answer_to(&board, TF_UP_STOP, session ^ 1u << bit, 0, NULL) ==
          TF_ANSWER_FOREIGN);
  CHECK(answer_to(&board, TF_UP_STOP, 0, 0, NULL) == TF_ANSWER_FOREIGN);
  recorded_t frame;
  uint32_t next = 0;
  for (size_t length = 0; length < TF_SESSION_BYTES; length++) {
    frame.size = tf_frame_seal(frame.wire, TF_UP_STOP, length, &next, 0);
    CHECK(effect_of(&board, &frame) == TF_ANSWER_LENGTH);
  }
  CHECK(board.link.next == 0 && board.simulation.running);
}

/* The number of a command that waits, but another type, or one byte more, less
 * or other than it has: no copy of it. */
TEST(another_command_of_a_number_that_waits_is_old) {
  uint8_t data[6] = {TF_RULE_PERSIST, 1, 2, 3, 4, 5};
  board_t board;
  power_up(&board, "chaos");
  send(&board, TF_UP_STOP, 5, NULL, 0);
  send(&board, TF_UP_RULE, 5, data, 5);
  for (size_t length = 0; length <= sizeof data; length++)
    for (int type = TF_UP_RULE - 1; type <= TF_UP_RULE + 1; type++) {
      const bool same = type == TF_UP_RULE && length == 5;
      board.up--;
      send(&board, (tf_type_t)type, 5, data, length);
      CHECK(board.link.waiting == 2);
      boundary(&board);
      CHECK(code_of(&board) == (same ? 999 : TF_ANSWER_OLD));
      CHECK(code_of(&board) == 999);
    }
  for (size_t i = 0; i < 5; i++) {
    data[i] ^= 1;
    board.up--;
    send(&board, TF_UP_RULE, 5, data, 5);
    boundary(&board);
    CHECK(code_of(&board) == TF_ANSWER_OLD);
    data[i] ^= 1;
  }
}

/* A clear that is dated, or carries anything, is refused like any command: what
 * waits goes on waiting. What found no room has no answer. */
TEST(refused_clear_keeps_the_queue) {
  static const uint64_t dates[] = {1, 1000, (uint64_t)1 << 32,
                                   (uint64_t)1 << 63, UINT64_MAX};
  const uint8_t data[TF_COMMAND_DATA] = {0};
  board_t board;
  power_up(&board, "chaos");
  for (int i = 0; i <= TF_LINK_QUEUE; i++)
    send(&board, TF_UP_STOP, 60000, NULL, 0);
  for (unsigned i = 0; i < 5 + TF_COMMAND_DATA; i++) {
    const bool is_dated = i < 5;
    send(&board, TF_UP_CLEAR, is_dated ? dates[i] : 0, data,
         is_dated ? 0 : i - 4);
    CHECK(board.link.waiting == TF_LINK_QUEUE);
    CHECK_TOLD(&board, 0, is_dated ? TF_ANSWER_FAR : TF_ANSWER_LENGTH);
  }
  CHECK(board.link.ignored == 1);
  send_plain(&board, TF_UP_CLEAR);
  CHECK(board.link.waiting == 1 && board.link.ignored == 1 + TF_LINK_QUEUE);
}

/* Numbers that a board counts, or draws, begin sessions that differ as they do,
 * and under another key are others. */
TEST(each_number_begins_a_session_of_its_own) {
  static uint32_t seen[2][2000];
  uint8_t key[TF_KEY_BYTES] = {0};
  board_t board;
  switch_on(&board, "chaos");
  for (unsigned k = 0; k < 2; k++, key[15] ^= 1)
    for (uint32_t n = 0; n < 2000; n++) {
      board.link.describe = false;
      tf_link_begin_session(&board.link, n < 1000 ? n + 1 : 0u - n, key);
      seen[k][n] = board.link.session;
      CHECK(seen[k][n] != 0 && board.link.describe);
      for (uint32_t i = 0; i < n; i++) CHECK(seen[k][i] != seen[k][n]);
      CHECK(k == 0 || seen[0][n] != seen[1][n]);
    }
  /* It is there before anybody asks, and a question does not change it. */
  send_plain(&board, TF_UP_DESCRIBE);
  CHECK(board.link.session == seen[1][1999]);
  /* Of the number that would have session 0 under the key of zeros it is that
   * of no other. */
  memset(key, 0, sizeof key);
  tf_link_begin_session(&board.link, 0, key);
  const uint32_t of_0 = board.link.session;
  tf_link_begin_session(&board.link, 0x67F49640u, key);
  CHECK(board.link.session == of_0 && of_0 != 0);
}

/* Vectors of the paper's appendix and of its reference code. */
TEST(tag_is_siphash_of_the_body) {
  static const struct {
    size_t length;
    uint64_t tag;
  } known[] = {{0, 0x726fdb47dd0e0e31u},  {1, 0x74f839c593dc67fdu},
               {7, 0xab0200f58b01d137u},  {8, 0x93f5f5799a932462u},
               {15, 0xa129ca6149be45e5u}, {63, 0x958a324ceb064572u}};
  uint8_t key[TF_KEY_BYTES], bytes[64];
  for (unsigned i = 0; i < sizeof key; i++) key[i] = (uint8_t)i;
  for (unsigned i = 0; i < sizeof bytes; i++) bytes[i] = (uint8_t)i;
  for (unsigned i = 0; i < sizeof known / sizeof known[0]; i++)
    CHECK(tf_siphash(key, bytes, known[i].length) == known[i].tag);
  /* Of all that the board acts on, and behind it. */
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)] = {0};
  uint32_t number = 5;
  const size_t size =
      tf_command_seal(wire, TF_UP_STOP, 0, 0x11223344u, &number, 77, key);
  static const char body[] =
      "\4\x45\14\5\0\0\0"  /* version, stop, 12 bytes, number 5 */
      "\115\0\0\0\0\0\0\0" /* at tick 77 */
      "\x44\x33\x22\x11";  /* of the session */
  const tf_frame_t got = frame_of(wire, size);
  CHECK(got.length == 12);
  CHECK(tf_wire_get(got.payload + 4, 8) ==
        tf_siphash(key, (const uint8_t *)body, sizeof body - 1));
  /* What a board of the other real type takes is no longer than what fits. */
  for (size_t more = 0; more < 2; more++)
    CHECK(tf_command_seal(wire, TF_UP_INPUT, TF_COMMAND_MOST + more, 1, &number,
                          0, key) == (more ? 0 : sizeof wire));
  CHECK(number == 7);
}

TEST(commands_without_the_tag_do_nothing) {
  uint8_t key[TF_KEY_BYTES], other[TF_KEY_BYTES];
  for (unsigned i = 0; i < sizeof key; i++) key[i] = (uint8_t)tap_bits();
  board_t board;
  switch_on(&board, "chaos");
  board.lock = key;
  send_plain(&board, TF_UP_DESCRIBE); /* anyone may ask */
  boundary(&board);
  CHECK(code_of(&board) == TF_ANSWER_DONE);
  const uint32_t session = board.link.session;
  CHECK(answer_to(&board, TF_UP_STOP, session, 0, NULL) == TF_ANSWER_TAG);
  for (unsigned bit = 0; bit < 128; bit++) {
    memcpy(other, key, sizeof key);
    other[bit / 8] ^= (uint8_t)(1u << bit % 8);
    CHECK(answer_to(&board, TF_UP_STOP, session, 0, other) == TF_ANSWER_TAG);
  }
  /* Another number, by someone who can make a CRC but not a tag. Each bit that
   * a tag is of is in the message of SipHash. */
  const recorded_t frame = record(TF_UP_STOP, session, 0, key);
  const tf_frame_t good = frame_of(frame.wire, frame.size);
  recorded_t forged;
  memcpy(forged.wire + TF_FRAME_AT, good.payload, good.length);
  uint32_t number = 1;
  forged.size = tf_frame_seal(forged.wire, good.type, good.length, &number, 0);
  CHECK(effect_of(&board, &forged) == TF_ANSWER_TAG);
  CHECK(board.link.next == 0 && board.simulation.running);
  CHECK(effect_of(&board, &frame) == TF_ANSWER_DONE);
  CHECK(!board.simulation.running);
  CHECK(effect_of(&board, &frame) == TF_ANSWER_OLD);
  /* Commands with data, as a host with the key sends them. */
  board.key = key;
  board.up = 1;
  send_parameter(&board, 0, index_of("mu"), 2);
  CHECK(boundary(&board) == 1);
  CHECK(answer_of(&board).value == 2);
}

/* Only a controller prolongs its inputs: no other command, no broken or
 * repeated frame, no jump of the tick. */
TEST(only_inputs_feed_the_dead_man) {
  board_t board;
  power_up(&board, "chaos");
  board.simulation.deadman = 50;
  tf_input_t push = tf_input_default(&board.simulation.machine);
  push.force = TF_R(0.25);
  uint8_t back[KEPT_BYTES] = {0};
  send_input(&board, 0, &push);
  tick(&board);
  push.force = (tf_real_t)NAN;
  for (int n = 1; n < 50; n++) {
    drain(&board);
    if (n % 4 == 0) send_plain(&board, TF_UP_SNAPSHOT);
    if (n % 4 == 1) send_input(&board, 0, &push);
    if (n % 4 == 2) send(&board, TF_UP_RESTORE, 0, back, sizeof back);
    if (n % 4 == 3) send_plain(&board, TF_UP_DESCRIBE);
    tick(&board);
    CHECK(board.simulation.stepped == TF_INPUT_SET);
  }
  tick(&board);
  CHECK(board.simulation.stepped == TF_INPUT_SAFE &&
        board.simulation.expired == 1);
  /* A new number holds from now on, for inputs that have not expired. */
  const uint8_t none[4] = {0}, some[4] = {3, 0, 0, 0};
  drain(&board);
  send(&board, TF_UP_DEADMAN, 0, none, 4);
  tick(&board);
  CHECK(board.simulation.stepped == TF_INPUT_SAFE);
  push.force = 1;
  send_input(&board, 0, &push);
  ticks(&board, 500);
  CHECK(board.simulation.stepped == TF_INPUT_SET);
  send(&board, TF_UP_DEADMAN, 0, some, 4);
  ticks(&board, 3);
  CHECK(board.simulation.stepped == TF_INPUT_SET);
  tick(&board);
  CHECK(board.simulation.stepped == TF_INPUT_SAFE &&
        board.simulation.expired == 2);
  drain(&board);
  send(&board, TF_UP_DEADMAN, 0, some, 3);
  tick(&board);
  CHECK(code_of(&board) == TF_ANSWER_LENGTH && board.simulation.deadman == 3);
}
