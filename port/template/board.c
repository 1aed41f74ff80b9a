// A board to copy: port/port.h says what each function must do. Delete a line
// of #error when what stands below it is done.
#include "../port.h"

void port_init(void) {
#error "clocks (waits bounded), pins, serial line, its receive interrupt"
}

bool port_tick_start(uint32_t rate){
#error "a periodic interrupt that counts ticks; false where it cannot"
}

uint32_t port_ticks(void){
#error "the count of that interrupt"
}

uint32_t port_clock(void){
#error "a free-running counter, or ticks and what the timer says between"
}

uint32_t port_clock_rate(void) {
#error "its units in one second"
}

unsigned port_room(void) {
#error "bytes that the serial line takes at once"
}

void port_put(uint8_t byte) {
#error "one byte to the serial line"
}

int port_get(void) {
#error "one byte from the ring that the interrupt fills (ring.h), or -1"
}

void port_idle(uint32_t seen) {
#error "wait for an interrupt, unless port_ticks() is no longer seen"
}

void port_halt(int code) {
#error "tell the code to a debugger, if there is one, and stop"
}
