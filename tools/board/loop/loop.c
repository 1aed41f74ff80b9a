// A controller in C at the line of a board (UPLINK=yes), one setpoint a state,
// and how well the line keeps up: loop DEVICE [STATES]. It is meant to be
// copied: change control(). It needs POSIX, and the library in the real type of
// the board; docs/PROTOCOL.md says what goes over the line.
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "twofold.h"

#define AHEAD 2u      // ticks from a state to its setpoint
#define ASKED 10u     // states from one command with an answer to the next
#define PATIENCE 5000 // [ms]
#define BINS 16u

static struct {
  int line;
  uint32_t session, number, asked; // the latter: whose answer is awaited
  uint64_t tick, asked_at;         // of the newest state, and then
  tf_state_t state;
  tf_heartbeat_t first, last;
  bool is_described, has_beat, waits;
  const char *wrong;          // why it ends
  uint64_t answers[BINS + 1]; // by the ticks that they took; then more
  uint64_t several;           // steps with several possible modes,
  unsigned possible;          // and all these modes
  tf_decoder_t decoder;
  uint8_t buffer[TF_DECODER_SIZE(TF_FRAME_PAYLOAD)];
} board;

static int fail(const char *why) {
  (void)fprintf(stderr, "loop: %s\n", why);
  return 1;
}

// As fast as it can brake the disc, at a steady turntable.
static tf_input_t control(const tf_state_t *state) {
  return (tf_input_t){.omega0 = -1, .torque = TF_R(-0.1) * state->w};
}

static bool send_command(uint8_t type, uint64_t tick, const tf_input_t *input) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  uint8_t *at = wire + TF_COMMAND_AT;
  if (input != NULL) {
    at = tf_wire_put_real(at, input->omega0);
    at = tf_wire_put_real(at, input->r0);
    at = tf_wire_put_real(at, input->force);
    at = tf_wire_put_real(at, input->torque);
    at = tf_wire_put_real(at, input->alpha);
  }
  uint32_t number = board.number;
  const size_t size =
      tf_command_seal(wire, type, (size_t)(at - wire) - TF_COMMAND_AT,
                      board.session, &number, tick, NULL);
  if (type != TF_UP_DESCRIBE) board.number = number;
  return write(board.line, wire, size) == (ssize_t)size;
}

static void take_answer(const tf_frame_t *frame) {
  const uint32_t number = (uint32_t)tf_wire_get(frame->payload, 4);
  // A schema from before may name old numbers.
  if (frame->payload[4] == TF_UP_DESCRIBE && board.session == 0)
    board.is_described = false;
  if (frame->payload[4] == TF_UP_SETPOINT)
    board.wrong = "a setpoint is refused";
  if (!board.waits || frame->payload[4] != TF_UP_SNAPSHOT ||
      number != board.asked)
    return;
  const uint64_t took = board.tick - board.asked_at;
  board.answers[took < BINS ? took : BINS]++;
  board.waits = false;
}

// Returns: whether it is a state.
static bool take(const tf_frame_t *frame) {
  const uint8_t *at = frame->payload;
  if (frame->type == TF_DOWN_SCHEMA && board.is_described) {
    if (board.session != 0 && tf_wire_get(at + 13, 4) != board.session)
      board.wrong = "the board was restarted";
  } else if (frame->type == TF_DOWN_SCHEMA && at[0] == TF_REAL_BYTES) {
    board.is_described = true;
    board.session = (uint32_t)tf_wire_get(at + 13, 4);
    board.number = (uint32_t)tf_wire_get(at + 17, 4);
  } else if (frame->type == TF_DOWN_ANSWER) {
    take_answer(frame);
  } else if (frame->type == TF_DOWN_HEARTBEAT) {
    tf_read_heartbeat(at, &board.last);
    if (!board.has_beat) board.first = board.last;
    board.has_beat = true;
  } else if (frame->type == TF_DOWN_REPORT &&
             frame->length == TF_REPORT_BYTES) {
    const uint8_t *modes = at + 6 * TF_REAL_BYTES; // taken, set, choices
    board.several += modes[2] > 1;
    board.possible |= modes[2] > 1 ? modes[1] : 0u;
  } else if (frame->type == TF_DOWN_STATE && frame->length == TF_STATE_BYTES) {
    tf_read_state(at, frame->tick, &board.state);
    board.tick = frame->tick;
    return true;
  }
  return false;
}

