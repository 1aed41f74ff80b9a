// Frames from the board, commands to it, and the closed loop: states in, inputs
// out. Frames of other types (layouts, those of later versions) are ignored.
#include "board/hil/board.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define ANSWER_PATIENCE 2.0 // wait for an answer [s] ...
#define ANSWER_TRIES 4      // ... to a command that is sent so often in all
#define STATE_PATIENCE 5.0  // longest time without a state [s]
#define INPUT_TRIES 8 // attempts to send an input to a board that is stopped
#define OUTSTANDING 3 // inputs that may wait on the board; its queue has four
#define GIVEN_UP 16   // states after which an answer no longer counts as due
#define JUDGED 8      // samples behind which some records came in a row

int hil_message(int code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  (void)fputs("hil: ", stderr);
  (void)vfprintf(stderr, format, arguments);
  (void)fputc('\n', stderr);
  va_end(arguments);
  return code;
}

// The first session that the board reports, and the number with which to begin.
// Another one later means that the board has forgotten the run.
static int take_session(hil_board_t *board, const uint8_t *at) {
  const uint32_t session = (uint32_t)tf_wire_get(at + 13, 4);
  if (session == board->session) return CLI_DONE;
  if (board->session != 0)
    return hil_message(CLI_STOPPED, "%s: the board was restarted",
                       board->source.name);
  if ((at[4] & 16u) != 0 && board->key == NULL)
    return hil_message(CLI_REFUSED, "the board wants a tag (--key)");
  board->session = session;
  board->has_session = true;
  board->sequence = (uint32_t)tf_wire_get(at + 17, 4);
  board->deadman = (uint32_t)tf_wire_get(at + 21, 4);
  return CLI_DONE;
}

// Scene and step determine the machine on the board; the hash confirms it.
static int take_schema(hil_board_t *board, const tf_frame_t *frame) {
  const uint8_t *at = frame->payload;
  const size_t R = TF_REAL_BYTES;
  if (frame->length < 31 + R || at[0] != R)
    return hil_message(CLI_REFUSED, "the board computes in %s, this is %s",
                       at[0] == 4 ? "float" : "double",
                       R == 4 ? "float" : "double");
  if (at[3] != 0 || (at[4] & 2u) == 0)
    return hil_message(CLI_REFUSED, "the board %s",
                       at[3] != 0 ? "has another SCHEME, or SPLIT=no"
                                  : "takes no commands (UPLINK=yes)");
  const char *name = (const char *)at + 29 + R;
  const bool ends = memchr(name, 0, frame->length - 29 - R) != NULL;
  board->scene = NULL;
  for (int i = 0; ends && i < TF_SCENES; i++)
    if (!strcmp(tf_scenes[i]->name, name)) board->scene = tf_scenes[i];
  if (board->scene == NULL)
    return hil_message(CLI_REFUSED, "the board's scene is not known here");
  board->params = board->scene->params;
  board->params.dt = tf_wire_get_real(at + 29);
  board->seed = (uint32_t)tf_wire_get(at + 5, 4);
  if (tf_params_hash(&board->params) != tf_wire_get(at + 9, 4))
    return hil_message(CLI_REFUSED,
                       "the board's parameters are not those of scene %s",
                       board->scene->name);
  return take_session(board, at);
}

static void take_state(hil_board_t *board, const tf_frame_t *frame) {
  if (!board->listens) return;
  for (uint64_t tick = frame->tick, rest; tick > 0; tick = rest) {
    rest = board->stride % tick; // Euclid's
    board->stride = tick;
  }
  if (board->count == board->room || frame->tick % board->plan.every != 0)
    return;
  if (board->count > 0 && board->samples[board->count - 1].tick >= frame->tick)
    return; // the board is not running
  hil_sample_t *sample = &board->samples[board->count++];
  sample->tick = frame->tick;
  memcpy(sample->state, frame->payload, TF_STATE_BYTES);
  board->has_new = true;
}

static void take_report(hil_board_t *board, const tf_frame_t *frame) {
  if (!board->listens || board->count == 0) return;
  hil_sample_t *last = &board->samples[board->count - 1];
  if (last->tick != frame->tick) return;
  memcpy(last->report, frame->payload, TF_REPORT_BYTES);
  last->has_report = true;
}

