/* The fixed-rate loop of port/loop.c on a board made of numbers: its clock goes
 * on by what a step, a record and a look at the time are said to cost, so that
 * every overrun and every dropped record here is exact and none depends on
 * the machine that tests. */
#include "tap.h"
/* The loop itself, with the board below. */
#include "../../port/loop.c" /* NOLINT(bugprone-suspicious-include) */

#define PERIOD 1000u /* [units of the clock] */

static struct {
  uint64_t clock; /* all bits; the loop sees the low ones */
  uint32_t step_costs, record_costs, put_costs;
  uint32_t slow_step, slow_costs; /* one step that costs more */
  uint32_t long_step;             /* or more than the clock measures */
  uint64_t long_costs;
  uint32_t slow_record, outlier_costs; /* one record */
  uint32_t stands_until;               /* ticks at which the app stands */
  uint32_t moves_at, moves_to;         /* after these steps, the next record */
  bool stalled;                        /* the line takes nothing */
  bool flooded;                        /* a byte is always there */
  bool broken;
  uint32_t received, put, latched, stepped, records, beats, idled, answers;
  uint32_t fed;              /* the watchdog */
  uint32_t last_tick, twice; /* steps in the same tick */
  uint32_t record_step[64];
} board;

void port_init(void) {}
void port_halt(int code) { exit(code); }
bool port_tick_start(uint32_t rate) { return rate == 1000; }
static uint32_t tick_now(void) { return (uint32_t)(board.clock / PERIOD); }
uint32_t port_ticks(void) {
  board.clock++;
  return tick_now();
}
uint32_t port_clock(void) { return (uint32_t)board.clock; }
void port_feed(void) { board.fed++; }
bool port_stack_holds(void) { return true; }
void port_fault(const char *why, uint32_t at, uint32_t cause) {
  printf("# %s, %" PRIu32 ", %" PRIu32 "\n", why, at, cause);
  exit(PORT_FAULT);
}
uint32_t port_clock_rate(void) { return 1000u * PERIOD; }
unsigned port_room(void) { return !board.stalled; }
void port_put(uint8_t byte) {
  (void)byte;
  board.put++;
  board.clock += board.put_costs;
}
int port_get(void) { return board.flooded ? 0x55 : -1; }
void port_idle(uint32_t seen) {
  if (tick_now() == seen) board.clock = (board.clock / PERIOD + 1) * PERIOD;
  board.idled++;
}

void app_receive(uint8_t byte, uint32_t when) {
  (void)when;
  board.received += byte == 0x55;
}
int app_latch(void) {
  board.latched++;
  return 0;
}
loop_step_t app_step(uint32_t *until_record) {
  const uint32_t tick = tick_now();
  if (board.moves_to > 0 && board.stepped == board.moves_at)
    *until_record = board.moves_to;
  if (board.latched <= board.stands_until) return LOOP_STOOD;
  if (board.broken) return LOOP_BROKE;
  board.twice += board.stepped > 0 && tick == board.last_tick;
  board.last_tick = tick;
  board.stepped++;
  board.clock +=
      board.stepped == board.slow_step ? board.slow_costs : board.step_costs;
  if (board.stepped == board.long_step) board.clock += board.long_costs;
  return LOOP_STEPPED;
}
void app_output(void) {}
unsigned app_record(uint8_t to[]) {
  to[0] = 'r';
  if (board.records < 64) board.record_step[board.records] = board.stepped;
  board.records++;
  board.clock += board.records == board.slow_record ? board.outlier_costs
                                                    : board.record_costs;
  return 100;
}
unsigned app_other(uint8_t to[]) {
  to[0] = 'a';
  if (board.stepped != 20 || board.answers == 0) return 0;
  board.answers--;
  return 40;
}
unsigned app_heartbeat(const loop_counts_t *counts, uint8_t to[]) {
  to[0] = (uint8_t)counts->steps;
  board.beats++;
  return 100;
}

