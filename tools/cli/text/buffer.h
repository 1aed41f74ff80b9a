/// Text appended to a buffer of the caller.
#pragma once

#include "message.h"
#include "twofold/real.h"

/// The text always ends with a zero. What does not fit is left out, and
/// truncated is set.
typedef struct {
  char *text;
  size_t used, room;
  bool truncated;
} cli_buffer_t;

void cli_add(cli_buffer_t *buffer, const char *text);

/// Appends a form, in which %s stands for a text, %g for a number of the real
/// type of this program, PRIu64 for a count. There are no other conversions.
void cli_add_form(cli_buffer_t *buffer, const char *form, ...) CLI_PRINTF(2, 3);

void cli_add_real(cli_buffer_t *buffer, tf_real_t value);
void cli_add_count(cli_buffer_t *buffer, uint64_t value);

/// 32 bits as eight hexadecimal digits.
void cli_add_hash(cli_buffer_t *buffer, uint32_t value);

/// A float (is_float) or a double, whichever type this program was built for.
void cli_add_number(cli_buffer_t *buffer, double value, bool is_float);

/// Makes room for one more in a list from the heap, of `used` members of `size`
/// bytes each. room: in/out, members that it has room for.
/// Returns: the list, which may have moved; NULL: no memory, it is as it was.
void *cli_grow(void *list, size_t used, size_t *room, size_t size);
