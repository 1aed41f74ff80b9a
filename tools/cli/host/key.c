#include "key.h"

#include <ctype.h>
#include <stdio.h>

static int digit_of(int character) {
  if (!isxdigit(character)) return -1;
  return isdigit(character) ? character - '0' : tolower(character) - 'a' + 10;
}

bool cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]) {
  FILE *file = fopen(path, "r");
  bool good = file != NULL;
  for (size_t i = 0; good && i < TF_KEY_BYTES; i++) {
    const int high = digit_of(fgetc(file)), low = digit_of(fgetc(file));
    good = high >= 0 && low >= 0;
    key[i] = (uint8_t)(high * 16 + low);
  }
  int rest = ' ';
  while (good && isspace(rest)) rest = fgetc(file);
  if (file != NULL) (void)fclose(file);
  return good && rest == EOF;
}
