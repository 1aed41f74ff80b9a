// The firmware: one scene in real time, telemetry on the serial line as text or
// as frames.
//
// The loop runs at RATE, and so does the simulation: dt is 1/RATE. STEPS ends
// it after so many steps, 0 never; its exit code says how it ended.
// Locked (without UPLINK) the machine is a constant and nothing that comes in
// is looked at. With UPLINK commands take effect at the tick after they came.
#include "core.h"
#include "loop.h"
#include "port.h"

#ifndef RATE
#define RATE 1000
#endif
#ifndef STEPS
#define STEPS 0
#endif
#ifndef EVERY
#define EVERY (RATE / 50)
#endif
#ifndef OVERRUN
#define OVERRUN LOOP_SKIP
#endif
// What telemetry reads of them; text reads less.
#pragma GCC diagnostic ignored "-Wunused-macros"

static loop_counts_t counts;
static uint32_t refused; // steps; the state stood still

#ifdef UPLINK

static tf_session_t session;
static tf_link_t uplink;
#define STATE session.state
#define REPORT session.report
#define PARAMS uplink.params
#define TAKES_COMMANDS true

static bool begin(void) {
  const tf_params_t params = scene_params(SCENE);
  tf_link_open(&uplink, SCENE, &params);
  return tf_session_open(&session, SCENE, &params, 1) == TF_OK;
}

void app_receive(uint8_t byte) { tf_link_receive(&uplink, byte); }

int app_latch(void) {
  (void)tf_link_boundary(&uplink, &session);
  return 0;
}

// Whatever commands do to the tick: records are of steps that are multiples of
// EVERY, so that who drives the machine sees it at ticks known beforehand.
loop_step_t app_step(void) {
  static uint64_t expected = UINT64_MAX;
  if (!session.running) {
    expected = UINT64_MAX;
    return LOOP_STOOD;
  }
  if (session.state.tick != expected)
    loop_record_in(EVERY - (uint32_t)session.state.tick % EVERY);
  const tf_input_t input = tf_session_input(&session, SCENE);
  const bool stood = scheme_step(&session.machine, &session.state, &input,
                                 &session.report) < 0;
  refused += stood;
  expected = session.state.tick;
  return stood ? LOOP_STOOD : LOOP_STEPPED;
}

#else

static struct {
  tf_state_t state;
  tf_report_t report;
  tf_input_t input;
  uint32_t steps;
} sim;
#define STATE sim.state
#define REPORT sim.report
#define PARAMS SCENE->params
#define TAKES_COMMANDS false

static bool begin(void) {
  return scene_begin(&sim.state, &sim.report);
}

void app_receive(uint8_t byte) { (void)byte; }

int app_latch(void) {
  sim.input = scene_input(sim.steps + 1);
  return 0;
}

loop_step_t app_step(void) {
  sim.steps++;
  refused +=
      scheme_step(SCENE_MACHINE, &sim.state, &sim.input, &sim.report) < 0;
  return refused != 0 ? LOOP_BROKE : LOOP_STEPPED;
}

#endif
#define REFUSED refused

#ifdef FRAMES
#include "tell_frames.h"
#else
#include "tell_text.h"
#endif

void app_output(void) {}

unsigned app_record(uint8_t to[]) { return tell_record(to); }

unsigned app_heartbeat(const loop_counts_t *c, uint8_t to[]) {
  return tell_heartbeat(c, to);
}

unsigned app_other(uint8_t to[]) { return tell_other(to); }

int main(void) {
  static const loop_plan_t plan = {RATE, STEPS, EVERY, RATE, OVERRUN};
  port_init();
  if (!begin() || !scheme_begin()) port_halt(LOOP_REFUSED);
  const loop_end_t end = loop_run(&plan, &counts);
  port_halt((int)end);
}
