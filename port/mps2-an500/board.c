// Arm MPS2+ with FPGA image AN500: Cortex-M7 at 25 MHz with FPU for double.
#include "../arch/cortex_m.h"
#include "../port.h"
#include "../ring.h"

#define CLOCK_HZ 25000000u

#define UART(offset) REGISTER(0x40004000u + (offset))
#define UART_DATA UART(0x00u)
#define UART_STATE UART(0x04u)
#define UART_CTRL UART(0x08u)
#define UART_INTCLEAR UART(0x0Cu)
#define UART_BAUDDIV UART(0x10u)
#define TX_FULL 1u
#define RX_FULL 2u
#define RX_OVERRUN 8u
#define RX_IRQ 0u

#ifdef WATCHDOG
#define DOG(offset) REGISTER(0x40008000u + (offset))
#define DOG_LOAD DOG(0x00u)
#define DOG_CONTROL DOG(0x08u)
#define DOG_CLEAR DOG(0x0Cu)
#define DOG_LOCK DOG(0xC00u)
#endif

static ring_t received;

void cortex_m_interrupt(void) {
  UART_INTCLEAR = 2u;
  if (UART_STATE & RX_OVERRUN) {
    UART_STATE = RX_OVERRUN;
    ring_lose();
  }
  while (UART_STATE & RX_FULL) ring_put(&received, (uint8_t)UART_DATA);
}

void port_init(void) {
  UART_BAUDDIV = CLOCK_HZ / BAUD;
  UART_CTRL = 1u | 2u | 8u; // send, receive, receive interrupt
  cortex_m_enable(RX_IRQ);
}

#ifdef WATCHDOG
// It counts down twice: to an NMI, whose handler says where the program is, and
// to a restart.
static void start_watchdog(void) {
  DOG_LOCK = 0x1ACCE551u;
  DOG_LOAD = WATCHDOG * (CLOCK_HZ / 1000u);
  DOG_CONTROL = 3u;
}

void port_feed(void) { DOG_CLEAR = 1u; }
#endif

bool port_tick_start(uint32_t rate) {
#ifdef WATCHDOG
  start_watchdog();
#endif
  return cortex_m_tick_start(CLOCK_HZ / rate);
}

uint32_t port_clock_rate(void) { return CLOCK_HZ; }

unsigned port_room(void) { return !(UART_STATE & TX_FULL); }

void port_put(uint8_t byte) { UART_DATA = byte; }

int port_get(void) { return ring_get(&received); }

void port_halt(int code) { cortex_m_halt(code); }
