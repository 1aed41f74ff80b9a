// A window in which instructions are counted: those of code that went through
// count.py, and no others.
#ifndef COST_COUNT_H
#define COST_COUNT_H

#include <stdint.h>

#ifndef __x86_64__
#error "instructions are counted on x86-64"
#endif

static inline void count_open(void) {
  __asm__ volatile("pxor %%mm7, %%mm7" ::: "mm7", "memory");
}

static inline uint32_t count_close(void) {
  uint64_t n;
  __asm__ volatile("movq %%mm7, %0\n\temms" : "=r"(n)::"mm7", "memory");
  return (uint32_t)n;
}

// The instructions of a call. Its value is dropped.
#define COUNT(call) (count_open(), (void)(call), count_close())

#endif
