// Startup of a Cortex-M: vector table, memory, FPU; see cortex_m.h.
#include "cortex_m.h"

#include "sections.h"

int main(void);
void cortex_m_reset(void);

__attribute__((noreturn)) void cortex_m_halt(int code) {
  // SYS_EXIT_EXTENDED with ADP_Stopped_ApplicationExit. Without a debugger the
  // breakpoint is a fault, whose handler ends here, in lockup.
  const uint32_t block[2] = {0x20026u, (uint32_t)code};
  register uint32_t operation __asm__("r0") = 0x20u;
  register const uint32_t *argument __asm__("r1") = block;
  __asm__ volatile("bkpt 0xAB" : "+r"(operation) : "r"(argument) : "memory");
  for (;;) {
  }
}

static void fault(void) { cortex_m_halt(99); }

__attribute__((weak)) void cortex_m_systick(void) { fault(); }
__attribute__((weak)) void cortex_m_interrupt(void) { fault(); }

typedef struct {
  uint32_t *stack;
  void (*handler[15])(void);
  void (*interrupt[CORTEX_M_INTERRUPTS])(void);
} vectors_t;

// A range of designators is an extension of gcc and clang.
#pragma GCC diagnostic ignored "-Wpedantic"
extern const vectors_t vectors;
__attribute__((section(".vectors"), used)) const vectors_t vectors = {
    .stack = stack_top,
    .handler =
        {[0] = cortex_m_reset, [1 ... 13] = fault, [14] = cortex_m_systick},
    .interrupt = {[0 ... CORTEX_M_INTERRUPTS - 1] = cortex_m_interrupt}};

__attribute__((noreturn)) void cortex_m_reset(void) {
#ifdef __ARM_FP
  REGISTER(0xE000ED88u) |= 0xFu << 20; // CPACR
  __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
  sections_fill();
  cortex_m_halt(main());
}
