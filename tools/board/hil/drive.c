// The closed loop at the controller's end: states in, inputs out.
#include <inttypes.h>

#include "board/hil/board.h"

#define PATIENCE 5.0  // longest time without a state [s]
#define TRIES 8       // attempts to send an input to a board that is stopped
#define OUTSTANDING 3 // inputs that may wait on the board; its queue has four
#define JUDGED 8      // samples behind which some records came in a row

// Asks the board who it is: without its session it takes no other command.
static int ask(hil_board_t *board) {
  CLI_TRY(hil_board_order(board, TF_UP_DESCRIBE, NULL, 0));
  CLI_TRY(hil_board_await(board, &board->has_session, PATIENCE));
  return board->has_session
             ? CLI_DONE
             : hil_message(CLI_STOPPED, "the board does not describe itself");
}

static int order_deadman(hil_board_t *board, uint64_t ticks) {
  uint8_t data[4];
  (void)tf_wire_put(data, ticks, sizeof data);
  return hil_board_order(board, TF_UP_DEADMAN, data, sizeof data);
}

// Commands that another host left in the queue are cleared. Frames that are
// still on the line are ignored until the first answer comes.
int hil_prepare(hil_board_t *board) {
  static const tf_type_t orders[] = {TF_UP_CLEAR, TF_UP_STOP, TF_UP_RESET};
  CLI_TRY(ask(board));
  for (size_t i = 0; i < 3; i++)
    CLI_TRY(hil_board_order(board, orders[i], NULL, 0));
  if (board->plan.deadman == HIL_BOARDS)
    board->plan.deadman = board->deadman;
  else
    CLI_TRY(order_deadman(board, board->plan.deadman));
  board->listens = true;
  board->is_answered = true;
  CLI_TRY(hil_board_await(board, &board->has_new, PATIENCE));
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
      sample->tick >= plan->silent || hil_board_waiting(board) >= OUTSTANDING)
    return CLI_DONE;
  (void)tf_prepare(&machine, &board->params, NULL);
  tf_read_state(sample->state, sample->tick, &state);
  sample->input = hil_control(&machine, &state);
  return hil_board_drive(board, sample, sample->tick + plan->delay);
}

// The board stands where its stop was to take effect: without that answer it
// may have run on, and no input could come in time. The next stop is sent
// first, because after the start the board does not wait.
static int respond_in_lockstep(hil_board_t *board) {
  const uint64_t tick = last_tick(board);
  if (tick != (board->count - 1) * board->plan.every)
    return stopped(board, "a command was lost");
  if (tick > 0) CLI_TRY(hil_board_await(board, &board->has_stopped, PATIENCE));
  if (tick > 0 && !(board->has_stopped && board->stopped_at == tick))
    return stopped(board, "its stop was lost");
  CLI_TRY(hil_board_stop_at(board, tick + board->plan.every));
  // The board is stopped, so an input that is sent twice takes effect once.
  for (int tries = 0; tries < TRIES; tries++) {
    CLI_TRY(respond(board));
    CLI_TRY(hil_board_await(board, &board->is_answered, 0.5));
    if (board->is_answered) break;
  }
  return board->is_answered ? hil_board_order(board, TF_UP_START, NULL, 0)
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
  while (last_tick(board) < plan->steps && board->count < board->room) {
    if (board->has_new)
      CLI_TRY(plan->in_lockstep ? respond_in_lockstep(board) : respond(board));
    if (last_tick(board) == 0 && !plan->in_lockstep)
      CLI_TRY(hil_board_order(board, TF_UP_START, NULL, 0));
    CLI_TRY(hil_board_await(board, &board->has_new, PATIENCE));
    if (!board->has_new || board->count > JUDGED) CLI_TRY(check(board));
    if (!board->has_new) return stopped(board, "no state follows");
  }
  CLI_TRY(check(board));
  CLI_TRY(hil_board_order(board, TF_UP_STOP, NULL, 0));
  // Inputs that stay without an answer are counted in the report.
  CLI_TRY(hil_board_await(board, &board->is_answered, 1));
  // Whoever commands the board next finds it as it was.
  return plan->deadman == board->deadman ? CLI_DONE
                                         : order_deadman(board, board->deadman);
}
