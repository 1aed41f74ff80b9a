/* The receive interrupt and the watchdog of STM32F4, on registers that are
 * variables: what they do to each other is that of the manual (RM0090,
 * 30.6). */
#include <stdbool.h>

#include "tap.h"
#define REGISTER(address) (*(reg_at(address)))
static volatile uint32_t *reg_at(uint32_t address);

#define STM32F4_USART 1
#define STM32F4_HSE_MHZ 8u
#define STM32F4_HSE_IS_CLOCK 0
#define BAUD 115200u
#define WATCHDOG 100u
/* Of Cortex-M, whose instructions this machine lacks. */
#define TWOFOLD_PORT_CORTEX_M_H
static void cortex_m_interrupt(void);
static void cortex_m_enable(unsigned number) { (void)number; }
static bool cortex_m_tick_start(uint32_t cycles) { return cycles > 0; }
__attribute__((noreturn)) static void cortex_m_halt(int code) { exit(code); }
#include "../../port/arch/stm32f4.c" // NOLINT(bugprone-suspicious-include)

static struct {
  volatile uint32_t status, data, key, other;
  uint32_t keys[8];
  unsigned written;
  bool was_seen; /* the status, since something came */
} chip;

/* What is written to a register is seen at the next access. */
static void settle(void) {
  if (chip.key != 0 && chip.written < 8) chip.keys[chip.written++] = chip.key;
  chip.key = 0;
}

static volatile uint32_t *reg_at(uint32_t address) {
  settle();
  switch (address) {
    case 0x40011000u:
      chip.was_seen = true;
      return &chip.status;
    case 0x40011004u: /* status, then data: both flags go */
      if (chip.was_seen) chip.status &= ~(RX_FULL | RX_OVERRUN);
      chip.was_seen = false;
      return &chip.data;
    case 0x40003000u:
      return &chip.key;
    default:
      return &chip.other;
  }
}

/* And what was lost is counted. */
TEST(overrun_without_a_byte_ends_its_interrupt) {
  static const uint32_t flags[] = {RX_FULL, RX_OVERRUN, RX_FULL | RX_OVERRUN};
  for (int i = 0; i < 3; i++) {
    chip.status = flags[i] | TX_EMPTY;
    chip.data = 'a';
    cortex_m_interrupt();
    CHECK(chip.status == TX_EMPTY && port_unread() == (uint32_t)i);
    CHECK(port_get() == ((flags[i] & RX_FULL) ? 'a' : -1) && port_get() == -1);
  }
}

TEST(watchdog_is_unlocked_set_started_and_fed) {
  chip.written = 0;
  port_init();
  settle();
  CHECK(chip.written == 0);
  CHECK(port_tick_start(1000));
  port_feed();
  settle();
  CHECK(chip.written == 4 && chip.keys[0] == 0x5555 && chip.keys[1] == 0xCCCC);
  CHECK(chip.keys[2] == 0xAAAA && chip.keys[3] == 0xAAAA);
}