static size_t waiting(const hil_board_t *board) {
  size_t waiting = 0;
  for (size_t i = board->count; i > 0 && board->count - i < GIVEN_UP; i--)
    waiting += board->samples[i - 1].sent && !board->samples[i - 1].answered;
  return waiting;
}

// An answer belongs to the command of its type and number, and the first one
// counts: a line that doubles a frame that was answered already brings `old`
// behind it. To a command that was sent again `old` means that it was taken
// before and only its answer was lost: nobody else commands this board.
static void take_answer(hil_board_t *board, const tf_frame_t *frame) {
  const uint32_t sequence = (uint32_t)tf_wire_get(frame->payload, 4);
  const uint8_t type = frame->payload[4], code = frame->payload[5];
  const int value = code < 128 ? code : code - 256;
  if (type == board->ordered && sequence == board->number) {
    if (board->has_answer) return;
    board->answer = value == TF_ANSWER_OLD && board->tries > 1 ? 0 : value;
    board->has_answer = true;
    // Schemas of before may have waited on the line, and name old numbers.
    if (type == TF_UP_DESCRIBE) {
      board->session = 0;
      board->has_session = false;
    }
    return;
  }
  if (type == TF_UP_STOP && sequence == board->stop_number && value == 0) {
    board->has_stopped = true;
    board->stopped_at = frame->tick;
    return;
  }
  for (size_t i = type == TF_UP_INPUT ? board->count : 0; i > 0; i--) {
    hil_sample_t *sample = &board->samples[i - 1];
    if (!sample->sent || sample->answered || sample->sequence != sequence)
      continue;
    sample->answered = true;
    sample->code = value;
    sample->effect = frame->tick;
    return;
  }
}

static int take(hil_board_t *board, const tf_frame_t *frame) {
  if (!cli_guard_takes(&board->guard, frame))
    return board->guard.forged
               ? hil_message(CLI_STOPPED, "%s: " CLI_FORGED, board->source.name)
               : CLI_DONE;
  if (frame->type == TF_DOWN_SCHEMA) return take_schema(board, frame);
  if (frame->type == TF_DOWN_STATE && frame->length == TF_STATE_BYTES)
    take_state(board, frame);
  if (frame->type == TF_DOWN_REPORT && frame->length == TF_REPORT_BYTES)
    take_report(board, frame);
  if (frame->type == TF_DOWN_ANSWER && frame->length >= 8)
    take_answer(board, frame);
  if (frame->type == TF_DOWN_EXPIRED && board->listens &&
      board->expired_count < board->room)
    board->expired[board->expired_count++] = frame->tick;
  if (frame->type == TF_DOWN_HEARTBEAT && frame->length >= TF_HEARTBEAT_BYTES) {
    tf_read_heartbeat(frame->payload, &board->heartbeat);
    board->has_heartbeat = true;
  }
  return CLI_DONE;
}

static int listen(hil_board_t *board) {
  uint8_t bytes[512];
  size_t length = 0, taken = 0;
  tf_frame_t frame;
  const cli_source_found_t found =
      cli_source_read(&board->source, bytes, sizeof bytes, 100, &length);
  if (cli_stop_asked()) return hil_message(CLI_STOPPED, "interrupted");
  if (found == CLI_SOURCE_GONE || found == CLI_SOURCE_END ||
      board->source.broke)
    return hil_message(CLI_STOPPED, "%s: the board went away",
                       board->source.name);
  for (const uint8_t *at = bytes;
       tf_decoder_block(&board->decoder, at, length, &taken, &frame);) {
    at += taken;
    length -= taken;
    CLI_TRY(take(board, &frame));
  }
  board->is_answered = waiting(board) == 0;
  return CLI_DONE;
}

