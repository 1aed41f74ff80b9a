// The fixed-rate loop: see loop.h. The application writes records into a buffer
// in the time that a tick leaves, and their bytes go to the line one by one.
#include "loop.h"

#include "app.h"
#include "port.h"

typedef struct {
  const loop_plan_t *plan;
  loop_counts_t *counts;
  uint32_t tick;     // the present one
  uint32_t begun;    // clock at its start
  uint32_t period;   // [clock]
  uint32_t tellable; // ticks that the clock can measure
  // Time that writing takes [clock]: of anything, and of a record.
  uint32_t longest_record, shortest_record;
  uint32_t until_record, last_heartbeat; // the latter is a tick
  unsigned first, last; // the bytes to send are buffer[first .. last - 1]
  uint8_t buffer[LOOP_ROOM];
} loop_t;

static loop_t the_loop;

// The time that a record takes hardly varies, and descriptions take a few times
// as long. A longer time was spent elsewhere (in an emulator, or on a computer
// with other work), and one such moment must not end all telemetry.
#define OUTLIER 8u

// Whether a record would be finished before the next tick.
static int is_time_for_record(const loop_t *loop) {
  const uint32_t spent = port_clock() - loop->begun;
  uint32_t takes = loop->longest_record;
  if (takes / OUTLIER > loop->shortest_record)
    takes = loop->shortest_record * OUTLIER;
  return spent < loop->period && loop->period - spent > takes;
}

// Writes records that are not sent, to measure how long they take.
static void time_a_record(loop_t *loop) {
  loop->shortest_record = UINT32_MAX;
  for (int i = 0; i < 3; i++) {
    const uint32_t begun = port_clock();
    (void)app_record(loop->buffer);
    const uint32_t time = port_clock() - begun;
    if (time < loop->shortest_record) loop->shortest_record = time;
  }
  loop->longest_record = loop->shortest_record;
}

// Makes room for a record. Returns: whether there is.
static int make_room(loop_t *loop) {
  if (loop->first == loop->last) loop->first = loop->last = 0;
  if (LOOP_ROOM - (loop->last - loop->first) < LOOP_RECORD) return 0;
  if (LOOP_ROOM - loop->last < LOOP_RECORD) {
    unsigned to = 0;
    while (loop->first < loop->last)
      loop->buffer[to++] = loop->buffer[loop->first++];
    loop->first = 0;
    loop->last = to;
  }
  return 1;
}

// Writes a record or a heartbeat into the buffer, or drops it. A heartbeat is
// dropped only where there is no room, because it reports missing time.
static void queue_record(loop_t *loop, int heartbeat) {
  if (!make_room(loop) || !(heartbeat || is_time_for_record(loop))) {
    loop->counts->dropped++;
    return;
  }
  const uint32_t begun = port_clock();
  uint8_t *to = loop->buffer + loop->last;
  loop->counts->sent++;
  loop->last += heartbeat ? app_heartbeat(loop->counts, to) : app_record(to);
  const uint32_t time = port_clock() - begun;
  if (time > loop->longest_record) loop->longest_record = time;
}

// Writes an answer or a description. Returns: its bytes.
static unsigned write_other(loop_t *loop) {
  const uint32_t begun = port_clock();
  const unsigned bytes = app_other(loop->buffer + loop->last);
  const uint32_t time = port_clock() - begun;
  if (time > loop->longest_record) loop->longest_record = time;
  loop->last += bytes;
  return bytes;
}

// Returns: whether there were one, room and time.
static bool queue_other(loop_t *loop) {
  return make_room(loop) && is_time_for_record(loop) && write_other(loop) > 0;
}

// Until the next tick: sends bytes, receives bytes, and idles if there are
// none. However many bytes come in, sending goes on and the tick is not missed.
// Called once in every tick.
static void use_spare_time(loop_t *loop) {
  port_feed();
  // cppcheck-suppress knownConditionTrueFalse; a board may have its own
  if (!port_stack_holds()) port_fault("stack overflow", 0, 0);
  while (port_ticks() == loop->tick) {
    const int byte = port_get();
    if (byte >= 0) app_receive((uint8_t)byte, port_clock());
    if (loop->first < loop->last) {
      if (port_room() > 0) port_put(loop->buffer[loop->first++]);
    } else if (byte < 0 && !queue_other(loop)) {
      port_idle(loop->tick);
    }
  }
}

