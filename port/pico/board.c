// Raspberry Pi Pico: RP2040, Cortex-M0+ without FPU at 125 MHz from a crystal
// of 12 MHz, 264 KB RAM; UART0 on pins GP0 and GP1. The second core stays in
// the boot ROM.
#include "../arch/cortex_m.h"
#include "../port.h"
#include "../ring.h"

// A write at this distance behind a register clears bits of it.
#define CLEAR 0x3000u

#define RESETS(offset) REGISTER(0x4000C000u + (offset))
#define RESETS_CLEAR RESETS(CLEAR)
#define RESETS_DONE RESETS(0x08u)
#define BLOCKS (1u << 5 | 1u << 8 | 1u << 12 | 1u << 22) // pins, PLL, UART0

#define XOSC(offset) REGISTER(0x40024000u + (offset))
#define XOSC_CTRL XOSC(0x00u)
#define XOSC_STATUS XOSC(0x04u)
#define XOSC_STARTUP XOSC(0x0Cu)

#define PLL(offset) REGISTER(0x40028000u + (offset))
#define PLL_CS PLL(0x00u)
#define PLL_PWR_CLEAR PLL(0x04u + CLEAR)
#define PLL_FBDIV PLL(0x08u)
#define PLL_PRIM PLL(0x0Cu)
#define READY (1u << 31)

#define CLOCKS(offset) REGISTER(0x40008000u + (offset))
#define CLK_REF_CTRL CLOCKS(0x30u)
#define CLK_REF_SELECTED CLOCKS(0x38u)
#define CLK_SYS_CTRL CLOCKS(0x3Cu)
#define CLK_SYS_SELECTED CLOCKS(0x44u)
#define CLK_PERI_CTRL CLOCKS(0x48u)

#define PIN_CTRL(pin) REGISTER(0x40014004u + 8u * (pin))
#define UART(offset) REGISTER(0x40034000u + (offset))
#define UART_DR UART(0x00u)
#define UART_FR UART(0x18u)
#define UART_IBRD UART(0x24u)
#define UART_FBRD UART(0x28u)
#define UART_LCR_H UART(0x2Cu)
#define UART_CR UART(0x30u)
#define UART_IMSC UART(0x38u)
#define RX_EMPTY (1u << 4)
#define RX_WRONG (0xFu << 8) // of the byte, or of one before it
#define TX_FULL (1u << 5)
#define UART0_IRQ 20u

#define PLL_HZ 125000000u
#define CRYSTAL_HZ 12000000u
#define RING_HZ 6500000u // the oscillator that it starts with, roughly
#define WAIT_AT_MOST 100000u

static ring_t received;
static uint32_t clock_hz;

static bool wait_for(volatile uint32_t *what, uint32_t bits) {
  for (uint32_t i = 0; i < WAIT_AT_MOST; i++)
    if ((*what & bits) == bits) return true;
  return false;
}

// 125 MHz = 12 MHz x 125 / 6 / 2; the crystal itself if the PLL does not lock,
// the ring oscillator if the crystal does not start. Returns: the rate.
static uint32_t start_clock(void) {
  XOSC_STARTUP = 47;     // 1 ms, in units of 256 cycles
  XOSC_CTRL = 0xFABAA0u; // on, 1 to 15 MHz
  if (!wait_for(&XOSC_STATUS, READY)) return RING_HZ;
  CLK_REF_CTRL = 2;
  if (!wait_for(&CLK_REF_SELECTED, 1u << 2)) return RING_HZ;
  PLL_CS = 1; // the crystal, undivided
  PLL_FBDIV = 125;
  PLL_PWR_CLEAR = 1u << 0 | 1u << 5; // main part and oscillator
  if (!wait_for(&PLL_CS, READY)) return CRYSTAL_HZ;
  PLL_PRIM = 6u << 16 | 2u << 12;
  PLL_PWR_CLEAR = 1u << 3; // dividers
  CLK_SYS_CTRL = 1;
  return wait_for(&CLK_SYS_SELECTED, 1u << 1) ? PLL_HZ : CRYSTAL_HZ;
}

// Its FIFO interrupts when it is filled to a half, and when it has waited for
// 32 bits with less.
void cortex_m_interrupt(void) {
  while (!(UART_FR & RX_EMPTY)) {
    const uint32_t word = UART_DR;
    if ((word & RX_WRONG) != 0) ring_lose();
    ring_put(&received, (uint8_t)word);
  }
}

void port_init(void) {
  RESETS_CLEAR = BLOCKS;
  (void)wait_for(&RESETS_DONE, BLOCKS);
  clock_hz = start_clock();
  CLK_PERI_CTRL = 1u << 11; // from the system's clock
  PIN_CTRL(0) = 2;          // UART0
  PIN_CTRL(1) = 2;
  const uint32_t divider = (8u * clock_hz / BAUD + 1u) / 2u; // of 1/64
  UART_IBRD = divider / 64u;
  UART_FBRD = divider % 64u;
  UART_LCR_H = 7u << 4;             // 8 bits, FIFOs
  UART_CR = 1u << 9 | 1u << 8 | 1u; // receive, send, on
  UART_IMSC = 1u << 6 | 1u << 4;    // waited, filled
  cortex_m_enable(UART0_IRQ);
}

bool port_tick_start(uint32_t rate) {
  return cortex_m_tick_start(clock_hz / rate);
}

uint32_t port_clock_rate(void) { return clock_hz; }

unsigned port_room(void) { return !(UART_FR & TX_FULL); }

void port_put(uint8_t byte) { UART_DR = byte; }

int port_get(void) { return ring_get(&received); }

void port_halt(int code) { cortex_m_halt(code); }
