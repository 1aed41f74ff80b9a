// On the target: how deep the stack of the firmware gets. The memory below the
// stack is painted before the firmware's main begins and examined when it
// halts; interrupts are on and count too. Prints "stack BYTES".
#include <stddef.h>
#include <stdint.h>

int firmware_main(void);

// The firmware's main, and the end of it, as functions of this program.
#define main firmware_main
#define port_halt painted_halt
#include "../../port/main.c" // NOLINT(bugprone-suspicious-include)
#undef main
#undef port_halt
#include "say.h"

void port_halt(int code);

#define PAINT 0xA5u
#define DEPTH 8192u // painted, where there is so much
#define OURS 48u    // the most that the frame of main below takes

// Ends of the memory under the stack, from the linker script or, on AVR, from
// the C library's.
#ifdef __AVR__
extern uint8_t __bss_end;
#define LOWEST (&__bss_end + 1) // behind the mark of avr.c
#define TOP ((uint8_t *)RAMEND + 1)
#include <avr/io.h>
#else
extern uint8_t bss_end[], stack_top[];
#define LOWEST bss_end
#define TOP stack_top
#endif

static uint8_t *floor_of(void) {
  uint8_t *top = TOP;
  return (size_t)(top - LOWEST) > DEPTH ? top - DEPTH : LOWEST;
}

void painted_halt(int code) {
  static uint8_t line[32];
  text_t text = {line};
  const volatile uint8_t *at = floor_of();
  while (at < TOP && *at == PAINT) at++;
  text_string(&text, "\r\nstack ");
  text_whole(&text, (uint32_t)(TOP - at), 1);
  say(line, &text);
  port_halt(code);
  for (;;) {
  }
}

int main(void) {
  volatile uint8_t here = 0;
  // All but the frame of this function. Interrupts are not on yet.
  const uintptr_t until = (uintptr_t)&here - OURS;
  for (volatile uint8_t *at = floor_of(); (uintptr_t)at < until; at++)
    *at = PAINT;
  return firmware_main();
}
