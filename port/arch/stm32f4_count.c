// port_boot for an STM32F4 without a random number generator: a count of starts
// in the last two sectors of 512 KB of flash, which the linker script keeps
// free. A start programs the next word of a sector from ones to zeros, and its
// number is the sector's first number and how many words that has used before.
// A full sector hands over to the other: that is erased and begins where this
// one ends, so that a count is always in one of the two, whenever the power
// fails. A number is given once its word reads zero: one that was cut off was
// given to nobody, whether its word is seen as free or as used.
#include "../port.h"
#include "register.h"

#define FLASH_ACR REGISTER(0x40023C00u)
#define FLASH_KEYR REGISTER(0x40023C04u)
#define FLASH_SR REGISTER(0x40023C0Cu)
#define FLASH_CR REGISTER(0x40023C10u)
#define FLASH_FAULTS 0xF2u
#define BUSY (1u << 16)
#define PROGRAM (1u | 2u << 8) // by words
#define ERASE(sector) (2u | (sector) << 3 | 2u << 8)
#define BEGIN (1u << 16)
#define LOCKED (1u << 31)
#define CACHE_ON (1u << 10)
#define CACHE_RESET (1u << 12)

// Longer than the 2 s that erasing takes at most.
#define ERASE_AT_MOST 100000000u

#define FIRST_SECTOR 6u
#define WORDS 32768u
#define WORD(sector, i) REGISTER(0x08040000u + 4u * (WORDS * (sector) + (i)))
#define FREE 0xFFFFFFFFu
#define MARKS (WORDS - 2u) // behind the first number and its complement

static bool is_done(void) {
  uint32_t left = ERASE_AT_MOST;
  while (left > 0 && (FLASH_SR & BUSY)) left--;
  return left > 0 && !(FLASH_SR & FLASH_FAULTS);
}

static bool program(uint32_t sector, uint32_t i, uint32_t value) {
  FLASH_CR = PROGRAM;
  WORD(sector, i) = value;
  const bool good = is_done();
  FLASH_CR = 0;
  return good && WORD(sector, i) == value;
}

// The cache of data does not see that a sector was erased.
static bool erase(uint32_t sector) {
  FLASH_CR = ERASE(FIRST_SECTOR + sector);
  FLASH_CR = ERASE(FIRST_SECTOR + sector) | BEGIN;
  const bool good = is_done();
  FLASH_CR = 0;
  const uint32_t access = FLASH_ACR;
  FLASH_ACR = access & ~CACHE_ON;
  FLASH_ACR = (access & ~CACHE_ON) | CACHE_RESET;
  FLASH_ACR = access;
  return good;
}

static bool begin_sector(uint32_t sector, uint32_t number) {
  return erase(sector) && program(sector, 0, number) &&
         program(sector, 1, ~number);
}

// The first number of a sector; 0 where it has none.
static uint32_t first_of(uint32_t sector) {
  const uint32_t number = WORD(sector, 0);
  return WORD(sector, 1) == ~number ? number : 0;
}

static uint32_t used_of(uint32_t sector) {
  uint32_t used = 0;
  while (used < MARKS && WORD(sector, 2u + used) != FREE) used++;
  return used;
}

// Returns: the next number; 0 where it cannot be kept.
static uint32_t next_number(void) {
  uint32_t sector = first_of(1) > first_of(0);
  if (first_of(sector) == 0) {
    // No start came so far yet, unless something is lost.
    if (used_of(0) > 0 || used_of(1) > 0 || !begin_sector(0, 1)) return 0;
  }
  uint32_t used = used_of(sector);
  if (used == MARKS) {
    const uint32_t next = first_of(sector) + MARKS;
    sector = 1u - sector;
    used = 0;
    if (next > UINT32_MAX - MARKS || !begin_sector(sector, next)) return 0;
  }
  return program(sector, 2u + used, 0) ? first_of(sector) + used : 0;
}

uint32_t port_boot(void) {
  if (FLASH_CR & LOCKED) {
    FLASH_KEYR = 0x45670123u;
    FLASH_KEYR = 0xCDEF89ABu;
  }
  FLASH_SR = FLASH_FAULTS; // of before
  const uint32_t number = next_number();
  FLASH_CR = LOCKED;
  return number;
}
