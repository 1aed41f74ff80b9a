#include "key.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static int digit_of(int character) {
  static const char digits[] = "0123456789abcdef";
  const char *at = memchr(digits, tolower(character), 16);
  return at == NULL ? -1 : (int)(at - digits);
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
