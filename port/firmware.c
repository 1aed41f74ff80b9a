// The firmware: one scene in real time, telemetry on the serial line as text,
// as CSV or as frames.
//
// The loop runs at RATE, and so does the simulation: dt is 1/RATE. STEPS ends
// it after so many steps, 0 never; its exit code says how it ended.
#include "app.h"
#include "sim.h"

#ifndef STEPS
#define STEPS 0
#endif
#ifndef OVERRUN
#define OVERRUN LOOP_SKIP
#endif

#ifdef FRAMES
#include "telemetry_frames.h"
#elif defined(CSV)
#include "telemetry_csv.h"
#else
#include "telemetry_plotter.h"
#endif

const loop_plan_t app_plan = {RATE, STEPS, EVERY, RATE, OVERRUN};

bool app_begin(void) {
  const bool begun = sim_begin() && scheme_begin();
#ifdef FRAMES
  telemetry_begin();
#endif
  return begun;
}

void app_receive(uint8_t byte, uint32_t when) { sim_receive(byte, when); }

int app_latch(void) {
  sim_latch();
  return 0;
}

loop_step_t app_step(uint32_t *until_record) { return sim_step(until_record); }

void app_output(void) {}

unsigned app_record(uint8_t to[]) { return telemetry_record(to); }

unsigned app_heartbeat(const loop_counts_t *counts, uint8_t to[]) {
  return telemetry_heartbeat(counts, to);
}

unsigned app_other(uint8_t to[]) { return telemetry_other(to); }
