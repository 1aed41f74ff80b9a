// The host port with one mistake, chosen by FAULT, for tests/target/faults.py:
// each is one that a port is likely to have.
#define port_init sound_init
#define port_clock sound_clock
#define port_clock_rate sound_clock_rate
#define port_room sound_room
#define port_put sound_put
#define port_get sound_get
#define port_idle sound_idle
#define port_halt sound_halt
#include "../host/board.c" // NOLINT(bugprone-suspicious-include)
#undef port_init
#undef port_clock
#undef port_clock_rate
#undef port_room
#undef port_put
#undef port_get
#undef port_idle
#undef port_halt

#include <fenv.h>

#define IS(fault) (FAULT == fault)
#define MISSING_FUNCTION 1
#define WRONG_RATE 2
#define LOSES_SENT 3
#define LOSES_RECEIVED 4
#define WRONG_BITS 5
#define MISSES_TICK 6
#define CLOCK_BACK 7
#define LOSES_CODE 8

// Rounds towards 0.
void port_init(void) {
  sound_init();
  if (IS(WRONG_BITS)) (void)fesetround(FE_TOWARDZERO);
}

// A counter that starts again every quarter of a millisecond.
uint32_t port_clock(void) {
  return IS(CLOCK_BACK) ? sound_clock() % 250000u : sound_clock();
}

// Microseconds where the clock counts nanoseconds.
uint32_t port_clock_rate(void) {
  return IS(WRONG_RATE) ? 1000000u : NANOSECONDS;
}

#if FAULT != MISSING_FUNCTION
unsigned port_room(void) { return sound_room(); }
#endif

// A line that is busy now and then, and takes no byte meanwhile.
void port_put(uint8_t byte) {
  static unsigned count;
  if (IS(LOSES_SENT) && ++count % 256u == 0) return;
  sound_put(byte);
}

// One byte is kept, the last one, as in a register without an interrupt.
int port_get(void) {
  int byte = sound_get();
  if (IS(LOSES_RECEIVED))
    for (int next = byte; next >= 0; next = sound_get()) byte = next;
  return byte;
}

// Waits for an interrupt without a look at the tick.
void port_idle(uint32_t seen) {
  sound_idle(IS(MISSES_TICK) ? port_ticks() : seen);
}

void port_halt(int code) { sound_halt(IS(LOSES_CODE) ? 0 : code); }
