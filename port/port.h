/// @file
/// What a board must be able to do: the whole contract between this project
/// and a target. A board is one folder under port/ that defines the functions
/// below, brings its startup code and linker script (port/arch has those of
/// whole families), and says in board.mk how it is compiled and run. The
/// functions are called by name, without a table of pointers; no other file
/// names a board.
///
/// All of them are called from the main program, never from an interrupt, but
/// for port_safe, port_room, port_put and port_halt, which port_fault calls
/// from anywhere. None waits except port_idle, which says until when, and
/// port_boot.
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

/// Ticks since port_tick_start, modulo 2^32. The board counts them whether or
/// not this is called, and by time: steps that are late, sleep and other
/// programs do not stop the count, by which inputs from outside expire.
uint32_t port_ticks(void);

/// A clock that never goes back, running since port_tick_start, modulo 2^32.
/// Only differences of readings less than 2^31 apart are used.
uint32_t port_clock(void);

/// Units of port_clock in one second.
uint32_t port_clock_rate(void);

/// How many bytes port_put can take now; 0 while the line is busy.
unsigned port_room(void);

/// Hands one byte to the serial line. Called only if port_room() > 0.
void port_put(uint8_t byte);

/// The next byte received, or -1. The board keeps at least 32 of them and drops
/// those that come when its buffer is full.
int port_get(void);

/// How many bytes were lost before port_get, modulo 2^32: its buffer was full,
/// they came broken, or an interrupt was late. Boards with a ring have the one
/// of ring.h; port/hooks.c has one that returns 0.
uint32_t port_unread(void);

/// Waits for the next interrupt at most, and not at all if port_ticks() is no
/// longer `seen`: a tick between the caller's check and the wait is not missed.
/// May return early.
void port_idle(uint32_t seen);

/// Ends the program with an exit code, if there is something that takes it;
/// else stops for good. Bytes handed over before are still sent.
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void port_halt(int code);

/// Optional, with BOARD_BOOT in board.mk: a number that this board has never
/// given before, in this start or an earlier one, from which a firmware with a
/// key makes its session. So it is in what survives a start, or random in all
/// of its 32 bits; a count is kept before it is given. Called once, after
/// port_init. May wait for hardware, for a bounded time.
/// Returns: the number; 0 where none can be had: then the program does not
///   start.
uint32_t port_boot(void);

/// Optional, as the two below; port/hooks.c has one that does nothing. Keeps a
/// watchdog from restarting the board, which port_tick_start starts. Called
/// once in every tick behind step and outputs, and nowhere else, so that what
/// hangs is ended. With BOARD_WATCHDOG in board.mk WATCHDOG is its time [ms],
/// if there is to be one.
void port_feed(void);

/// Puts what the board drives into the state that is safe. Called by
/// port_fault, so it relies on no variable and on nothing that may be broken.
void port_safe(void);

/// Whether the stack has kept to its room. Called once in every tick. The
/// families of port/arch look at a word at its end, or have hardware that
/// faults there and always return true, as port/hooks.c does.
bool port_stack_holds(void);

/// Ends a program in which something is broken, with exit code PORT_FAULT:
/// port_safe, then "fault: WHY at AT cause CAUSE" over the line, for as long as
/// that takes bytes. For handlers of faults, and for the loop. Written in
/// port/hooks.c.
/// at: where; cause: what the processor says of it; 0 where nothing is known.
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void port_fault(const char *why, uint32_t at, uint32_t cause);
#define PORT_FAULT 99

#endif
