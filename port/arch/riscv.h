/// @file
/// What 32-bit RISC-V boards share: startup, machine timer, external
/// interrupts, semihosting.
#ifndef TWOFOLD_PORT_RISCV_H
#define TWOFOLD_PORT_RISCV_H

#include <stdint.h>

#include "register.h"

/// The board's handler of external interrupt `source`.
void riscv_interrupt(uint32_t source);

/// Enables an external interrupt, of the one hart, in machine mode.
void riscv_enable(uint32_t source);

/// The machine timer as tick, its counter as clock: riscv.c defines port_ticks,
/// port_clock and port_idle. period: in its units.
void riscv_tick_start(uint32_t period);

/// Passes the exit code to a debugger or an emulator, then stops for good.
__attribute__((noreturn)) void riscv_halt(int code);

#endif
