/* A line that doubles frames: a command acts once and has one answer, that of
 * the first frame, unless the copy comes after it was answered. */
#include "same_state.h"
#include "tap.h"
#include "twofold.h"
#include "uplink.h"

/* The command once more, as the line repeats it. */
static void send_again(board_t *board, tf_type_t type, uint64_t at,
                       const uint8_t *data, size_t length) {
  board->up--;
  send(board, type, at, data, length);
}

/* A copy comes at once, while the command waits for its date, and while its
 * answer waits to be sent: a host reads that it took effect, and nothing else,
 * and the motion is that of a line without copies. */
TEST(doubled_frames_are_answered_once) {
  static const tf_type_t types[] = {TF_UP_START,    TF_UP_STOP,  TF_UP_RESET,
                                    TF_UP_SNAPSHOT, TF_UP_INPUT, TF_UP_RESTORE};
  board_t board, other;
  power_up(&board, "chaos");
  power_up(&other, "chaos");
  for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
    for (uint64_t ahead = 0; ahead < 4; ahead++) {
      const uint64_t at = board.simulation.state.tick + ahead;
      send_plain(&board, TF_UP_START);
      send_plain(&other, TF_UP_START);
      send(&board, types[i], at, NULL, 0);
      send(&other, types[i], at, NULL, 0);
      for (uint64_t n = 0; n <= ahead; n++) {
        send_again(&board, types[i], at, NULL, 0);
        tick(&board);
        tick(&other);
        send_again(&board, types[i], at, NULL, 0);
        if (n < ahead) CHECK(board.link.queue[1].done == 0);
      }
      CHECK(code_of(&board) == TF_ANSWER_DONE);
      CHECK(code_of(&board) == TF_ANSWER_DONE);
      CHECK(code_of(&board) == 999);
      CHECK(board.link.ignored == 0);
      drain(&other);
      CHECK(same_state(&board.simulation.state, &other.simulation.state));
      /* Once it is answered, a copy is old. */
      send_again(&board, types[i], at, NULL, 0);
      tick(&board);
      tick(&other);
      CHECK(code_of(&board) == TF_ANSWER_OLD);
      CHECK(code_of(&board) == 999);
    }
  }
}

/* The number of a command that waits, but another type, or one byte more, less
 * or other than it has: no copy of it. */
TEST(another_command_of_a_number_that_waits_is_old) {
  uint8_t data[6] = {TF_RULE_PERSIST, 1, 2, 3, 4, 5};
  board_t board;
  power_up(&board, "chaos");
  send(&board, TF_UP_RULE, 5, data, 5);
  CHECK(board.link.waiting == 1);
  for (size_t length = 0; length <= sizeof data; length++)
    for (int type = TF_UP_RULE - 1; type <= TF_UP_RULE + 1; type++) {
      const bool same = type == TF_UP_RULE && length == 5;
      send_again(&board, (tf_type_t)type, 5, data, length);
      CHECK(board.link.waiting == 1);
      boundary(&board);
      CHECK(code_of(&board) == (same ? 999 : TF_ANSWER_OLD));
      CHECK(code_of(&board) == 999);
    }
  for (size_t i = 0; i < 5; i++) {
    data[i] ^= 1;
    send_again(&board, TF_UP_RULE, 5, data, 5);
    boundary(&board);
    CHECK(code_of(&board) == TF_ANSWER_OLD);
    data[i] ^= 1;
  }
}