// Reads what there is. Returns: how many states it has, or -1.
static int listen_once(void) {
  uint8_t bytes[4096];
  struct pollfd ready = {board.line, POLLIN, 0};
  if (poll(&ready, 1, PATIENCE) <= 0) return -1;
  const ssize_t got = read(board.line, bytes, sizeof bytes);
  int states = 0;
  size_t length = got > 0 ? (size_t)got : 0, taken = 0;
  tf_frame_t frame;
  for (const uint8_t *at = bytes;
       tf_decoder_block(&board.decoder, at, length, &taken, &frame);) {
    at += taken;
    length -= taken;
    states += take(&frame);
  }
  return got > 0 ? states : -1;
}

static bool begin(const char *device) {
  struct termios how;
  board.line = open(device, O_RDWR | O_NOCTTY);
  if (board.line < 0 || tcgetattr(board.line, &how) != 0) return false;
  cfmakeraw(&how);
  if (tcsetattr(board.line, TCSAFLUSH, &how) != 0) return false;
  tf_decoder_init(&board.decoder, board.buffer, sizeof board.buffer);
  board.is_described = true; // no schema counts before the answer
  const time_t until = time(NULL) + PATIENCE / 1000;
  for (time_t now, asked = 0; board.session == 0 || !board.is_described;) {
    now = time(NULL); // a board that just starts may miss the first question
    if (now > asked && !send_command(TF_UP_DESCRIBE, 0, NULL)) return false;
    asked = now;
    if (now > until || listen_once() < 0) return false;
  }
  return true;
}

static void print_counts(uint64_t sent) {
  const tf_heartbeat_t *a = &board.first, *b = &board.last;
  printf("setpoints  %" PRIu64 " sent; %" PRIu32 " lost, %" PRIu32
         " superseded, %" PRIu32 " late; %" PRIu32
         " ticks without a step, %" PRIu32 " records dropped\n",
         sent, b->lost - a->lost, b->superseded - a->superseded,
         b->late - a->late, b->skipped - a->skipped, b->dropped - a->dropped);
  printf("answers    after so many ticks:");
  for (unsigned i = 0; i <= BINS; i++)
    if (board.answers[i] > 0)
      printf(" %u%s: %" PRIu64, i, i < BINS ? "" : " or more",
             board.answers[i]);
  printf("\npossible   several modes in %" PRIu64 " steps:", board.several);
  for (unsigned mode = 0; mode < TF_MODES; mode++)
    if ((board.possible >> mode & 1u) != 0) printf(" %s", tf_mode_name(mode));
  printf("\n");
}

int main(int argc, char **argv) {
  const uint64_t wanted = argc > 2 ? strtoull(argv[2], NULL, 10) : 10000;
  uint64_t sent = 0;
  if (argc < 2) return fail("usage: loop DEVICE [STATES]");
  if (!begin(argv[1])) return fail("no board of this real type answers");
  while (sent < wanted) {
    const int states = listen_once();
    if (states < 0) return fail("the board is silent");
    if (board.wrong != NULL) return fail(board.wrong);
    if (states == 0) continue; // of several, the newest is answered
    const tf_input_t input = control(&board.state);
    if (!send_command(TF_UP_SETPOINT, board.tick + AHEAD, &input))
      return fail("the line takes nothing");
    if (++sent % ASKED != 0 || board.waits) continue;
    board.waits = true;
    board.asked = board.number;
    board.asked_at = board.tick;
    if (!send_command(TF_UP_SNAPSHOT, 0, NULL)) return fail("the line is full");
  }
  print_counts(sent);
  return 0;
}
