/* The numbers of two chips that no emulator here has, from their own drivers on
 * registers made of memory: a look at one lets the hardware go on, and any look
 * may be the one at which the power fails. */
#include <setjmp.h>

#include "tap.h"

#define TWOFOLD_PORT_REGISTER_H
#define REGISTER(address) (*look_at(address))
static volatile uint32_t *look_at(uint32_t address);

#define port_boot random_boot
/* NOLINTBEGIN(bugprone-suspicious-include) */
#include "../../port/arch/stm32f4_random.c"
#undef port_boot
#define port_boot count_boot
uint32_t count_boot(void);
#include "../../port/arch/stm32f4_count.c"
/* NOLINTEND(bugprone-suspicious-include) */

static struct {
  uint32_t enable, control, status, word;      /* of the generator */
  uint32_t access, key, state, command, other; /* of the flash */
  uint32_t flash[2][WORDS];
  unsigned words;       /* that the generator has made */
  bool hangs, is_dead;  /* it repeats itself; it makes none */
  bool is_worn;         /* nothing more is programmed */
  unsigned fails_after; /* looks; 0: the power stays */
  unsigned erased;
  jmp_buf failed;
} chip;

/* Each bit that was to become zero may have, and what is erased is anything. */
static void fail_power(volatile uint32_t *word) {
  if (chip.command & 1u) *word &= (uint32_t)tap_bits();
  if (chip.command & BEGIN)
    for (unsigned i = 0; i < WORDS; i++)
      chip.flash[(chip.command >> 3 & 15u) - FIRST_SECTOR][i] |=
          (uint32_t)tap_bits();
  longjmp(chip.failed, 1);
}

static void work(void) {
  if ((chip.command & BEGIN) == 0) return;
  const unsigned sector = (chip.command >> 3 & 15u) - FIRST_SECTOR;
  CHECK(sector < 2 && (chip.command & 2u) != 0);
  memset(chip.flash[sector], 0xff, sizeof chip.flash[sector]);
  chip.command &= ~BEGIN;
  chip.erased++;
}

static volatile uint32_t *register_at(uint32_t address) {
  static const struct {
    uint32_t address;
    uint32_t *word;
  } known[] = {{0x40023834u, &chip.enable}, {0x50060800u, &chip.control},
               {0x50060804u, &chip.status}, {0x50060808u, &chip.word},
               {0x40023C00u, &chip.access}, {0x40023C04u, &chip.key},
               {0x40023C0Cu, &chip.state},  {0x40023C10u, &chip.command}};
  for (unsigned i = 0; i < sizeof known / sizeof *known; i++)
    if (known[i].address == address) return known[i].word;
  CHECK(address >= 0x08040000u && address < 0x08080000u);
  const uint32_t word = (address - 0x08040000u) / 4u % (2u * WORDS);
  return &chip.flash[word / WORDS][word % WORDS];
}

/* What the hardware has done until somebody looks. */
static void go_on(const volatile uint32_t *word) {
  const bool runs = (chip.enable & RNG_ENABLE) && (chip.control & ON);
  if (runs && !chip.is_dead) chip.status |= READY;
  chip.state = chip.is_worn ? 1u << 7 : 0; /* whatever was written */
  if (word != &chip.word) return;
  CHECK(runs);
  chip.word += chip.hangs ? 0 : 0x9e3779b9u;
  chip.words++;
}

static volatile uint32_t *look_at(uint32_t address) {
  volatile uint32_t *word = register_at(address);
  if (chip.fails_after > 0 && --chip.fails_after == 0)
    fail_power(address >= 0x08000000u && address < 0x09000000u ? word
                                                               : &chip.other);
  work();
  go_on(word);
  return word;
}

static void new_chip(void) {
  memset(&chip, 0, sizeof chip);
  memset(chip.flash, 0xff, sizeof chip.flash);
}

/* A start, with the power that fails after so many looks. Returns: its number,
 * or 0: it never came so far. */
static uint32_t start(unsigned fails_after) {
  volatile uint32_t number = 0;
  chip.command = LOCKED;
  chip.state = 0;
  chip.fails_after = fails_after;
  if (setjmp(chip.failed) == 0) number = count_boot();
  chip.fails_after = 0;
  return number;
}

TEST(random_numbers_are_of_a_sound_generator) {
  uint32_t seen[60];
  new_chip();
  for (unsigned n = 0; n < 60; n++) {
    seen[n] = random_boot();
    CHECK(seen[n] == chip.word && chip.words == 2 * n + 2 && !chip.control);
    for (unsigned i = 0; i < n; i++) CHECK(seen[i] != seen[n]);
  }
  chip.hangs = true;
  CHECK(random_boot() == 0);
  chip.hangs = false;
  for (unsigned bit = 1; bit < 7; bit++) {
    chip.status = 1u << bit;
    CHECK((random_boot() == 0) == ((RNG_FAULTS >> bit & 1u) != 0));
  }
  chip.is_dead = true;
  chip.status = 0;
  CHECK(random_boot() == 0 && chip.control == 0);
}

/* Through both sectors and back, a full one leaves the other what is next. */
TEST(starts_are_counted_beyond_a_sector) {
  new_chip();
  for (uint32_t n = 1; n <= 60; n++) CHECK(start(0) == n);
  CHECK(chip.erased == 1 && chip.command == LOCKED);
  for (uint32_t turn = 1; turn < 5; turn++) {
    const unsigned full = (turn - 1) % 2;
    memset(&chip.flash[full][2], 0, (MARKS - 1) * sizeof(uint32_t));
    CHECK(start(0) == turn * MARKS);
    CHECK(start(0) == turn * MARKS + 1 && chip.erased == 1 + turn);
  }
  /* The last of all is not followed by the first. */
  memset(chip.flash[0], 0, sizeof chip.flash[0]);
  chip.flash[0][0] = ~(chip.flash[0][1] = MARKS);
  CHECK(start(0) == 0);
  /* Nor is a count that is lost, or cannot be kept. */
  new_chip();
  CHECK(start(0) == 1);
  chip.is_worn = true;
  CHECK(start(0) == 0);
  chip.is_worn = false;
  chip.flash[0][0] = 0;
  CHECK(start(0) == 0);
}

/* The power fails at every look of a start, the very first one and one that
 * goes to the other sector: numbers grow, and the count is never lost. */
TEST(power_that_fails_repeats_no_number) {
  for (unsigned turn = 0; turn < 3; turn++) {
    uint32_t last = turn * MARKS;
    new_chip();
    if (turn > 0) {
      CHECK(start(0) == 1);
      chip.flash[0][0] = ~(chip.flash[0][1] = ~(1 + (turn - 1) * MARKS));
      memset(&chip.flash[0][2], 0, MARKS * sizeof(uint32_t));
    }
    for (unsigned look = 1; look < 120; look++) {
      const uint32_t cut = start(look), number = start(0);
      CHECK(cut == 0 || cut > last);
      CHECK(number > last && number > cut);
      last = number;
    }
  }
}
