// A whole board with an STM32F405 or its relatives up to the STM32F446, at
// 168 MHz. Its board.mk defines
//   STM32F4_HSE_MHZ       of the crystal, or of a clock that comes in
//   STM32F4_HSE_IS_CLOCK  1: a clock comes in; 0: there is a crystal
//   STM32F4_USART         1: USART1 on PA9, PA10; 2: USART2 on PA2, PA3
// Where that clock does not start the PLL runs from the internal 16 MHz; every
// wait is bounded.
#include "../port.h"
#include "../ring.h"
#include "cortex_m.h"

#define RCC(offset) REGISTER(0x40023800u + (offset))
#define RCC_CR RCC(0x00u)
#define RCC_PLLCFGR RCC(0x04u)
#define RCC_CFGR RCC(0x08u)
#define RCC_AHB1ENR RCC(0x30u)
#define RCC_APB1ENR RCC(0x40u)
#define RCC_APB2ENR RCC(0x44u)
#define HSI_READY (1u << 1)
#define HSE_ON (1u << 16)
#define HSE_READY (1u << 17)
#define HSE_BYPASS (1u << 18)
#define PLL_ON (1u << 24)
#define PLL_READY (1u << 25)
#define PLL_FROM_HSE (1u << 22)

#define FLASH_ACR REGISTER(0x40023C00u)
#define GPIOA(offset) REGISTER(0x40020000u + (offset))
#define GPIOA_MODER GPIOA(0x00u)
#define GPIOA_AFRL GPIOA(0x20u)
#define GPIOA_AFRH GPIOA(0x24u)
#define USART(offset) \
  REGISTER((STM32F4_USART == 1 ? 0x40011000u : 0x40004400u) + (offset))
#define USART_SR USART(0x00u)
#define USART_DR USART(0x04u)
#define USART_BRR USART(0x08u)
#define USART_CR1 USART(0x0Cu)
#define TX_EMPTY (1u << 7)
#define RX_FULL (1u << 5)
#define RX_OVERRUN (1u << 3)
#define RX_WRONG (RX_OVERRUN | 1u << 2 | 1u << 1) // or noise, or no stop bit
#ifdef WATCHDOG
#define IWDG(offset) REGISTER(0x40003000u + (offset))
#define IWDG_KR IWDG(0x0u)
#define IWDG_PR IWDG(0x4u)
#define IWDG_RLR IWDG(0x8u)
#define DEBUG_FREEZE REGISTER(0xE0042008u)
#endif

#define PLL_HZ 168000000u
#define HSI_HZ 16000000u
#define WAIT_AT_MOST 100000u

#if STM32F4_USART != 1 && STM32F4_USART != 2
#error "STM32F4_USART is 1 or 2"
#endif
#define IS_USART1 (STM32F4_USART == 1)
#define USART_IRQ (IS_USART1 ? 37u : 38u)
#define USART_HZ (PLL_HZ / (IS_USART1 ? 2u : 4u)) // of APB2, APB1

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
  if (STM32F4_HSE_IS_CLOCK) RCC_CR |= HSE_BYPASS;
  RCC_CR |= HSE_ON;
  const uint32_t source =
      wait_for(HSE_READY) ? STM32F4_HSE_MHZ | PLL_FROM_HSE : 16u;
  // The highest bits as after a reset: on an F446 they divide another output.
  RCC_PLLCFGR = source | 336u << 6 | 7u << 24 | 2u << 28;
  RCC_CR |= PLL_ON;
  if (!wait_for(PLL_READY)) return HSI_HZ;
  FLASH_ACR = 7u << 8 | 5u;            // caches, prefetch, 5 wait states
  RCC_CFGR = 5u << 10 | 4u << 13;      // APB1 / 4, APB2 / 2
  RCC_CFGR = 5u << 10 | 4u << 13 | 2u; // from the PLL
  return PLL_HZ;
}

// An overrun keeps the interrupt pending until the data register is read, also
// where that holds no byte.
void cortex_m_interrupt(void) {
  for (uint32_t is; (is = USART_SR) & (RX_FULL | RX_OVERRUN);) {
    const uint8_t byte = (uint8_t)USART_DR;
    if (is & RX_WRONG) ring_lose();
    if (is & RX_FULL) ring_put(&received, byte);
  }
}

// Pins to alternate function 7, and the clock of the USART.
static void connect(void) {
  RCC_AHB1ENR |= 1u; // GPIOA
  if (IS_USART1) {
    RCC_APB2ENR |= 1u << 4;
    GPIOA_MODER = (GPIOA_MODER & ~(0xFu << 18)) | 0xAu << 18; // PA9, PA10
    GPIOA_AFRH = (GPIOA_AFRH & ~(0xFFu << 4)) | 0x77u << 4;
  } else {
    RCC_APB1ENR |= 1u << 17;
    GPIOA_MODER = (GPIOA_MODER & ~(0xFu << 4)) | 0xAu << 4; // PA2, PA3
    GPIOA_AFRL = (GPIOA_AFRL & ~(0xFFu << 8)) | 0x77u << 8;
  }
}

void port_init(void) {
  clock_hz = start_clock();
  connect();
  USART_BRR = (clock_hz == PLL_HZ ? USART_HZ : HSI_HZ) / BAUD;
  USART_CR1 = 1u << 13 | 1u << 5 | 1u << 3 | 1u << 2;
  cortex_m_enable(USART_IRQ);
}

#ifdef WATCHDOG
// Of the internal 32 kHz, which may be 17 to 47 kHz, by 64: of 2 ms each, up to
// 4096 of them.
static void start_watchdog(void) {
  DEBUG_FREEZE |= 1u << 12; // stands while a debugger halts the processor
  IWDG_KR = 0x5555u;
  IWDG_PR = 4u;
  IWDG_RLR = WATCHDOG < 8192u ? WATCHDOG / 2u : 4095u;
  IWDG_KR = 0xCCCCu;
  port_feed();
}

void port_feed(void) { IWDG_KR = 0xAAAAu; }
#endif

bool port_tick_start(uint32_t rate) {
#ifdef WATCHDOG
  start_watchdog();
#endif
  return cortex_m_tick_start(clock_hz / rate);
}

uint32_t port_clock_rate(void) { return clock_hz; }

unsigned port_room(void) { return (USART_SR & TX_EMPTY) != 0; }

void port_put(uint8_t byte) { USART_DR = byte; }

int port_get(void) { return ring_get(&received); }

void port_halt(int code) { cortex_m_halt(code); }
