// BBC micro:bit: nRF51822, Cortex-M0 at 16 MHz without FPU, 16 KB RAM. The chip
// has no SysTick. The tick is TIMER0, which counts to its compare register 0
// and starts again; the clock is TIMER1, which runs freely. Both count
// microseconds. (In QEMU 7.2 a timer that is read loses ticks, and at 16 MHz it
// stands still.)
#include "../arch/cortex_m.h"
#include "../port.h"
#include "../ring.h"

#define CLOCK_HZ 1000000u

#define UART(offset) REGISTER(0x40002000u + (offset))
#define UART_STARTRX UART(0x000u)
#define UART_STARTTX UART(0x008u)
#define UART_RXDRDY UART(0x108u)
#define UART_TXDRDY UART(0x11Cu)
#define UART_INTENSET UART(0x304u)
#define UART_ERRORS UART(0x480u) // overrun, parity, framing, break
#define UART_ENABLE UART(0x500u)
#define UART_PSELTXD UART(0x50Cu)
#define UART_PSELRXD UART(0x514u)
#define UART_RXD UART(0x518u)
#define UART_TXD UART(0x51Cu)
#define UART_BAUDRATE UART(0x524u)
#define UART_IRQ 2u

#define TICKER(offset) REGISTER(0x40008000u + (offset))
#define CLOCK(offset) REGISTER(0x40009000u + (offset))
#define START 0x000u
#define CAPTURE0 0x040u
#define COMPARE0 0x140u
#define SHORTS 0x200u
#define INTENSET 0x304u
#define BITMODE 0x508u
#define PRESCALER 0x510u
#define CC0 0x540u
#define TICKER_IRQ 8u

#define RNG(offset) REGISTER(0x4000D000u + (offset))
#define RNG_STOP RNG(0x004u)
#define RNG_VALRDY RNG(0x100u)
#define RNG_CONFIG RNG(0x504u)
#define RNG_VALUE RNG(0x508u)
// A byte takes 0.7 ms; this is two seconds.
#define RNG_WAIT_AT_MOST 4000000u

static ring_t received;
static volatile uint32_t ticks;
static uint32_t clock; // of which the timer has the low 16 bits
static bool sending;

// The timer wraps after 65 ms, more than the longest tick. It is read in
// every tick, so a step may take longer.
static void read_clock(void) {
  CLOCK(CAPTURE0) = 1;
  clock += (uint16_t)(CLOCK(CC0) - clock);
}

void cortex_m_interrupt(void) {
  if (TICKER(COMPARE0)) {
    TICKER(COMPARE0) = 0;
    ticks++;
    read_clock();
  }
  if (UART_RXDRDY) {
    UART_RXDRDY = 0;
    if (UART_ERRORS != 0) {
      UART_ERRORS = 0xFu;
      ring_lose();
    }
    ring_put(&received, (uint8_t)UART_RXD);
  }
}

void port_init(void) {
  UART_PSELTXD = 24;
  UART_PSELRXD = 25;
  // Of 16 MHz in units of 2^-32, and of that the upper 20 bits.
  UART_BAUDRATE =
      (uint32_t)((((uint64_t)BAUD << 32) / 16000000u + 0x800u) & 0xFFFFF000u);
  UART_ENABLE = 4;
  UART_INTENSET = 1u << 2; // RXDRDY
  UART_STARTTX = 1;
  UART_STARTRX = 1;
  cortex_m_enable(UART_IRQ);
}

bool port_tick_start(uint32_t rate) {
  const uint32_t period = CLOCK_HZ / rate;
  if (period < 50u || period > 50000u) return false;
  ticks = 0;
  CLOCK(BITMODE) = 0; // 16 bits, all that this timer has
  CLOCK(PRESCALER) = 4;
  CLOCK(START) = 1;
  TICKER(BITMODE) = 0;
  TICKER(PRESCALER) = 4; // 16 MHz / 2^4
  TICKER(CC0) = period;
  TICKER(SHORTS) = 1;          // COMPARE0 clears the counter
  TICKER(INTENSET) = 1u << 16; // COMPARE0
  cortex_m_enable(TICKER_IRQ);
  TICKER(START) = 1;
  return true;
}

uint32_t port_ticks(void) { return ticks; }

uint32_t port_clock(void) {
  __asm__ volatile("cpsid i" ::: "memory");
  read_clock();
  const uint32_t now = clock;
  __asm__ volatile("cpsie i" ::: "memory");
  return now;
}

uint32_t port_clock_rate(void) { return CLOCK_HZ; }

unsigned port_room(void) { return !sending || UART_TXDRDY; }

void port_put(uint8_t byte) {
  UART_TXDRDY = 0;
  sending = true;
  UART_TXD = byte;
}

int port_get(void) { return ring_get(&received); }

void port_idle(uint32_t seen) { cortex_m_idle(&ticks, seen); }

void port_halt(int code) { cortex_m_halt(code); }

// Four bytes of noise, freed by the chip of what they prefer.
uint32_t port_boot(void) {
  uint32_t number = 0, left = RNG_WAIT_AT_MOST;
  RNG_CONFIG = 1;
  RNG(START) = 1;
  for (unsigned i = 0; i < 4; i++) {
    RNG_VALRDY = 0;
    while (left > 0 && !RNG_VALRDY) left--;
    number = number << 8 | (RNG_VALUE & 0xffu);
  }
  RNG_STOP = 1;
  return left > 0 ? number : 0;
}
