/* Who may command a board, and for how long: each command once and of this
 * session, those without the key's tag not at all, and inputs only as long as
 * somebody renews them. Each test is an attack, and the motion is that of a
 * board which nobody attacked. */
#include "link/parts.h"
#include "same_state.h"
#include "uplink.h"

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
  switch_on(&board, "chaos");     /* a board without a clock */
  send_plain(&board, TF_UP_STOP); /* before it has a session */
  CHECK_TOLD(&board, 0, TF_ANSWER_FOREIGN);
  send_plain(&board, TF_UP_DESCRIBE);
  CHECK(board.link.session == 1);
}

/* A command as it is sent: so many bytes of `fill`. */
typedef struct {
  uint32_t number;
  uint8_t type, length, fill;
} sent_t;

/* What docs/PROTOCOL.md makes of commands, beside their data: which numbers are
 * used up, which have come, what waits, what had no room. */
typedef struct {
  uint32_t next, seen, lost, ignored;
  unsigned waiting;
  sent_t waits[TF_LINK_QUEUE];
} model_t;

#define NOTHING 999  /* no answer */
#define OUTCOME 1000 /* what its data make of it */

static bool waits_already(const model_t *model, const sent_t *sent) {
  for (unsigned i = 0; i < model->waiting; i++) {
    const sent_t *one = &model->waits[i];
    if (one->number == sent->number && one->type == sent->type &&
        one->length == sent->length &&
        (one->fill == sent->fill || one->length == 0))
      return true;
  }
  return false;
}

/* Of a command for the step `ahead` of the present one. */
static int expected(model_t *model, const sent_t *sent, uint64_t ahead) {
  static const uint8_t lengths[] = {5 * R, 1 + R, 5, 0, 0, 0, 0, 0, 0, 0, 4};
  const bool is_clear = sent->type == TF_UP_CLEAR;
  if (sent->number < model->next || sent->number == UINT32_MAX)
    return waits_already(model, sent) ? NOTHING : TF_ANSWER_OLD;
  const bool sets = sent->type == TF_UP_SETPOINT; /* of a wrong length */
  const int arrival = sets || sent->length > (is_clear ? 0 : TF_COMMAND_DATA)
                          ? TF_ANSWER_LENGTH
                      : is_clear && ahead > 0 ? TF_ANSWER_FAR
                                              : TF_ANSWER_DONE;
  if (sent->number >= model->seen) {
    model->lost += sent->number - model->seen;
    model->seen = sent->number + 1;
  }
  if (arrival == TF_ANSWER_DONE && is_clear) {
    model->ignored += model->waiting;
    model->waiting = 0;
  }
  if (arrival == TF_ANSWER_DONE && model->waiting == TF_LINK_QUEUE) {
    model->ignored++;
    return NOTHING;
  }
  model->next = sent->number + 1;
  if (arrival != TF_ANSWER_DONE) return arrival;
  if (ahead > TF_LINK_AHEAD) return TF_ANSWER_FAR;
  if (ahead > 0) {
    model->waits[model->waiting++] = *sent;
    return NOTHING;
  }
  if (sent->type < TF_UP_INPUT || sent->type > TF_UP_DEADMAN)
    return TF_ANSWER_UNKNOWN;
  return sent->length == lengths[sent->type - TF_UP_INPUT] ||
                 (sent->type == TF_UP_INPUT && sent->length == 0)
             ? OUTCOME
             : TF_ANSWER_LENGTH;
}

static unsigned one_of(unsigned count) {
  return (unsigned)(tap_bits() % count);
}