// number: in, the next one, or that of a command that is sent again.
static int send_as(hil_board_t *board, uint32_t number, tf_type_t type,
                   uint64_t tick, const uint8_t *data, size_t length) {
  uint8_t wire[TF_FRAME_SIZE(TF_COMMAND_BYTES)];
  if (length > 0) memcpy(wire + TF_COMMAND_AT, data, length);
  const size_t size = tf_command_seal(
      wire, (uint8_t)type, length, board->session, &number, tick, board->key);
  // The board does not count questions.
  if (type != TF_UP_DESCRIBE) board->sequence = number;
  if (cli_source_write(&board->source, wire, size)) return CLI_DONE;
  return hil_message(CLI_STOPPED, "%s: %s", board->source.name,
                     strerror(board->source.error));
}

// Reads until a flag is set, or for as many seconds and as often as silence
// takes: the computer may have stood still. The caller looks at the flag.
static int await(hil_board_t *board, const bool *flag, double patience) {
  const double until = cli_now() + patience;
  for (int n = 0; !*flag && (n < 10 * patience || cli_now() < until); n++)
    CLI_TRY(listen(board));
  return CLI_DONE;
}

// Sends a command and waits until it has taken effect. Without an answer it is
// sent again with the same number, whether it was lost or its answer was: the
// board takes a number once.
static int order(hil_board_t *board, tf_type_t type, const uint8_t *data,
                 size_t length) {
  board->ordered = type;
  board->number = board->sequence;
  board->tries = 0;
  board->has_answer = false;
  while (!board->has_answer && board->tries < ANSWER_TRIES) {
    board->tries++;
    CLI_TRY(send_as(board, board->number, type, 0, data, length));
    CLI_TRY(await(board, &board->has_answer, ANSWER_PATIENCE));
  }
  if (!board->has_answer && board->key != NULL && !board->guard.vouched)
    return hil_message(CLI_STOPPED, "%s: " CLI_NOT_VOUCHED, board->source.name);
  if (!board->has_answer)
    return hil_message(CLI_STOPPED,
                       "%s: no answer: it takes no commands, or its line "
                       "does not carry its records (EVERY)",
                       board->source.name);
  if (board->answer != 0)
    return hil_message(CLI_REFUSED, "the board refuses command %02X: %d",
                       (unsigned)type, board->answer);
  return CLI_DONE;
}

// Sends a stop that takes effect at a tick; `has_stopped` says that it did.
static int stop_at(hil_board_t *board, uint64_t tick) {
  board->has_stopped = false;
  board->stop_number = board->sequence;
  return send_as(board, board->sequence, TF_UP_STOP, tick, NULL, 0);
}

static int send_input(hil_board_t *board, hil_sample_t *sample, uint64_t tick) {
  uint8_t payload[5 * TF_REAL_BYTES];
  uint8_t *at = payload;
  const tf_input_t *input = &sample->input;
  at = tf_wire_put_real(at, input->omega0);
  at = tf_wire_put_real(at, input->r0);
  at = tf_wire_put_real(at, input->force);
  at = tf_wire_put_real(at, input->torque);
  (void)tf_wire_put_real(at, input->alpha);
  sample->sent = true;
  board->is_answered = false;
  sample->sequence = board->sequence;
  return send_as(board, board->sequence, TF_UP_INPUT, tick, payload,
                 sizeof payload);
}

static int order_deadman(hil_board_t *board, uint64_t ticks) {
  uint8_t data[4];
  (void)tf_wire_put(data, ticks, sizeof data);
  return order(board, TF_UP_DEADMAN, data, sizeof data);
}

// Without its session a board takes no command but the question who it is.
// Commands that another host left in the queue are cleared. Frames that are
// still on the line are ignored until the first answer comes.
static int prepare(hil_board_t *board) {
  static const tf_type_t orders[] = {TF_UP_CLEAR, TF_UP_STOP, TF_UP_RESET};
  if (!cli_guard_begin(&board->guard, board->key))
    return hil_message(CLI_STOPPED, "--key: the system has no random numbers");
  CLI_TRY(order(board, TF_UP_DESCRIBE, board->guard.nonce,
                board->key != NULL ? TF_NONCE_BYTES : 0));
  CLI_TRY(await(board, &board->has_session, STATE_PATIENCE));
  if (!board->has_session)
    return hil_message(CLI_STOPPED, "the board does not describe itself");
  for (size_t i = 0; i < 3; i++) CLI_TRY(order(board, orders[i], NULL, 0));
  if (board->plan.deadman == HIL_BOARDS)
    board->plan.deadman = board->deadman;
  else
    CLI_TRY(order_deadman(board, board->plan.deadman));
  board->listens = true;
  board->is_answered = true;
  CLI_TRY(await(board, &board->has_new, STATE_PATIENCE));
  if (!board->has_new)
    return hil_message(CLI_STOPPED, "the board sends no state");
  return board->samples[0].tick == 0
             ? CLI_DONE
             : hil_message(CLI_STOPPED, "the board did not go to its start");
}

