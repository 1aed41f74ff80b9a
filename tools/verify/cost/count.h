// A window in which instructions are counted: those of code that went through
// count.py, and no others.
#ifndef COST_COUNT_H
#define COST_COUNT_H

#include <stdint.h>

#ifndef __x86_64__
#error "instructions are counted on x86-64"
#endif

// Whether the processor is to trap after every instruction in the window
// (stepped.c): sets or clears the trap flag. The red zone is left alone.
extern int count_stepping;
static inline void count_trap(unsigned long flag) {
  if (count_stepping)
    __asm__ volatile(
        "lea -128(%%rsp), %%rsp\n\tpushfq\n\tandq $~0x100, (%%rsp)\n\t"
        "orq %0, (%%rsp)\n\tpopfq\n\tlea 128(%%rsp), %%rsp" ::"r"(flag)
        : "memory", "cc");
}

static inline void count_open(void) {
  __asm__ volatile("pxor %%mm7, %%mm7" ::: "mm7", "memory");
  count_trap(0x100);
}

// Of the window just closed: how often a stretch was counted.
extern uint32_t count_additions;
static inline uint32_t count_close(void) {
  uint64_t n;
  count_trap(0);
  __asm__ volatile("movq %%mm7, %0\n\temms" : "=r"(n)::"mm7", "memory");
  count_additions = (uint32_t)(n >> 32);
  return (uint32_t)n;
}

// The instructions of a call. Its value is dropped.
#define COUNT(call) (count_open(), (void)(call), count_close())

#endif
