// Appending to a buffer. Numbers are the shortest decimals that read back to
// the same bits.

#include "buffer.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "number.h"

void cli_add(cli_buffer_t *buffer, const char *text) {
  const size_t length = strlen(text);
  if (length >= buffer->room - buffer->used) {
    buffer->truncated = true;
    return;
  }
  memcpy(buffer->text + buffer->used, text, length + 1);
  buffer->used += length;
}

void cli_add_real(cli_buffer_t *buffer, tf_real_t value) {
  char digits[CLI_REAL_ROOM];
  (void)cli_write_real(digits, value);
  cli_add(buffer, digits);
}

void cli_add_number(cli_buffer_t *buffer, double value, bool is_float) {
  char digits[CLI_REAL_ROOM];
  (void)cli_write_number(digits, value, is_float);
  cli_add(buffer, digits);
}

void cli_add_count(cli_buffer_t *buffer, uint64_t value) {
  char digits[CLI_REAL_ROOM];
  (void)snprintf(digits, sizeof digits, "%" PRIu64, value);
  cli_add(buffer, digits);
}
