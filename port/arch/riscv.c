// Startup, traps and timer of a 32-bit RISC-V with CLINT and PLIC at their
// usual addresses; see riscv.h.
#include "riscv.h"

#include "../port.h"
#include "sections.h"

#define MTIMECMP_LOW REGISTER(0x02004000u)
#define MTIMECMP_HIGH REGISTER(0x02004004u)
#define MTIME_LOW REGISTER(0x0200BFF8u)
#define MTIME_HIGH REGISTER(0x0200BFFCu)
#define PLIC_PRIORITY(source) REGISTER(0x0C000000u + 4u * (source))
#define PLIC_ENABLE(source) REGISTER(0x0C002000u + 4u * ((source) / 32u))
#define PLIC_THRESHOLD REGISTER(0x0C200000u)
#define PLIC_CLAIM REGISTER(0x0C200004u)

#define CAUSE_TIMER 0x80000007u
#define CAUSE_EXTERNAL 0x8000000Bu

int main(void);
void riscv_start(void);
void riscv_main(void);
void riscv_trap(void);

static volatile uint32_t ticks;
static uint64_t next;
static uint32_t tick_period;

__attribute__((naked, section(".startup"))) void riscv_start(void) {
  __asm__ volatile(
      ".option push\n\t.option norelax\n\t"
      "la sp, stack_top\n\t"
      ".option pop\n\t"
      "la t0, riscv_trap\n\t"
      "csrw mtvec, t0\n\t"
      "li t0, 0x2000\n\t" // mstatus.FS: the FPU, if there is one
      "csrs mstatus, t0\n\t"
      "j riscv_main");
}

void riscv_main(void) {
  sections_fill();
  __asm__ volatile("csrs mstatus, 8" ::: "memory"); // interrupts
  riscv_halt(main());
}

__attribute__((weak)) void riscv_interrupt(uint32_t source) { (void)source; }

static void timer_at(uint64_t time) {
  MTIMECMP_HIGH = UINT32_MAX; // never too early in between
  MTIMECMP_LOW = (uint32_t)time;
  MTIMECMP_HIGH = (uint32_t)(time >> 32);
}

__attribute__((interrupt("machine"), aligned(4))) void riscv_trap(void) {
  uint32_t cause;
  __asm__ volatile("csrr %0, mcause" : "=r"(cause));
  if (cause == CAUSE_TIMER) {
    ticks++;
    next += tick_period;
    timer_at(next);
  } else if (cause == CAUSE_EXTERNAL) {
    const uint32_t source = PLIC_CLAIM;
    riscv_interrupt(source);
    PLIC_CLAIM = source;
  } else {
    uint32_t at;
    __asm__ volatile("csrr %0, mepc" : "=r"(at));
    port_fault("trap", at, cause);
  }
}

void riscv_enable(uint32_t source) {
  PLIC_PRIORITY(source) = 1;
  PLIC_ENABLE(source) |= 1u << (source % 32u);
  PLIC_THRESHOLD = 0;
  __asm__ volatile("csrs mie, %0" ::"r"(1u << 11));
}

void riscv_tick_start(uint32_t period) {
  uint32_t high, low;
  do {
    high = MTIME_HIGH;
    low = MTIME_LOW;
  } while (high != MTIME_HIGH);
  ticks = 0;
  tick_period = period;
  next = ((uint64_t)high << 32 | low) + period;
  timer_at(next);
  __asm__ volatile("csrs mie, %0" ::"r"(1u << 7));
}

bool port_stack_holds(void) { return stack_holds(); }

uint32_t port_ticks(void) { return ticks; }

uint32_t port_clock(void) { return MTIME_LOW; }

void port_idle(uint32_t seen) {
  // A masked interrupt still ends wfi, so none is lost between check and wait.
  __asm__ volatile("csrc mstatus, 8" ::: "memory");
  if (ticks == seen) __asm__ volatile("wfi" ::: "memory");
  __asm__ volatile("csrs mstatus, 8" ::: "memory");
}