static loop_counts_t counted;

static loop_end_t run_loop(uint32_t steps, uint32_t every,
                           loop_policy_t policy) {
  const loop_plan_t plan = {1000, steps, every, 1000, policy};
  return loop_run(&plan, &counted);
}

static void reset(uint32_t step_costs) {
  memset(&board, 0, sizeof board);
  memset(&the_loop, 0, sizeof the_loop);
  board.step_costs = step_costs;
  board.put_costs = 1;
}

/* Runs so many steps, of which none may be late. */
static void run_in_time(uint32_t steps, uint32_t every) {
  CHECK(run_loop(steps, every, LOOP_SKIP) == LOOP_DONE);
  CHECK(counted.steps == steps && board.stepped == steps && board.twice == 0);
  CHECK(counted.overruns == 0 && counted.skipped == 0);
}

TEST(every_tick_has_one_step) {
  reset(300);
  run_in_time(5000, 10);
  CHECK(counted.dropped == 0);
  CHECK(counted.sent == board.records - 3 + board.beats);
  CHECK(board.records == 3 + 501 && board.beats == 6);
  CHECK(board.put == 100 * counted.sent); /* all of it left */
  CHECK(counted.shortest >= 300 && counted.longest <= 310);
  CHECK(counted.sum / counted.steps >= 300 &&
        counted.sum / counted.steps <= 310);
  CHECK(board.idled > 0);
  CHECK(board.fed >= 5000 && board.fed < 5000 + 1100); /* once in each tick */
}

/* What late steps of 100 cost: each is finished, none is in the tick of another
 * one, and ticks that came meanwhile are skipped or, where asked, end it. */
TEST(overruns_are_finished_and_counted) {
  static const struct {
    uint32_t step_costs, slow_costs; /* the latter of step 50 */
    loop_policy_t policy;
    loop_end_t end;
    uint32_t steps, overruns, skipped;
  } cases[] = {{300, 3500, LOOP_SKIP, LOOP_DONE, 100, 1, 3},
               {300, 1100, LOOP_STOP, LOOP_OVERRAN, 50, 1, 1},
               {300, 300, LOOP_STOP, LOOP_DONE, 100, 0, 0},
               {1500, 1500, LOOP_SKIP, LOOP_DONE, 100, 100, 100}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    reset(cases[i].step_costs);
    board.slow_step = 50;
    board.slow_costs = cases[i].slow_costs;
    CHECK(run_loop(100, 10, cases[i].policy) == cases[i].end);
    CHECK(counted.steps == cases[i].steps && board.stepped == counted.steps);
    CHECK(counted.overruns == cases[i].overruns && board.twice == 0);
    CHECK(counted.skipped == cases[i].skipped);
    CHECK(counted.longest >= cases[i].slow_costs);
  }
}

/* Heartbeats are of the clock: two ticks to a step, or a gap of many. */
TEST(late_board_has_its_heartbeats) {
  reset(1500);
  CHECK(run_loop(5000, 10, LOOP_SKIP) == LOOP_DONE);
  CHECK(counted.skipped == 5000 && board.beats == 1 + 10);
  reset(300);
  board.slow_step = 999;
  board.slow_costs = 5000 * PERIOD;
  CHECK(run_loop(2000, 10, LOOP_SKIP) == LOOP_DONE);
  CHECK(board.beats == 1 + 2 && counted.skipped == 5000);
}

TEST(stalled_reader_costs_records_and_no_step) {
  reset(300);
  board.stalled = true;
  run_in_time(10000, 10);
  CHECK(counted.sent >= 1 && counted.sent * 100 <= LOOP_ROOM);
  /* what was due: a record every 10 ticks and one before, 11 heartbeats */
  CHECK(counted.sent + counted.dropped == 1001 + 11);
  CHECK(board.put == 0);
}

