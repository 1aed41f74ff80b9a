// A board to copy: port/port.h says what each function must do. Delete the
// #error above a function when it is written.
#include "../port.h"

#error "clocks (waits bounded), pins, serial line, its receive interrupt"
void port_init(void);

#error "a periodic interrupt that counts ticks; false where it cannot"
bool port_tick_start(uint32_t rate);

#error "the count of that interrupt"
uint32_t port_ticks(void);

#error "a free-running counter, or ticks and what the timer says between"
uint32_t port_clock(void);

#error "its units in one second"
uint32_t port_clock_rate(void);

#error "bytes that the serial line can take now"
unsigned port_room(void);

#error "one byte to the serial line"
void port_put(uint8_t byte);

#error "one byte from the ring that the interrupt fills (ring.h), or -1"
int port_get(void);

#error "wait for an interrupt, unless port_ticks() is no longer seen"
void port_idle(uint32_t seen);

#error "tell the code to a debugger, if there is one, and stop"
void port_halt(int code);
