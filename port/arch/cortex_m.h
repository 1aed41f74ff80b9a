/// @file
/// What Arm Cortex-M processors share: startup, faults, semihosting, SysTick.
#ifndef TWOFOLD_PORT_CORTEX_M_H
#define TWOFOLD_PORT_CORTEX_M_H

#include <stdbool.h>
#include <stdint.h>

#include "register.h"

/// How many interrupts of the board the vector table has room for.
#define CORTEX_M_INTERRUPTS 48

/// Handlers that a board may define; one that it does not define halts.
void cortex_m_systick(void);
void cortex_m_interrupt(void); ///< any of the board's

/// Enables an interrupt of the board.
static inline void cortex_m_enable(unsigned number) {
  REGISTER(0xE000E100u + 4u * (number / 32u)) = 1u << (number % 32u);
}

/// As port_idle, for a tick that an interrupt counts in *ticks.
static inline void cortex_m_idle(const volatile uint32_t *ticks,
                                 uint32_t seen) {
  // A masked interrupt still ends wfi, so none is lost between check and wait.
  __asm__ volatile("cpsid i" ::: "memory");
  if (*ticks == seen) __asm__ volatile("wfi" ::: "memory");
  __asm__ volatile("cpsie i" ::: "memory");
}

/// SysTick as tick and clock: cortex_m_tick.c, which defines port_ticks,
/// port_clock and port_idle. Returns: whether it can do so many cycles a tick.
bool cortex_m_tick_start(uint32_t cycles);

/// Passes the exit code to a debugger or an emulator, then stops for good.
__attribute__((noreturn)) void cortex_m_halt(int code);

#endif