TEST(flood_costs_neither_step_nor_record) {
  reset(300);
  board.flooded = true;
  run_in_time(1000, 10);
  CHECK(counted.dropped == 0 && board.put == 100 * counted.sent);
  CHECK(board.received > 1000 * 100); /* what time there was */
}

TEST(record_that_would_take_too_long_is_dropped) {
  reset(800);
  board.record_costs = 400;
  run_in_time(1000, 1);
  /* those before the first step are how the loop knows */
  CHECK(board.records == 3 + 1 && counted.dropped == 1000);
}

/* A moment that was not the record's own. */
TEST(one_slow_record_does_not_end_telemetry) {
  for (uint32_t slow = 1; slow < 8; slow++) {
    reset(300);
    board.record_costs = 50;
    board.slow_record = slow;
    board.outlier_costs = 5000;
    CHECK(run_loop(100, 1, LOOP_SKIP) == LOOP_DONE);
    CHECK(counted.steps == 100 && counted.dropped == 0);
    CHECK(board.records == 3 + 101);
  }
}

/* Not one a tick, however busy the line, or a full queue stays full. */
TEST(all_answers_leave_in_their_tick) {
  reset(300);
  board.flooded = true;
  board.answers = 4;
  run_in_time(40, 1);
  CHECK(board.answers == 0);
}

/* A run that begins at any tick has its records at steps known beforehand; a
 * tick at which the app stands is no step, and is reported all the same. */
TEST(records_can_be_moved_to_a_step) {
  reset(300);
  const loop_plan_t plan = {1000, 40, 10, 1000, LOOP_SKIP};
  board.stands_until = 7;
  CHECK(loop_run(&plan, &counted) == LOOP_DONE);
  CHECK(board.record_step[4] == 3); /* the tenth tick, seven stood */
  CHECK(counted.steps == 40 && board.latched == 47);
  reset(300);
  board.moves_at = 24;
  board.moves_to = 4;
  CHECK(run_loop(40, 10, LOOP_SKIP) == LOOP_DONE);
  CHECK(board.record_step[4] == 10 && board.record_step[5] == 20);
  CHECK(board.record_step[6] == 28 && board.record_step[7] == 38);
}

/* Ticks and clock that pass 2^32, in the first second, between steps and in the
 * middle of one: nothing is counted that did not happen. */
TEST(ticks_and_clock_go_round) {
  static const uint64_t ends[] = {(uint64_t)1 << 32,
                                  PERIOD * ((uint64_t)1 << 32),
                                  PERIOD * ((uint64_t)1 << 40)};
  for (unsigned i = 0; i < 3; i++)
    for (uint64_t k = 0; k < 40; k++) {
      reset(300);
      board.clock = ends[i] - 7 * k * k * PERIOD / 5;
      run_in_time(2000, 10);
      CHECK(counted.dropped == 0 && board.records == 3 + 201);
      CHECK(counted.shortest >= 300 && counted.longest <= 310);
      CHECK(board.put == 100 * counted.sent);
    }
}

/* A step that lasts longer than the clock measures is not taken for a short
 * one. */
TEST(step_longer_than_the_clock_is_told) {
  for (uint64_t past = 0; past < 3; past++) {
    reset(300);
    board.long_step = 50;
    board.long_costs = ((uint64_t)1 << 32) + 100 + 100 * past;
    CHECK(run_loop(100, 10, LOOP_SKIP) == LOOP_DONE);
    CHECK(counted.longest == UINT32_MAX && counted.shortest >= 300);
    CHECK(counted.overruns == 1);
  }
}

TEST(ends_are_told_apart) {
  const loop_plan_t wrong = {7, 1, 1, 1, LOOP_SKIP};
  reset(300);
  CHECK(loop_run(&wrong, &counted) == LOOP_NO_TIMER);
  board.broken = true;
  CHECK(run_loop(10, 1, LOOP_SKIP) == LOOP_REFUSED && counted.steps == 0);
}
