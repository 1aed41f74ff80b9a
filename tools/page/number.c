// Numbers from text for the page, read by the reader of the command line, so
// that an address, a field and an option mean the same bits.
#include "cli/text/number.h"

#include <string.h>

#include "module.h"

#define ROOM 1024 // beyond any number that people or programs write
static char text[ROOM];
static double taken;

// Where the page puts the text of a number, zero-terminated.
char *EXPORT(number_text)(void) { return text; }

uint32_t EXPORT(number_room)(void) { return ROOM; }

// Reads a number from so many bytes. Returns: what is wrong with them, or
// nothing; then `number_value` is the number.
const char *EXPORT(number_take)(uint32_t length) {
  const char *why = "is not a number";
  if (length >= ROOM || strlen(text) != length) return why;
  return cli_read_real(text, &taken, &why) ? "" : why;
}

double EXPORT(number_value)(void) { return taken; }
