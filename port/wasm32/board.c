// WebAssembly: the module imports its line, its clock and its exit from the
// program that runs it (run.mjs in node), and exports main.
#include "../port.h"

#define IMPORT(symbol) \
  __attribute__((import_module("port"), import_name(symbol)))
IMPORT("put") void host_put(int byte);
IMPORT("get") int host_get(void);
IMPORT("now") double host_now(void); // [ms], never goes back
IMPORT("halt") __attribute__((noreturn)) void host_halt(int code);

static double start, period; // [ms]

void port_init(void) {}

bool port_tick_start(uint32_t rate) {
  start = host_now();
  period = 1000.0 / rate;
  return true;
}

// By way of 64 bits: a double beyond the range of its target is an error.
uint32_t port_ticks(void) {
  return (uint32_t)(uint64_t)((host_now() - start) / period);
}

uint32_t port_clock(void) {
  return (uint32_t)(uint64_t)((host_now() - start) * 1000.0);
}

uint32_t port_clock_rate(void) { return 1000000u; }

unsigned port_room(void) { return 1; }

void port_put(uint8_t byte) { host_put(byte); }

int port_get(void) { return host_get(); }

void port_idle(uint32_t seen) { (void)seen; }

void port_halt(int code) { host_halt(code); }
