/// @file
/// What RISC-V boards of 32 bits share: startup, machine timer, external
/// interrupts, semihosting.
#ifndef TWOFOLD_PORT_RISCV_H
#define TWOFOLD_PORT_RISCV_H

#include <stdint.h>

#include "register.h"

/// The board's handler of external interrupt `source`.
void riscv_interrupt(uint32_t source);

/// Lets an external interrupt through; of one hart, machine mode.
void riscv_enable(uint32_t source);

/// The machine timer as tick, its counter as clock. period: in its units.
void riscv_tick_start(uint32_t period);
uint32_t riscv_ticks(void);
uint32_t riscv_clock(void);
void riscv_idle(uint32_t seen);

/// Tells a debugger or an emulator the exit code, then stops for good.
__attribute__((noreturn)) void riscv_halt(int code);

#endif