// Sends what describes the records, before the first step and for a second at
// most. The times measured here keep later descriptions from delaying a step.
static void send_descriptions(loop_t *loop) {
  bool more = true;
  loop->last_heartbeat = loop->tick;
  time_a_record(loop);
  queue_record(loop, 1);
  while ((more || loop->first != loop->last) &&
         loop->tick - loop->last_heartbeat < loop->plan->rate) {
    if (more && make_room(loop)) more = write_other(loop) > 0;
    use_spare_time(loop);
    loop->tick = port_ticks();
  }
  loop->begun = port_clock();
  queue_record(loop, 0);
}

// The clock wraps after 2^32 units; the ticks show whether it did.
static void measure(loop_t *loop, uint32_t time) {
  loop_counts_t *counts = loop->counts;
  if (port_ticks() - loop->tick > loop->tellable) time = UINT32_MAX;
  if (time < counts->shortest) counts->shortest = time;
  if (time > counts->longest) counts->longest = time;
  counts->sum += time;
}

// Counts the ticks that passed during a step; the loop goes on at the next one.
static int overran(loop_t *loop) {
  const uint32_t late = port_ticks() - loop->tick;
  if (late == 0) return 0;
  loop->counts->overruns++;
  loop->counts->skipped += late;
  loop->tick += late;
  return loop->plan->policy == LOOP_STOP;
}

static void queue_what_is_due(loop_t *loop) {
  // By the clock: a board that is late says so in time.
  if (loop->tick - loop->last_heartbeat >= loop->plan->heartbeat) {
    loop->last_heartbeat = loop->tick;
    queue_record(loop, 1);
  }
  if (--loop->until_record == 0) {
    loop->until_record = loop->plan->every;
    queue_record(loop, 0);
  }
  while (queue_other(loop)) {
  }
}

static loop_end_t run(loop_t *loop) {
  loop_counts_t *counts = loop->counts;
  send_descriptions(loop);
  loop->last_heartbeat = loop->tick;
  while (loop->plan->steps == 0 || counts->steps < loop->plan->steps) {
    use_spare_time(loop);
    const uint32_t now = port_ticks();
    counts->skipped += now - loop->tick - 1;
    loop->tick = now;
    loop->begun = port_clock();
    if (app_latch() != 0) return LOOP_ENDED;
    const loop_step_t step = app_step(&loop->until_record);
    if (step == LOOP_BROKE) return LOOP_REFUSED;
    app_output();
    if (step == LOOP_STEPPED) {
      counts->steps++;
      measure(loop, port_clock() - loop->begun);
    }
    const int stop = overran(loop);
    queue_what_is_due(loop);
    if (stop) return LOOP_OVERRAN;
  }
  return LOOP_DONE;
}

loop_end_t loop_run(const loop_plan_t *plan, loop_counts_t *counts) {
  loop_t *loop = &the_loop;
  *counts = (loop_counts_t){.shortest = UINT32_MAX};
  loop->plan = plan;
  loop->counts = counts;
  loop->until_record = plan->every;
  if (!port_tick_start(plan->rate)) return LOOP_NO_TIMER;
  loop->period = port_clock_rate() / plan->rate;
  loop->tellable = UINT32_MAX / 2 / (loop->period + 1);
  loop->tick = port_ticks();
  loop->begun = port_clock();
  const loop_end_t end = run(loop);
  // Sends the bytes that are left, for a second at most.
  const uint32_t until = port_ticks() + plan->rate;
  while (loop->first != loop->last && port_ticks() - until > UINT32_MAX / 2)
    if (port_room() > 0) port_put(loop->buffer[loop->first++]);
  return end;
}
