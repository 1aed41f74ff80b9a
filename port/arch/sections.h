/// @file
/// What sections.ld tells a startup code, and what that does with it.
#ifndef TWOFOLD_PORT_SECTIONS_H
#define TWOFOLD_PORT_SECTIONS_H

#include <stdint.h>

extern uint32_t data_source[], data_begin[], data_end[];
extern uint32_t bss_begin[], bss_end[], stack_top[];

/// Data as the program has them, all else 0: before main.
static inline void sections_fill(void) {
  const uint32_t *from = data_source;
  for (uint32_t *to = data_begin; to < data_end;) *to++ = *from++;
  for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
}

#endif
