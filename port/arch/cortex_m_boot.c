// port_boot for an emulator: a count of starts in a file of the computer that
// runs it, by semihosting. It stands in for the flash of a chip, to show what a
// board does that has some; nobody locks the file, or sees to it that it stays.
// Without a debugger the first call is a fault, which ends the program.
#include "../port.h"
#include "cortex_m.h"

#define FILE_NAME "twofold.boot"

enum { OPEN = 1, CLOSE = 2, WRITE = 5, READ = 6, SEEK = 10, LENGTH = 12 };
enum { MODE_UPDATE = 3, MODE_CREATE = 7 };

static uint32_t call(uint32_t what, uint32_t a, uint32_t b, uint32_t c) {
  const uint32_t block[3] = {a, b, c};
  register uint32_t operation __asm__("r0") = what;
  register const uint32_t *argument __asm__("r1") = block;
  __asm__ volatile("bkpt 0xAB" : "+r"(operation) : "r"(argument) : "memory");
  return operation;
}

static uint32_t open_file(uint32_t mode) {
  static const char name[] = FILE_NAME;
  return call(OPEN, (uint32_t)name, mode, sizeof name - 1);
}

uint32_t port_boot(void) {
  uint32_t count = 0, file = open_file(MODE_UPDATE);
  if (file == UINT32_MAX) file = open_file(MODE_CREATE);
  if (file == UINT32_MAX) return 0;
  const uint32_t at = (uint32_t)&count, length = call(LENGTH, file, 0, 0);
  bool good = length == 0 || (length == 4 && call(READ, file, at, 4) == 0);
  count++;
  good = good && call(SEEK, file, 0, 0) == 0 && call(WRITE, file, at, 4) == 0;
  good = call(CLOSE, file, 0, 0) == 0 && good;
  return good ? count : 0;
}
