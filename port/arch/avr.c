// A whole board of an AVR with USART0 and TIMER1, such as ATmega328P and
// ATmega2560, at 16 MHz. TIMER1 counts half microseconds to its compare
// register and is both tick and clock. The startup code is that of avr-libc.
// The exit code is printed as a last line, EXIT, because nothing else could
// take it.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>
#include <util/atomic.h>

#include "../port.h"
#include "../ring.h"

#define CLOCK_HZ (F_CPU / 8u)

// A chip with one USART leaves out its number.
#ifndef USART0_RX_vect
#define USART0_RX_vect USART_RX_vect
#endif

// Where avr-libc would put a heap, the stack ends.
extern uint8_t __heap_start;
#define STACK_END (*(volatile uint8_t *)&__heap_start)
#define STACK_MARK 0x4Du

static ring_t received;
static volatile uint32_t ticks;
static uint16_t period;

ISR(TIMER1_COMPA_vect) { ticks++; }

ISR(USART0_RX_vect) { ring_put(&received, UDR0); }

bool port_stack_holds(void) { return STACK_END == STACK_MARK; }

void port_init(void) {
  STACK_END = STACK_MARK;
  UBRR0 = F_CPU / 8u / BAUD - 1u;
  UCSR0A = 1u << U2X0;
  UCSR0C = 3u << UCSZ00;
  UCSR0B = 1u << RXEN0 | 1u << TXEN0 | 1u << RXCIE0;
  sei();
}

#ifdef WATCHDOG
// Of its own 128 kHz: 16 ms, or twice that up to nine times. At the end of its
// time it says so, and at that of another one it restarts the board.
static void start_watchdog(void) {
  uint8_t n = 0;
  while (n < 9u && (16ul << n) < WATCHDOG) n++;
  const uint8_t how =
      (uint8_t)(1u << WDIE | 1u << WDE | (n & 8u) << 2 | (n & 7u));
  wdt_reset();
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { // the second write within four cycles
    WDTCSR = 1u << WDCE | 1u << WDE;
    WDTCSR = how;
  }
}

ISR(WDT_vect) { port_fault("watchdog", 0, 0); }

void port_feed(void) { wdt_reset(); }

// It goes on after the restart, at 16 ms.
__attribute__((naked, used, section(".init3"))) static void end_watchdog(void) {
  MCUSR = 0;
  wdt_disable();
}
#endif

bool port_tick_start(uint32_t rate) {
  const uint32_t counts = CLOCK_HZ / rate;
  if (counts < 100u || counts > 65536u) return false;
#ifdef WATCHDOG
  start_watchdog();
#endif
  period = (uint16_t)(counts - 1u);
  TCCR1A = 0;
  TCNT1 = 0;
  OCR1A = period;
  TIMSK1 = 1u << OCIE1A;
  TCCR1B = 1u << WGM12 | 1u << CS11; // clear on compare, 16 MHz / 8
  return true;
}

uint32_t port_ticks(void) {
  uint32_t tick;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { tick = ticks; }
  return tick;
}

// In an emulator the counter may start again before the interrupt comes; then
// the clock stands until it has.
uint32_t port_clock(void) {
  static uint32_t latest;
  uint32_t tick;
  uint16_t since;
  do { // again if a tick came in between; a pending one is counted at once
    tick = port_ticks();
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { since = TCNT1; }
  } while (tick != port_ticks());
  const uint32_t now = tick * (period + 1ul) + since;
  if (now - latest < UINT32_MAX / 2) latest = now;
  return latest;
}

uint32_t port_clock_rate(void) { return CLOCK_HZ; }

unsigned port_room(void) { return (UCSR0A & (1u << UDRE0)) != 0; }

void port_put(uint8_t byte) { UDR0 = byte; }

int port_get(void) { return ring_get(&received); }

// Sleep mode would save current, but QEMU never wakes from it.
void port_idle(uint32_t seen) { (void)seen; }

static void put(char byte) {
  while (!port_room()) {
  }
  port_put((uint8_t)byte);
}

void port_halt(int code) {
  const char *exit = "\r\nEXIT ";
  while (*exit) put(*exit++);
  put((char)('0' + code % 10));
  put('\r');
  put('\n');
  for (;;) {
  }
}
