// SiFive HiFive1: FE310, RV32IMAC without FPU, 256 MHz from a crystal of
// 16 MHz, 16 KB RAM; UART0 on pins 16 and 17.
#include "../arch/riscv.h"
#include "../port.h"
#include "../ring.h"

#define PRCI(offset) REGISTER(0x10008000u + (offset))
#define PRCI_HFXOSC PRCI(0x04u)
#define PRCI_PLL PRCI(0x08u)
#define PRCI_PLLOUT PRCI(0x0Cu)
#define READY 0x80000000u
#define PLL_SELECT (1u << 16)
#define PLL_FROM_CRYSTAL (1u << 17)
#define PLL_BYPASS (1u << 18)

#define GPIO(offset) REGISTER(0x10012000u + (offset))
#define UART(offset) REGISTER(0x10013000u + (offset))
#define UART_TX UART(0x00u)
#define UART_RX UART(0x04u)
#define UART_TXCTRL UART(0x08u)
#define UART_RXCTRL UART(0x0Cu)
#define UART_IE UART(0x10u)
#define UART_DIV UART(0x18u)
#define FULL_OR_EMPTY 0x80000000u
#define UART_IRQ 3u

#define PLL_HZ 256000000u
#define CRYSTAL_HZ 16000000u
#define INTERNAL_HZ 13800000u
#define WAIT_AT_MOST 100000u

static ring_t received;

static bool wait_for(volatile uint32_t *what) {
  for (uint32_t i = 0; i < WAIT_AT_MOST; i++)
    if (*what & READY) return true;
  return false;
}

// 256 MHz = 16 MHz / 2 x 64 / 2; the crystal itself if the PLL does not lock,
// the internal oscillator if the crystal does not start. Returns: the rate.
static uint32_t start_clock(void) {
  PRCI_HFXOSC = 1u << 30;
  if (!wait_for(&PRCI_HFXOSC)) return INTERNAL_HZ;
  PRCI_PLL = PLL_FROM_CRYSTAL | PLL_BYPASS;
  PRCI_PLL = PLL_FROM_CRYSTAL | PLL_BYPASS | PLL_SELECT;
  PRCI_PLLOUT = 1u << 8; // divided by one
  const uint32_t factors = 1u | 31u << 4 | 1u << 10;
  PRCI_PLL = PLL_FROM_CRYSTAL | PLL_BYPASS | PLL_SELECT | factors;
  PRCI_PLL = PLL_FROM_CRYSTAL | PLL_BYPASS | factors;
  PRCI_PLL = PLL_FROM_CRYSTAL | factors;
  if (!wait_for(&PRCI_PLL)) {
    PRCI_PLL = PLL_FROM_CRYSTAL | PLL_BYPASS | PLL_SELECT;
    return CRYSTAL_HZ;
  }
  PRCI_PLL = PLL_FROM_CRYSTAL | factors | PLL_SELECT;
  return PLL_HZ;
}

void riscv_interrupt(uint32_t source) {
  uint32_t byte;
  (void)source;
  while (!((byte = UART_RX) & FULL_OR_EMPTY))
    ring_put(&received, (uint8_t)byte);
}

void port_init(void) {
  UART_DIV = start_clock() / BAUD - 1u;
  GPIO(0x3Cu) &= ~(3u << 16); // pins 16 and 17 are UART0's
  GPIO(0x38u) |= 3u << 16;
  UART_TXCTRL = 1;
  UART_RXCTRL = 1; // interrupt if more than 0 bytes wait
  UART_IE = 2;
  riscv_enable(UART_IRQ);
}

bool port_tick_start(uint32_t rate) {
  const uint32_t period = (MTIME_HZ + rate / 2u) / rate;
  const uint32_t got = period * rate;
  const uint32_t off = got > MTIME_HZ ? got - MTIME_HZ : MTIME_HZ - got;
  if (period == 0 || off > MTIME_HZ / 100u) return false;
  riscv_tick_start(period);
  return true;
}

uint32_t port_clock_rate(void) { return MTIME_HZ; }

unsigned port_room(void) { return !(UART_TX & FULL_OR_EMPTY); }

void port_put(uint8_t byte) { UART_TX = byte; }

int port_get(void) { return ring_get(&received); }

// Semihosting, SYS_EXIT_EXTENDED; the three instructions are a fixed sequence.
void riscv_halt(int code) {
  const uint32_t block[2] = {0x20026u, (uint32_t)code};
  register uint32_t operation __asm__("a0") = 0x20u;
  register const uint32_t *argument __asm__("a1") = block;
  __asm__ volatile(
      ".option push\n\t.option norvc\n\t.balign 16\n\t"
      "slli zero, zero, 0x1f\n\tebreak\n\tsrai zero, zero, 7\n\t"
      ".option pop"
      : "+r"(operation)
      : "r"(argument)
      : "memory");
  for (;;) {
  }
}

void port_halt(int code) { riscv_halt(code); }
