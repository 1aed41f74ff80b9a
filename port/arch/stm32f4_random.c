// port_boot by the random number generator of an STM32F405, F407 or relatives
// that have one. It runs from the PLL's output of 48 MHz; where that is not
// there, no number comes.
#include "../port.h"
#include "register.h"

#define RCC_AHB2ENR REGISTER(0x40023834u)
#define RNG_ENABLE (1u << 6)
#define RNG_CR REGISTER(0x50060800u)
#define RNG_SR REGISTER(0x50060804u)
#define RNG_DR REGISTER(0x50060808u)
#define ON (1u << 2)
#define READY 1u
#define RNG_FAULTS (3u << 1 | 3u << 5) // of clock and seed, now and since
#define RNG_WAIT_AT_MOST 100000u

// Returns: whether a word came and the generator finds itself sound.
static bool read_word(uint32_t *word) {
  for (uint32_t i = 0; i < RNG_WAIT_AT_MOST; i++) {
    const uint32_t status = RNG_SR;
    if (status & RNG_FAULTS) return false;
    if (status & READY) {
      *word = RNG_DR;
      return true;
    }
  }
  return false;
}

// The manual wants the first word compared with the second and not used: a
// generator that hangs repeats itself.
uint32_t port_boot(void) {
  uint32_t first = 0, second = 0;
  RCC_AHB2ENR |= RNG_ENABLE;
  RNG_CR = ON;
  const bool good = read_word(&first) && read_word(&second) && first != second;
  RNG_CR = 0;
  return good ? second : 0;
}
