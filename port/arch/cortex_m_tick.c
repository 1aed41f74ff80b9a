// SysTick as the tick and, between two ticks, as the clock.
#include "../port.h"
#include "cortex_m.h"

#define SYST_CSR REGISTER(0xE000E010u)
#define SYST_RVR REGISTER(0xE000E014u)
#define SYST_CVR REGISTER(0xE000E018u)
#define ICSR REGISTER(0xE000ED04u)
#define ICSR_PENDSTSET (1u << 26)

static volatile uint32_t ticks;
static uint32_t cycles_a_tick;

void cortex_m_systick(void) { ticks++; }

bool cortex_m_tick_start(uint32_t cycles) {
  if (cycles < 500u || cycles > 1u << 24) return false;
  ticks = 0;
  cycles_a_tick = cycles;
  SYST_RVR = cycles - 1u;
  SYST_CVR = 0;
  SYST_CSR = 7u; // processor's clock, interrupt, on
  return true;
}

uint32_t port_ticks(void) { return ticks; }

void port_idle(uint32_t seen) { cortex_m_idle(&ticks, seen); }

uint32_t port_clock(void) {
  uint32_t tick, left;
  do { // again if a tick came in between, counted or pending
    tick = ticks;
    left = SYST_CVR;
  } while (tick != ticks || (ICSR & ICSR_PENDSTSET));
  return (tick + 1u) * cycles_a_tick - 1u - left;
}
