// The fixed-rate loop: see loop.h.
#include "loop.h"

#include "app.h"
#include "port.h"

typedef struct {
  const loop_plan_t *plan;
  loop_counts_t *counts;
  uint32_t tick;   // whose step is due or done
  uint32_t begun;  // clock at its begin
  uint32_t period; // [clock]
  // To write what is told, and a record alone [clock].
  uint32_t longest_record, shortest_record;
  uint32_t until_record, until_heartbeat;
  unsigned first, last; // bytes that wait are buffer[first .. last - 1]
  uint8_t buffer[LOOP_ROOM];
} loop_t;

static loop_t the_loop;

// Until the next tick: bytes out, bytes in, and rest where there are none. A
// flood of bytes in neither stops those out nor outlasts the tick.
static void use_spare_time(loop_t *loop) {
  while (port_ticks() == loop->tick) {
    const int byte = port_get();
    if (byte >= 0) app_receive((uint8_t)byte);
    if (loop->first < loop->last) {
      if (port_room() > 0) port_put(loop->buffer[loop->first++]);
    } else if (byte < 0) {
      port_idle(loop->tick);
    }
  }
}

// Records take a while that hardly changes and descriptions a few times as
// long. What is beyond that was somebody else's time (an emulator, a machine
// with other work), of which one moment must not end all telemetry.
#define OUTLIER 8u

// Whether a record would be done before the next tick.
static int in_time(const loop_t *loop) {
  const uint32_t spent = port_clock() - loop->begun;
  uint32_t takes = loop->longest_record;
  if (takes / OUTLIER > loop->shortest_record)
    takes = loop->shortest_record * OUTLIER;
  return spent < loop->period && loop->period - spent > takes;
}

// Before anything is told, records that nobody gets: how long they take.
static void rehearse(loop_t *loop) {
  loop->shortest_record = UINT32_MAX;
  for (int i = 0; i < 3; i++) {
    const uint32_t begun = port_clock();
    (void)app_record(loop->buffer);
    const uint32_t time = port_clock() - begun;
    if (time < loop->shortest_record) loop->shortest_record = time;
  }
  loop->longest_record = loop->shortest_record;
}

// Makes room for a record, if there is.
static int fits(loop_t *loop) {
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

// A heartbeat is dropped for want of room alone: it tells of want of time.
static void tell(loop_t *loop, int heartbeat) {
  if (!fits(loop) || !(heartbeat || in_time(loop))) {
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

static unsigned tell_other(loop_t *loop) {
  const uint32_t begun = port_clock();
  const unsigned bytes = app_other(loop->buffer + loop->last);
  const uint32_t time = port_clock() - begun;
  if (time > loop->longest_record) loop->longest_record = time;
  loop->last += bytes;
  return bytes;
}

// Before the first step, for a second at most: what describes the records. The
// measured times then keep later ones from costing a step.
static void introduce(loop_t *loop) {
  bool more = true;
  rehearse(loop);
  tell(loop, 1);
  while ((more || loop->first != loop->last) && loop->tick < loop->plan->rate) {
    if (more && fits(loop)) more = tell_other(loop) > 0;
    use_spare_time(loop);
    loop->tick = port_ticks();
  }
  loop->begun = port_clock();
  tell(loop, 0);
}

static void measure(loop_counts_t *counts, uint32_t time) {
  if (time < counts->shortest) counts->shortest = time;
  if (time > counts->longest) counts->longest = time;
  counts->sum += time;
}

// Counts the ticks that went by without a step; the next is waited for.
static int overran(loop_t *loop) {
  const uint32_t late = port_ticks() - loop->tick;
  if (late == 0) return 0;
  loop->counts->overruns++;
  loop->counts->skipped += late;
  loop->tick += late;
  return loop->plan->policy == LOOP_STOP;
}

static void tell_what_is_due(loop_t *loop) {
  if (--loop->until_heartbeat == 0) {
    loop->until_heartbeat = loop->plan->heartbeat;
    tell(loop, 1);
  }
  if (--loop->until_record == 0) {
    loop->until_record = loop->plan->every;
    tell(loop, 0);
  }
  if (fits(loop) && in_time(loop)) (void)tell_other(loop);
}

static loop_end_t run(loop_t *loop) {
  loop_counts_t *counts = loop->counts;
  introduce(loop);
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
      measure(counts, port_clock() - loop->begun);
    }
    const int stop = overran(loop);
    tell_what_is_due(loop);
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
  loop->until_heartbeat = plan->heartbeat;
  if (!port_tick_start(plan->rate)) return LOOP_NO_TIMER;
  loop->period = port_clock_rate() / plan->rate;
  loop->tick = port_ticks();
  loop->begun = port_clock();
  const loop_end_t end = run(loop);
  // What waits leaves, bounded in time: a second of ticks.
  const uint32_t until = port_ticks() + plan->rate;
  while (loop->first != loop->last && port_ticks() - until > UINT32_MAX / 2)
    if (port_room() > 0) port_put(loop->buffer[loop->first++]);
  return end;
}
