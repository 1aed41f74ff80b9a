// On a board: the calls that `cost constants` wrote, each between two markers
// for the counter of the emulator (tools/bench/count.c). The first window is
// empty. Ends with 0 where each call does what it did on x86-64, bit for bit.
#include "../../../port/core.h"
#include "../../../port/port.h"

void window_open(void);
void window_close(void);

// The markers do nothing.
__attribute__((noinline)) void window_open(void) { __asm__ volatile(""); }
__attribute__((noinline)) void window_close(void) { __asm__ volatile(""); }

typedef struct {
  tf_status_t (*step)(const tf_machine_t *, tf_state_t *, const tf_input_t *,
                      tf_report_t *);
  tf_machine_t machine;
  tf_input_t input;
  tf_state_t state, end;
} constants_t;

static const constants_t calls[] = {
#include "calls.inc"
};

int main(void) {
  static tf_report_t report;
  port_init();
  window_open();
  window_close();
  for (size_t i = 0; i < sizeof calls / sizeof calls[0]; i++) {
    const constants_t *c = &calls[i];
    tf_state_t x = c->state;
    window_open();
    (void)c->step(&c->machine, &x, &c->input, &report);
    window_close();
    if (x.r != c->end.r || x.v != c->end.v || x.w != c->end.w ||
        x.mode != c->end.mode)
      port_halt(1);
  }
  port_halt(0);
}
