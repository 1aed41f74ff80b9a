/* The random numbers of a chip that no emulator here has, from its own driver
 * on registers made of memory: a look at one lets the hardware go on. */
#include "tap.h"

#define TWOFOLD_PORT_REGISTER_H
#define REGISTER(address) (*look_at(address))
static volatile uint32_t *look_at(uint32_t address);

/* NOLINTNEXTLINE(bugprone-suspicious-include) */
#include "../../port/arch/stm32f4_random.c"

static struct {
  uint32_t enable, control, status, word;
  unsigned words;      /* that the generator has made */
  bool hangs, is_dead; /* it repeats itself; it makes none */
} chip;

/* What the hardware has done until somebody looks. */
static volatile uint32_t *look_at(uint32_t address) {
  static const struct {
    uint32_t address;
    uint32_t *word;
  } known[] = {{0x40023834u, &chip.enable},
               {0x50060800u, &chip.control},
               {0x50060804u, &chip.status},
               {0x50060808u, &chip.word}};
  unsigned i = 0;
  while (i < 3 && known[i].address != address) i++;
  CHECK(known[i].address == address);
  const bool runs = (chip.enable & RNG_ENABLE) && (chip.control & ON);
  if (runs && !chip.is_dead) chip.status |= READY;
  if (known[i].word == &chip.word) {
    CHECK(runs);
    chip.word += chip.hangs ? 0 : 0x9e3779b9u;
    chip.words++;
  }
  return known[i].word;
}

TEST(random_numbers_are_of_a_sound_generator) {
  uint32_t seen[60];
  for (unsigned n = 0; n < 60; n++) {
    seen[n] = port_boot();
    CHECK(seen[n] == chip.word && chip.words == 2 * n + 2 && !chip.control);
    for (unsigned i = 0; i < n; i++) CHECK(seen[i] != seen[n]);
  }
  chip.hangs = true;
  CHECK(port_boot() == 0);
  chip.hangs = false;
  for (unsigned bit = 1; bit < 7; bit++) {
    chip.status = 1u << bit;
    CHECK((port_boot() == 0) == ((RNG_FAULTS >> bit & 1u) != 0));
  }
  chip.is_dead = true;
  chip.status = 0;
  CHECK(port_boot() == 0 && chip.control == 0);
}
