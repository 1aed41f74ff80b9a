// An application of the firmware's loop (port/app.h) without a step, records or
// commands: with the host's board, what of the firmware's lateness is the
// machine's. RATE and STEPS are given by the makefile.
#include "app.h"

const loop_plan_t app_plan = {
    .rate = RATE, .steps = STEPS, .every = RATE, .heartbeat = RATE};

bool app_begin(void) { return true; }

void app_receive(uint8_t byte, uint32_t when) {
  (void)byte;
  (void)when;
}

int app_latch(void) { return 0; }

loop_step_t app_step(uint32_t *until_record) {
  (void)until_record;
  return LOOP_STEPPED;
}

void app_output(void) {}

unsigned app_record(uint8_t to[]) {
  (void)to;
  return 0;
}

unsigned app_other(uint8_t to[]) {
  (void)to;
  return 0;
}

unsigned app_heartbeat(const loop_counts_t *counts, uint8_t to[]) {
  (void)counts;
  (void)to;
  return 0;
}
