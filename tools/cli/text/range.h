/// @file
/// Evenly spaced values, as typed: A:B:N.
#ifndef TWOFOLD_CLI_RANGE_H
#define TWOFOLD_CLI_RANGE_H

#include <stdint.h>

#include "twofold/real.h"

/// A value, or N of them from A to B, both included.
typedef struct {
  const char *text; ///< as typed, NULL: not given
  tf_real_t from, to;
  uint64_t count;
} cli_range_t;

/// Reads A:B:N, N in [1, most]; A and B may be any numbers. option, whole: in,
/// for messages. text: in, A:B:N, whole or the end of it.
int cli_read_range(const char *option, const char *whole, const char *text,
                   uint64_t most, cli_range_t *range);

/// Value i of a range, i in [0, count - 1]: A and B themselves at its ends.
tf_real_t cli_range_at(const cli_range_t *range, uint64_t i);

#endif
