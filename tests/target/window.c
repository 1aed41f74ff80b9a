// On the target: steps between two markers, for the instruction counter of the
// emulator (tools/bench/count.c). The first window is empty and measures
// the markers. Prints "end R V W", the bits of the state, and ends with 0.
#include <string.h>

#include "../../port/core.h"
#include "say.h"

void window_open(void);
void window_close(void);

// The markers do nothing.
__attribute__((noinline)) void window_open(void) { __asm__ volatile(""); }
__attribute__((noinline)) void window_close(void) { __asm__ volatile(""); }

static tf_state_t x;
static tf_report_t report;

static void say_end(void) {
  static uint8_t line[64];
  const tf_real_t members[3] = {x.r, x.v, x.w};
  text_t text = {line};
  text_string(&text, "end");
  for (int i = 0; i < 3; i++) {
    uint64_t bits = 0;
    memcpy(&bits, &members[i], sizeof members[i]);
    text_byte(&text, ' ');
    text_hex(&text, bits);
  }
  say(line, &text);
}

int main(void) {
  port_init();
  if (!scene_begin(&x, &report) || !scheme_begin()) port_halt(1);
  window_open();
  window_close();
  for (uint32_t i = 1; i <= STEPS; i++) {
    window_open();
    const tf_input_t input = scene_input(i);
    const tf_status_t status = scheme_step(SCENE_MACHINE, &x, &input, &report);
    window_close();
    if (status < 0) port_halt(1);
  }
  say_end();
  port_halt(0);
}
