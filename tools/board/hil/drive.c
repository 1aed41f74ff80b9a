// The closed loop at the controller's end: states in, inputs out.
#include <inttypes.h>

#include "board/hil/board.h"

#define PATIENCE 5.0  // longest time without a state [s]
#define TRIES 8       // attempts to send an input to a board that is stopped
#define OUTSTANDING 3 // inputs that may wait on the board; its queue has four
#define JUDGED 8      // samples behind which some records came in a row

static bool has_session(const hil_board_t *board) {
  return board->session != 0;
}

// Asks the board who it is: without its session it takes no other command.
static hil_code_t ask(hil_board_t *board) {
  HIL_TRY(hil_board_order(board, TF_UP_DESCRIBE, NULL, 0));
  HIL_TRY(hil_board_await(board, has_session, PATIENCE));
  return has_session(board)
             ? HIL_EQUAL
             : hil_message(HIL_STOPPED, "the board does not describe itself");
}

static hil_code_t order_deadman(hil_board_t *board, uint32_t steps) {
  uint8_t data[4];
  (void)tf_wire_put(data, steps, sizeof data);
  const hil_code_t code =
      hil_board_order(board, TF_UP_DEADMAN, data, sizeof data);
  board->deadman = steps;
  return code;
}

// Whoever commands the board next finds it as it was. What the run had is what
// is reported.
static hil_code_t give_back(hil_board_t *board) {
  const uint32_t had = board->deadman;
  const hil_code_t code = order_deadman(board, board->deadman_found);
  board->deadman = had;
  return code;
}

static bool has_state(const hil_board_t *board) { return board->count > 0; }

// Commands that another host left in the queue are cleared. Frames that are
// still on the line are ignored until the first answer comes.
hil_code_t hil_prepare(hil_board_t *board, const hil_plan_t *plan) {
  static const tf_type_t orders[] = {TF_UP_CLEAR, TF_UP_STOP, TF_UP_RESET};
  HIL_TRY(ask(board));
  for (size_t i = 0; i < 3; i++)
    HIL_TRY(hil_board_order(board, orders[i], NULL, 0));
  board->deadman_found = board->deadman;
  if (plan->has_deadman) HIL_TRY(order_deadman(board, plan->deadman));
  board->listens = true;
  HIL_TRY(hil_board_await(board, has_state, PATIENCE));
  if (!has_state(board))
    return hil_message(HIL_STOPPED, "the board sends no state");
  return board->samples[0].tick == 0
             ? HIL_EQUAL
             : hil_message(HIL_STOPPED, "the board did not go to its start");
}

static uint64_t last_tick(const hil_board_t *board) {
  return board->samples[board->count - 1].tick;
}

static hil_code_t stopped(const hil_board_t *board, const char *why) {
  return hil_message(HIL_STOPPED, "step %" PRIu64 ": %s", last_tick(board),
                     why);
}

static bool has_new(const hil_board_t *board) { return board->has_new; }

static bool is_answered(const hil_board_t *board) {
  return hil_board_waiting(board) == 0;
}

// Sends the input for the newest state, if the board has room for it.
static hil_code_t respond(hil_board_t *board, const hil_plan_t *plan) {
  hil_sample_t *sample = &board->samples[board->count - 1];
  tf_machine_t machine;
  tf_state_t state;
  board->has_new = false;
  if (sample->tick + plan->delay >= plan->steps ||
      sample->tick >= plan->silent || hil_board_waiting(board) >= OUTSTANDING)
    return HIL_EQUAL;
  (void)tf_prepare(&machine, &board->params, NULL);
  tf_read_state(sample->state, sample->tick, &state);
  sample->input = hil_control(&machine, &state);
  return hil_board_drive(board, sample, sample->tick + plan->delay);
}

static bool has_stopped(const hil_board_t *board) { return board->has_stopped; }

// The board stands where its stop was to take effect: without that answer it
// may have run on, and no input could come in time. The next stop is sent
// first, because after the start the board does not wait.
static hil_code_t respond_in_lockstep(hil_board_t *board,
                                      const hil_plan_t *plan) {
  const uint64_t tick = last_tick(board);
  if (tick != (board->count - 1) * plan->every)
    return stopped(board, "a command was lost");
  if (tick > 0) HIL_TRY(hil_board_await(board, has_stopped, PATIENCE));
  if (tick > 0 && !(board->has_stopped && board->stopped_at == tick))
    return stopped(board, "its stop was lost");
  HIL_TRY(hil_board_stop_at(board, tick + plan->every));
  // The board is stopped, so an input that is sent twice takes effect once.
  for (int tries = 0; tries < TRIES; tries++) {
    HIL_TRY(respond(board, plan));
    HIL_TRY(hil_board_await(board, is_answered, 0.5));
    if (is_answered(board)) break;
  }
  return is_answered(board) ? hil_board_order(board, TF_UP_START, NULL, 0)
                            : stopped(board, "its input was lost");
}

// Only its ticks tell a board's EVERY. Lockstep meets a state at any tick.
static hil_code_t check(const hil_board_t *board, const hil_plan_t *plan) {
  if (board->stride == 0 || plan->every % board->stride == 0) return HIL_EQUAL;
  return hil_message(HIL_REFUSED,
                     "--every %" PRIu32 " is no multiple of %" PRIu64
                     ", the steps between the states that come (EVERY)",
                     plan->every, board->stride);
}

hil_code_t hil_drive(hil_board_t *board, const hil_plan_t *plan) {
  board->has_new = true; // the start
  while (last_tick(board) < plan->steps && board->count < board->room) {
    if (board->has_new)
      HIL_TRY(plan->in_lockstep ? respond_in_lockstep(board, plan)
                                : respond(board, plan));
    if (last_tick(board) == 0 && !plan->in_lockstep)
      HIL_TRY(hil_board_order(board, TF_UP_START, NULL, 0));
    HIL_TRY(hil_board_await(board, has_new, PATIENCE));
    if (!board->has_new || board->count > JUDGED) HIL_TRY(check(board, plan));
    if (!board->has_new) return stopped(board, "no state follows");
  }
  HIL_TRY(check(board, plan));
  HIL_TRY(hil_board_order(board, TF_UP_STOP, NULL, 0));
  // Inputs that stay without an answer are counted in the report.
  HIL_TRY(hil_board_await(board, is_answered, 1));
  return plan->has_deadman ? give_back(board) : HIL_EQUAL;
}
