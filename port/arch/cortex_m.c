// Startup of a Cortex-M: vector table, memory, FPU, stack guard; and faults.
// See cortex_m.h.
#include "cortex_m.h"

#include "../port.h"
#include "sections.h"

int main(void);
void cortex_m_reset(void);
void cortex_m_trap(void);
void cortex_m_fault(const uint32_t *frame);

#if __ARM_ARCH >= 7
#define HAS_MPU true
#else
#define HAS_MPU false // and no status of faults, no VTOR but on some M0+
#endif
#define VTOR REGISTER(0xE000ED08u)
#define SHCSR REGISTER(0xE000ED24u)
#define CFSR REGISTER(0xE000ED28u)
#define CFSR_MSTKERR (1u << 4)
#define CFSR_MMARVALID (1u << 7)
#define MMFAR REGISTER(0xE000ED34u)
#define MPU_TYPE REGISTER(0xE000ED90u)
#define MPU_CTRL REGISTER(0xE000ED94u)
#define MPU_RBAR REGISTER(0xE000ED9Cu)
#define MPU_RASR REGISTER(0xE000EDA0u)

__attribute__((noreturn)) void cortex_m_halt(int code) {
  // SYS_EXIT_EXTENDED with ADP_Stopped_ApplicationExit. Without a debugger the
  // breakpoint is a fault, whose handler stops there.
  const uint32_t block[2] = {0x20026u, (uint32_t)code};
  register uint32_t operation __asm__("r0") = 0x20u;
  register const uint32_t *argument __asm__("r1") = block;
  __asm__ volatile("bkpt 0xAB" : "+r"(operation) : "r"(argument) : "memory");
  for (;;) {
  }
}

#define BREAKPOINT 0xBEABu

// No access to the 256 bytes between variables and stack.
#define GUARD_BYTES 256u
static uint32_t guard(void) {
  return ((uint32_t)bss_end + GUARD_BYTES - 1u) & ~(GUARD_BYTES - 1u);
}

static void guard_stack(void) {
  SHCSR |= 7u << 16; // faults of memory, bus and usage have their own numbers
  if ((MPU_TYPE >> 8 & 0xFFu) == 0) return;
  MPU_RBAR = guard() | 1u << 4;       // region 0
  MPU_RASR = 1u << 28 | 7u << 1 | 1u; // no access, 2^(7 + 1) bytes, on
  MPU_CTRL = 1u << 2 | 1u;            // elsewhere as without
  __asm__ volatile("dsb\n\tisb" ::: "memory");
}

// Without MPU the loop looks at a mark.
bool port_stack_holds(void) { return HAS_MPU || stack_holds(); }

static const char *name_of(uint32_t number, uint32_t status) {
  if (status & CFSR_MSTKERR ||
      (status & CFSR_MMARVALID && MMFAR - guard() < GUARD_BYTES))
    return "stack overflow";
  switch (number) {
    case 2:
      return "watchdog, or another NMI";
    case 4:
      return "memory";
    case 5:
      return "bus";
    case 6:
      return "usage";
    default:
      return number < 16 ? "hard" : "interrupt without a handler";
  }
}

// On an empty stack: frame is where the processor has left its registers.
__attribute__((noreturn, used)) void cortex_m_fault(const uint32_t *frame) {
  uint32_t number;
  __asm__ volatile("mrs %0, ipsr" : "=r"(number));
  if (HAS_MPU) MPU_CTRL = 0;
  const bool is_there = frame >= data_begin && frame + 8 <= stack_top;
  const uint32_t at = is_there ? frame[6] : 0;
  if (number == 3 && at != 0 && *(const uint16_t *)at == BREAKPOINT)
    for (;;) continue; // the end of the program, and no debugger
  const uint32_t status = HAS_MPU ? CFSR : 0;
  port_fault(name_of(number, status), at, HAS_MPU ? status : number);
}

__attribute__((naked)) void cortex_m_trap(void) {
  __asm__ volatile(
      "mov r0, sp\n\t"
      "ldr r1, =stack_top\n\t"
      "mov sp, r1\n\t"
      "ldr r1, =cortex_m_fault\n\t"
      "bx r1\n\t"
      ".ltorg");
}

#define TRAP __attribute__((weak, alias("cortex_m_trap")))
TRAP void cortex_m_systick(void);
TRAP void cortex_m_interrupt(void);

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
    .handler = {[0] = cortex_m_reset,
                [1 ... 13] = cortex_m_trap,
                [14] = cortex_m_systick},
    .interrupt = {[0 ... CORTEX_M_INTERRUPTS - 1] = cortex_m_interrupt}};

__attribute__((noreturn)) void cortex_m_reset(void) {
#ifdef __ARM_FP
  REGISTER(0xE000ED88u) |= 0xFu << 20; // CPACR
  __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
  sections_fill();
  if (HAS_MPU) {
    VTOR = (uint32_t)&vectors; // where a boot loader has left its own
    guard_stack();
  }
  cortex_m_halt(main());
}