static uint64_t last_tick(const hil_board_t *board) {
  return board->samples[board->count - 1].tick;
}

static int stopped(const hil_board_t *board, const char *why) {
  return hil_message(CLI_STOPPED, "step %" PRIu64 ": %s", last_tick(board),
                     why);
}

// Sends the input for the newest state, if the board has room for it.
static int respond(hil_board_t *board) {
  const hil_plan_t *plan = &board->plan;
  hil_sample_t *sample = &board->samples[board->count - 1];
  tf_machine_t machine;
  tf_state_t state;
  board->has_new = false;
  if (sample->tick + plan->delay >= plan->steps ||
      sample->tick >= plan->silent || waiting(board) >= OUTSTANDING)
    return CLI_DONE;
  (void)tf_prepare(&machine, &board->params, NULL);
  tf_read_state(sample->state, sample->tick, &state);
  sample->input = hil_control(&machine, &state);
  return send_input(board, sample, sample->tick + plan->delay);
}

// The board stands where its stop was to take effect: without that answer it
// may have run on, and no input could come in time. The next stop is sent
// first, because after the start the board does not wait.
static int respond_in_lockstep(hil_board_t *board) {
  const uint64_t tick = last_tick(board);
  if (tick != (board->count - 1) * board->plan.every)
    return stopped(board, "a command was lost");
  if (tick > 0) CLI_TRY(await(board, &board->has_stopped, STATE_PATIENCE));
  if (tick > 0 && !(board->has_stopped && board->stopped_at == tick))
    return stopped(board, "its stop was lost");
  CLI_TRY(stop_at(board, tick + board->plan.every));
  // The board is stopped, so an input that is sent twice takes effect once.
  for (int tries = 0; tries < INPUT_TRIES; tries++) {
    CLI_TRY(respond(board));
    CLI_TRY(await(board, &board->is_answered, 0.5));
    if (board->is_answered) break;
  }
  return board->is_answered ? order(board, TF_UP_START, NULL, 0)
                            : stopped(board, "its input was lost");
}

// Only its ticks tell a board's EVERY. Lockstep meets a state at any tick.
static int check(const hil_board_t *board) {
  const uint64_t every = board->plan.every;
  if (board->stride == 0 || every % board->stride == 0) return CLI_DONE;
  return hil_message(CLI_REFUSED,
                     "--every %" PRIu64 " is no multiple of %" PRIu64
                     ", the steps between the states that come (EVERY)",
                     every, board->stride);
}

int hil_drive(hil_board_t *board) {
  const hil_plan_t *plan = &board->plan;
  CLI_TRY(prepare(board));
  while (last_tick(board) < plan->steps && board->count < board->room) {
    if (board->has_new)
      CLI_TRY(plan->in_lockstep ? respond_in_lockstep(board) : respond(board));
    if (last_tick(board) == 0 && !plan->in_lockstep)
      CLI_TRY(order(board, TF_UP_START, NULL, 0));
    CLI_TRY(await(board, &board->has_new, STATE_PATIENCE));
    if (!board->has_new || board->count > JUDGED) CLI_TRY(check(board));
    if (!board->has_new) return stopped(board, "no state follows");
  }
  CLI_TRY(check(board));
  CLI_TRY(order(board, TF_UP_STOP, NULL, 0));
  // Inputs that stay without an answer are counted in the report.
  CLI_TRY(await(board, &board->is_answered, 1));
  // Whoever commands the board next finds it as it was.
  return plan->deadman == board->deadman ? CLI_DONE
                                         : order_deadman(board, board->deadman);
}