/* Mostly a command that may act. */
static sent_t draw(const model_t *model, bool locked) {
  static const uint8_t lengths[] = {0, 0, 0, 4, 5, 1 + R, 5 * R};
  const unsigned most = TF_COMMAND_DATA + (locked ? 0 : TF_TAG_BYTES);
  sent_t sent = {.number = model->next,
                 .type = (uint8_t)(TF_UP_INPUT + one_of(11)),
                 .length = lengths[one_of(7)],
                 .fill = (uint8_t)one_of(2)};
  const unsigned fault = one_of(16);
  if (fault == 0 && model->waiting > 0) {
    sent = model->waits[one_of(model->waiting)];
    sent.fill = (uint8_t)(sent.fill ^ one_of(2));
  }
  if (fault == 1) sent.number = (uint32_t)(tap_bits() % (model->next + 1ull));
  if (fault == 2) sent.number = UINT32_MAX;
  if (fault == 3) sent.number += one_of(4);
  if (one_of(4) == 0) sent.type = (uint8_t)tap_bits();
  if (one_of(4) == 0) sent.length = (uint8_t)one_of(most + 1);
  /* A question has no number, a setpoint no answer, and these move the step,
   * which the model does not. */
  if (sent.type == TF_UP_DESCRIBE || sent.type == TF_UP_RESET ||
      (sent.type == TF_UP_RESTORE && sent.length == TF_COMMAND_DATA) ||
      (sent.type == TF_UP_SETPOINT && sent.length == 5 * R))
    sent.type = TF_UP_STOP;
  return sent;
}

/* Random commands, some of them of another session, under another key or under
 * none. Those act that the model lets act, each is answered as it says, and
 * what is refused changes nothing. */
static void walk(const uint8_t *lock) {
  static const uint64_t dates[] = {
      0, 0, 0, 0, 0, 1, TF_LINK_AHEAD, TF_LINK_AHEAD + 1, (uint64_t)1 << 62};
  const int count = samples(80000);
  board_t board;
  model_t model = {0};
  power_up(&board, "chaos");
  board.lock = lock;
  board.simulation.state.tick = lock != NULL ? ((uint64_t)1 << 40) + 5 : 0;
  for (int n = 0; n < count; n++) {
    uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)], key[TF_KEY_BYTES] = {0};
    sent_t sent = draw(&model, lock != NULL);
    const uint64_t ahead = dates[one_of(9)];
    const unsigned fault = one_of(16), bit = one_of(128);
    if (n > count / 2 && model.next < UINT32_MAX / 2)
      sent.number = UINT32_MAX - 1000;
    if (lock != NULL) memcpy(key, lock, sizeof key);
    if (fault == 0) key[bit / 8] ^= (uint8_t)(1u << bit % 8);
    const int want = lock != NULL && fault < 2 ? TF_ANSWER_TAG
                     : fault == 2              ? TF_ANSWER_FOREIGN
                                               : expected(&model, &sent, ahead);
    uint32_t number = sent.number;
    memset(wire + TF_COMMAND_AT, sent.fill, sent.length);
    const size_t size = tf_command_seal(
        wire, sent.type, sent.length,
        board.link.session ^ (fault == 2 ? 1u << bit % 32 : 0), &number,
        ahead > 0 ? board.simulation.state.tick + ahead : 0,
        lock != NULL && fault != 1 ? key : NULL);
    const acting_t before = acting(&board);
    const tf_state_t state = board.simulation.state;
    hear(&board, wire, size);
    const unsigned effective = boundary(&board);
    const int code = code_of(&board);
    const bool good =
        want != OUTCOME ? code == want
                        : code == TF_ANSWER_DONE || code == TF_BAD_PARAMETER ||
                              code == TF_BAD_STATE || code == TF_ANSWER_EMPTY;
    if (!CHECK(good))
      printf("# %d: %d, not %d: type %02X, number %u of %u, length %u\n", n,
             code, want, sent.type, sent.number, model.next, sent.length);
    CHECK(effective == (code == TF_ANSWER_DONE) && code_of(&board) == NOTHING);
    CHECK(code == TF_ANSWER_DONE ||
          (acts_alike(&board, &before) &&
           same_state(&state, &board.simulation.state)));
    CHECK(board.link.next == model.next && board.link.lost == model.lost &&
          board.link.ignored == model.ignored &&
          board.link.waiting == model.waiting);
  }
  CHECK(model.next == UINT32_MAX && model.ignored > 100);
}

