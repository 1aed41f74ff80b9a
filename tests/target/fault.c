// On the target: a step in which something breaks, by FAULT: the program ends
// with PORT_FAULT, its outputs are safe, and it says why.
#include "../../port/loop.h"
#include "say.h"

#define AT_STEP 3u

const loop_plan_t app_plan = {RATE, 2 * AT_STEP, RATE, RATE, LOOP_SKIP};

void port_safe(void) {
  static uint8_t line[16];
  text_t text = {line};
  text_string(&text, "safe");
  say(line, &text);
}

#ifdef __AVR__
extern uint8_t __heap_start;
#define STACK_END ((uintptr_t)&__heap_start)
#else
extern uint8_t bss_end[];
#define STACK_END ((uintptr_t)bss_end)
#endif

static volatile unsigned sunk;
static unsigned sink(unsigned depth);
static unsigned (*volatile const deeper)(unsigned depth) = sink;

// Calls itself almost down to the end of the stack, where hardware may stop it.
static unsigned sink(unsigned depth) {
  volatile uint8_t room[16] = {(uint8_t)depth};
  if ((uintptr_t)room > STACK_END + 256) depth = deeper(depth + 1);
  return depth + room[0];
}

__attribute__((unused)) static void fault_stack(void) {
  sunk = sink(0);
  // As one call more would leave it.
  *(volatile uint8_t *)STACK_END = 0; // NOLINT(performance-no-int-to-ptr)
}

__attribute__((unused)) static void fault_bus(void) {
  static volatile uintptr_t nowhere = (uintptr_t)0xDFFFFFF0u;
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  sunk = *(const volatile uint8_t *)nowhere;
}

__attribute__((unused)) static void fault_hang(void) {
  for (;;) sunk++;
}

bool app_begin(void) { return true; }
int app_latch(void) { return 0; }
void app_output(void) {}
void app_receive(uint8_t byte, uint32_t when) { (void)byte, (void)when; }
unsigned app_record(uint8_t to[]) { return (void)to, 0; }
unsigned app_other(uint8_t to[]) { return (void)to, 0; }
unsigned app_heartbeat(const loop_counts_t *counts, uint8_t to[]) {
  return (void)counts, (void)to, 0;
}

loop_step_t app_step(uint32_t *until_record) {
  static void (*volatile const fault)(void) = FAULT;
  static unsigned step;
  (void)until_record;
  if (step++ == AT_STEP) fault();
  return LOOP_STEPPED;
}

int main(void) {
  static loop_counts_t counts;
  port_init();
  port_halt((int)loop_run(&app_plan, &counts));
}
