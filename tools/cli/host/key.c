// Only POSIX is used.

#define _DEFAULT_SOURCE

#include "key.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define DIGITS (2 * TF_KEY_BYTES)

const char *cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]) {
  struct stat status;
  FILE *file = fopen(path, "r");
  if (file == NULL) return strerror(errno);
  const bool known = fstat(fileno(file), &status) == 0;
  unsigned digits = 0;
  int next = EOF;
  while ((next = fgetc(file)) != EOF &&
         (digits < DIGITS ? isxdigit(next) : isspace(next))) {
    if (digits == DIGITS) continue;
    const int value = isdigit(next) ? next - '0' : tolower(next) - 'a' + 10;
    const int high = digits % 2 == 0 ? 0 : key[digits / 2];
    key[digits++ / 2] = (uint8_t)(high << 4 | value);
  }
  (void)fclose(file);
  if (known && S_ISDIR(status.st_mode)) return strerror(EISDIR);
  if (!known || (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return "others may read it, or change it: chmod 600";
  return digits == DIGITS && next == EOF
             ? NULL
             : "must hold 32 hexadecimal digits, then only white space";
}
