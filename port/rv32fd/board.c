// RV32IMAFDC, as QEMU's machine `virt` has it: 16550 UART, CLINT at 10 MHz.
// There is no such chip; the port is here for the instruction set.
#include "../arch/riscv.h"
#include "../port.h"
#include "../ring.h"

#define CLOCK_HZ 10000000u
#define UART(offset) (*(volatile uint8_t *)(0x10000000u + (offset)))
#define UART_DATA UART(0)
#define UART_IER UART(1)
#define UART_LSR UART(5)
#define RX_FULL 1u
#define RX_WRONG 0x1Eu // of the byte, or of one before it
#define TX_EMPTY 0x20u
#define UART_IRQ 10u
#define TEST_DEVICE REGISTER(0x00100000u)

static ring_t received;

void riscv_interrupt(uint32_t source) {
  (void)source;
  for (uint8_t is; (is = UART_LSR) & RX_FULL;) {
    if ((is & RX_WRONG) != 0) ring_lose();
    ring_put(&received, UART_DATA);
  }
}

void port_init(void) {
  UART_IER = 1;
  riscv_enable(UART_IRQ);
}

bool port_tick_start(uint32_t rate) {
  if (rate > CLOCK_HZ / 100u) return false;
  riscv_tick_start(CLOCK_HZ / rate);
  return true;
}

uint32_t port_clock_rate(void) { return CLOCK_HZ; }

unsigned port_room(void) { return (UART_LSR & TX_EMPTY) != 0; }

void port_put(uint8_t byte) { UART_DATA = byte; }

int port_get(void) { return ring_get(&received); }

void riscv_halt(int code) {
  TEST_DEVICE = code == 0 ? 0x5555u : (uint32_t)code << 16 | 0x3333u;
  for (;;) {
  }
}

void port_halt(int code) { riscv_halt(code); }
