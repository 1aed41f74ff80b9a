/// @file
/// Text that grows in a buffer of the caller: rows and JSON.
#ifndef TWOFOLD_CLI_BUFFER_H
#define TWOFOLD_CLI_BUFFER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold/real.h"

/// What does not fit is left out and noticed; the text ends with a zero.
typedef struct {
  char *text;
  size_t used, room;
  bool cut;
} cli_buffer_t;

void cli_add(cli_buffer_t *buffer, const char *what);
void cli_add_real(cli_buffer_t *buffer, tf_real_t value);
void cli_add_count(cli_buffer_t *buffer, uint64_t value);

/// A number of the type that is_float says, whatever the program was built for.
void cli_add_number(cli_buffer_t *buffer, double value, bool is_float);

#endif
