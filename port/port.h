/// @file
/// What a board must be able to do: the whole contract between this project
/// and a target. A board is one folder under port/ that defines the functions
/// below, brings its startup code and linker script (port/arch has those of
/// whole families) and says in board.mk how it is compiled and run. They are
/// called by name: no table of pointers, and no board is named elsewhere.
///
/// All of them are called from the main program, never from an interrupt.
/// Nothing here waits, but port_idle, which says until when.
#ifndef TWOFOLD_PORT_H
#define TWOFOLD_PORT_H

#include <stdbool.h>
#include <stdint.h>

/// Clocks, pins and the serial line, ready for use. Every wait for hardware is
/// bounded: a clock that does not start leaves the board at a slower one.
/// Called once, first.
void port_init(void);

/// Starts the periodic tick, and the clock with it.
/// rate: in [Hz], > 0.
/// Returns: whether the timer can do that rate to better than 1 %; else
///   nothing was started.
bool port_tick_start(uint32_t rate);

/// Ticks since port_tick_start, counted by the board also while nobody looks.
/// Wraps at 2^32.
uint32_t port_ticks(void);

/// A clock that never goes back, running since port_tick_start; wraps at 2^32.
/// Differences of two readings that lie less than half a wrap apart count.
uint32_t port_clock(void);

/// Units of port_clock in one second: its resolution.
uint32_t port_clock_rate(void);

/// How many bytes port_put takes at once. 0 where the line is busy.
unsigned port_room(void);

/// Hands one byte to the serial line. Only where port_room() > 0.
void port_put(uint8_t byte);

/// The next byte that came in, or -1. The board keeps at least 32 of them; it
/// drops what comes beyond.
int port_get(void);

/// Rests until the next interrupt at the latest, but not at all where
/// port_ticks() is no longer `seen`: a tick between the caller's look and the
/// rest is not slept over. May return early.
void port_idle(uint32_t seen);

/// Ends the program with an exit code, where a board has somebody to tell;
/// else stops for good. The bytes handed over so far still leave.
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void port_halt(int code);

#endif
