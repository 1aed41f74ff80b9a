/// @file
/// What sections.ld provides for startup code, and its use.
#ifndef TWOFOLD_PORT_SECTIONS_H
#define TWOFOLD_PORT_SECTIONS_H

#include <stdbool.h>
#include <stdint.h>

extern uint32_t data_source[], data_begin[], data_end[];
extern uint32_t bss_begin[], bss_end[], stack_top[];

/// At the end of the room of a stack, which grows down to the variables.
#define STACK_MARK 0x57AC0E4Du

/// Initialises data, clears the rest and marks the end of the stack, before
/// main.
static inline void sections_fill(void) {
  const uint32_t *from = data_source;
  for (uint32_t *to = data_begin; to < data_end;) *to++ = *from++;
  for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
  *bss_end = STACK_MARK;
}

/// What port_stack_holds returns where no hardware guards the stack.
static inline bool stack_holds(void) {
  return *(const volatile uint32_t *)bss_end == STACK_MARK;
}

#endif
