// On the target, at a rate that is too high for it: inputs from outside hold
// for so many ticks of the clock, of which few get a step. Prints
// "deadman TICKS held LAST safe FIRST steps STEPS": since the inputs were set,
// the tick of the last step that had them, and of the first that had not.
#include "../../port/loop.h"

#define app_latch firmware_latch
#define app_step firmware_step
#include "../../port/firmware.c" // NOLINT(bugprone-suspicious-include)
#undef app_latch
#undef app_step
#include "say.h"

static uint32_t set_at, held, safe, steps;
static bool is_set;

int app_latch(void) {
  (void)firmware_latch();
  if (safe > 0) return 1;
  if (!is_set) {
    const tf_input_t push = tf_input_default(&sim.simulation.machine);
    tf_simulation_set_input(&sim.simulation, &push);
    set_at = sim.ticks;
    is_set = true;
  }
  return 0;
}

loop_step_t app_step(uint32_t *until_record) {
  const loop_step_t done = firmware_step(until_record);
  if (sim.simulation.stepped == TF_INPUT_SAFE) {
    safe = sim.ticks - set_at;
  } else {
    held = sim.ticks - set_at;
    steps++;
  }
  return done;
}

int main(void) {
  static loop_counts_t counts;
  static uint8_t line[64];
  text_t text = {line};
  port_init();
  if (!app_begin()) port_halt(LOOP_REFUSED);
  const loop_end_t end = loop_run(&app_plan, &counts);
  text_pair(&text, "\r\ndeadman ", sim.simulation.deadman);
  text_pair(&text, " held ", held);
  text_pair(&text, " safe ", safe);
  text_pair(&text, " steps ", steps);
  say(line, &text);
  port_halt(end == LOOP_ENDED ? 0 : 1);
}