TEST(only_admitted_commands_act) { walk(NULL); }

TEST(only_commands_with_the_tag_act) {
  uint8_t key[TF_KEY_BYTES];
  for (unsigned i = 0; i < sizeof key; i++) key[i] = (uint8_t)tap_bits();
  walk(key);
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
  /* It is there before anybody asks, and a question, which has no tag, does not
   * change it. */
  board.lock = key;
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
      "\5\x45\14\5\0\0\0"  /* version, stop, 12 bytes, number 5 */
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

/* The tag of a frame from the board covers its body and the nonce of the host.
 * It fails if one bit of these or of the key differs. */
TEST(answers_are_made_for_this_host) {
  board_t board;
  uint8_t key[TF_KEY_BYTES], nonce[TF_NONCE_BYTES];
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)], body[TF_FRAME_PAYLOAD];
  for (unsigned i = 0; i < sizeof key; i++) key[i] = (uint8_t)tap_bits();
  for (unsigned i = 0; i < sizeof nonce; i++) nonce[i] = (uint8_t)tap_bits();
  power_up(&board, "chaos");
  send(&board, TF_UP_DESCRIBE, 0, nonce, sizeof nonce);
  const uint64_t drawn = tf_wire_get(nonce, sizeof nonce);
  CHECK(board.link.nonce == drawn);
  send_plain(&board, TF_UP_DESCRIBE); /* another host, without one */
  CHECK(board.link.nonce == drawn);
  send(&board, TF_UP_DESCRIBE, 0, nonce, 7);
  CHECK(board.link.nonce == drawn);
  boundary(&board);
  size_t size = tf_link_answer(&board.link, wire, &board.down);
  const tf_frame_t plain = frame_of(wire, size);
  const uint32_t number = plain.sequence;
  memcpy(body, plain.payload, plain.length);
  memcpy(wire + TF_FRAME_AT, body, plain.length);
  uint32_t next = number;
  size = tf_frame_seal(wire, TF_DOWN_ANSWER, plain.length, &next, 12345);
  size = tf_frame_vouch(wire, size, key, drawn);
  CHECK(size == TF_FRAME_SIZE(plain.length + TF_TAG_BYTES));
  tf_frame_t frame = frame_of(wire, size);
  CHECK(frame.sequence == number && frame.tick == 12345);
  CHECK(frame.length == plain.length + TF_TAG_BYTES);
  CHECK(!memcmp(frame.payload, body, plain.length));
  CHECK(tf_frame_is_vouched(&frame, key, drawn));
  CHECK(!tf_has_tag(&frame, key)); /* it is no command */
  CHECK(tf_is_vouched_for(frame.type) && !tf_is_vouched_for(TF_DOWN_STATE));
  for (unsigned bit = 0; bit < 64; bit++)
    CHECK(!tf_frame_is_vouched(&frame, key, drawn ^ (uint64_t)1 << bit));
  uint8_t at[TF_FRAME_HEADER + TF_FRAME_PAYLOAD];
  memcpy(at, frame.payload - TF_FRAME_HEADER, TF_FRAME_HEADER + frame.length);
  frame.payload = at + TF_FRAME_HEADER;
  for (unsigned bit = 0; bit < 8u * (TF_FRAME_HEADER + frame.length); bit++) {
    at[bit / 8] ^= (uint8_t)(1u << bit % 8);
    CHECK(!tf_frame_is_vouched(&frame, key, drawn));
    at[bit / 8] ^= (uint8_t)(1u << bit % 8);
  }
  key[0] ^= 1;
  CHECK(!tf_frame_is_vouched(&frame, key, drawn));
  frame.length = 7;
  CHECK(!tf_frame_is_vouched(&frame, key, drawn));
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
