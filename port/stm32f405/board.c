// STM32F405: Cortex-M4F at 168 MHz; USART1 on PA9 and PA10. The PLL runs from a
// crystal of 25 MHz, or from the internal 16 MHz if that does not start; every
// wait is bounded.
#include "../arch/cortex_m.h"
#include "../port.h"
#include "../ring.h"

#define RCC(offset) REGISTER(0x40023800u + (offset))
#define RCC_CR RCC(0x00u)
#define RCC_PLLCFGR RCC(0x04u)
#define RCC_CFGR RCC(0x08u)
#define RCC_AHB1ENR RCC(0x30u)
#define RCC_APB2ENR RCC(0x44u)
#define HSI_READY (1u << 1)
#define HSE_ON (1u << 16)
#define HSE_READY (1u << 17)
#define PLL_ON (1u << 24)
#define PLL_READY (1u << 25)
#define PLL_FROM_HSE (1u << 22)

#define FLASH_ACR REGISTER(0x40023C00u)
#define GPIOA(offset) REGISTER(0x40020000u + (offset))
#define USART(offset) REGISTER(0x40011000u + (offset))
#define USART_SR USART(0x00u)
#define USART_DR USART(0x04u)
#define USART_BRR USART(0x08u)
#define USART_CR1 USART(0x0Cu)
#define TX_EMPTY (1u << 7)
#define RX_FULL (1u << 5)
#define USART1_IRQ 37u

#define PLL_HZ 168000000u
#define HSI_HZ 16000000u
#define WAIT_AT_MOST 100000u

static ring_t received;
static uint32_t clock_hz;

static bool wait_for(uint32_t bits) {
  for (uint32_t i = 0; i < WAIT_AT_MOST; i++)
    if (RCC_CR & bits) return true;
  return false;
}

// 168 MHz from 1 MHz x 336 / 2; buses at 42 and 84 MHz. Returns: the rate.
static uint32_t start_clock(void) {
  // On the chip this bit is set before the first instruction. If it reads 0
  // there is no clock control: this is an emulator, which runs at full speed.
  if (!(RCC_CR & HSI_READY)) return PLL_HZ;
  RCC_CR |= HSE_ON;
  const bool crystal = wait_for(HSE_READY);
  RCC_PLLCFGR = (crystal ? 25u | PLL_FROM_HSE : 16u) | 336u << 6 | 7u << 24;
  RCC_CR |= PLL_ON;
  if (!wait_for(PLL_READY)) return HSI_HZ;
  FLASH_ACR = 7u << 8 | 5u;            // caches, prefetch, 5 wait states
  RCC_CFGR = 5u << 10 | 4u << 13;      // APB1 / 4, APB2 / 2
  RCC_CFGR = 5u << 10 | 4u << 13 | 2u; // from the PLL
  return PLL_HZ;
}

void cortex_m_interrupt(void) {
  while (USART_SR & RX_FULL) ring_put(&received, (uint8_t)USART_DR);
}

void port_init(void) {
  clock_hz = start_clock();
  RCC_AHB1ENR |= 1u;                                          // GPIOA
  RCC_APB2ENR |= 1u << 4;                                     // USART1
  GPIOA(0x00u) = (GPIOA(0x00u) & ~(0xFu << 18)) | 0xAu << 18; // PA9, PA10:
  GPIOA(0x24u) = (GPIOA(0x24u) & ~(0xFFu << 4)) | 0x77u << 4; // USART1
  USART_BRR = (clock_hz == PLL_HZ ? PLL_HZ / 2u : HSI_HZ) / 115200u;
  USART_CR1 = 1u << 13 | 1u << 5 | 1u << 3 | 1u << 2;
  cortex_m_enable(USART1_IRQ);
}

bool port_tick_start(uint32_t rate) {
  const uint32_t cycles = clock_hz / rate;
  if (cycles < 500u || cycles > 1u << 24) return false;
  cortex_m_tick_start(cycles);
  return true;
}

uint32_t port_ticks(void) { return cortex_m_ticks(); }

uint32_t port_clock(void) { return cortex_m_clock(); }

uint32_t port_clock_rate(void) { return clock_hz; }

unsigned port_room(void) { return (USART_SR & TX_EMPTY) != 0; }

void port_put(uint8_t byte) { USART_DR = byte; }

int port_get(void) { return ring_get(&received); }

void port_idle(uint32_t seen) { cortex_m_tick_idle(seen); }

void port_halt(int code) { cortex_m_halt(code); }
