/// @file
/// What sections.ld provides for startup code, and its use.
#ifndef TWOFOLD_PORT_SECTIONS_H
#define TWOFOLD_PORT_SECTIONS_H

#include <stdint.h>

extern uint32_t data_source[], data_begin[], data_end[];
extern uint32_t bss_begin[], bss_end[], stack_top[];

/// Initialises data and clears the rest, before main.
static inline void sections_fill(void) {
  const uint32_t *from = data_source;
  for (uint32_t *to = data_begin; to < data_end;) *to++ = *from++;
  for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
}

#endif
