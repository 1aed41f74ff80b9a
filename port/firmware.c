// The firmware: one scene in real time, text telemetry on the serial line.
//
// The loop runs at RATE, and so does the simulation: dt is 1/RATE. STEPS ends
// it after so many steps, 0 never; its exit code says how it ended.
#include "core.h"
#include "loop.h"
#include "port.h"
#include "text.h"

#ifndef RATE
#define RATE 1000
#endif
#ifndef STEPS
#define STEPS 0
#endif
#ifndef EVERY
#define EVERY (RATE / 50)
#endif

static struct {
  tf_state_t state;
  tf_report_t report;
  tf_input_t input;
  uint32_t steps;
} sim;

static loop_counts_t counts;

void app_receive(uint8_t byte) { (void)byte; }

int app_latch(void) {
  sim.input = scene_input(sim.steps + 1);
  return 0;
}

int app_step(void) {
  sim.steps++;
  return tf_step(SCENE_MACHINE, &sim.state, &sim.input, &sim.report) < 0;
}

void app_output(void) {}

static void number(text_t *text, const char *name, tf_real_t value) {
  text_string(text, name);
  text_real(text, value);
}

static void count(text_t *text, const char *name, uint32_t value) {
  text_string(text, name);
  text_whole(text, value, 1);
}

unsigned app_record(uint8_t to[]) {
  text_t text = {to};
  number(&text, "r:", sim.state.r);
  number(&text, " v:", sim.state.v);
  number(&text, " omega:", sim.state.w);
  number(&text, " h:", sim.report.slip.h);
  count(&text, " mode:", sim.report.mode);
  count(&text, " choices:", sim.report.choices);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

unsigned app_heartbeat(const loop_counts_t *c, uint8_t to[]) {
  text_t text = {to};
  count(&text, "steps:", c->steps);
  count(&text, " overruns:", c->overruns);
  count(&text, " skipped:", c->skipped);
  count(&text, " sent:", c->sent);
  count(&text, " dropped:", c->dropped);
  count(&text, " min:", c->steps ? c->shortest : 0);
  count(&text, " mean:", c->steps ? (uint32_t)(c->sum / c->steps) : 0);
  count(&text, " max:", c->longest);
  text_string(&text, "\r\n");
  return (unsigned)(text.end - to);
}

int main(void) {
  static const loop_plan_t plan = {RATE, STEPS, EVERY, RATE, LOOP_SKIP};
  port_init();
  scene_begin(&sim.state, &sim.report);
  const loop_end_t end = loop_run(&plan, &counts);
  port_halt((int)end);
}
