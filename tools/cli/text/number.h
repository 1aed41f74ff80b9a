/// Numbers in and out of text.
#pragma once

#include "twofold/real.h"

/// Reads the whole text as one number, rounded once to tf_real_t: decimal, C's
/// hexadecimal, nan or inf. Whether it lies in its range is checked later.
/// why: out on failure, what is wrong with the text ("is not a number").
/// Returns: whether value was set.
bool cli_read_real(const char *text, tf_real_t *value, const char **why);

/// Reads the whole text as a decimal integer in [low, high].
/// Returns: whether value was set.
bool cli_read_whole(const char *text, uint64_t low, uint64_t high,
                    uint64_t *value);

/// Room for any tf_real_t in decimal, with its terminating zero.
#define CLI_REAL_ROOM 40

/// Writes the shortest decimal that reads back to the same bits.
/// out: out, zero-terminated. value: in, finite.
/// Returns: the length without the zero.
size_t cli_write_real(char out[CLI_REAL_ROOM], tf_real_t value);

/// The same for a float (is_float) or a double, whichever type this program was
/// built for.
size_t cli_write_number(char out[CLI_REAL_ROOM], double value, bool is_float);

/// "must lie in [low, high] unit", without a unit of "1".
/// Returns: the text, which the next call writes over.
const char *cli_must_lie(double low, double high, const char *unit);

/// A value, or N of them from A to B, both included.
typedef struct {
  const char *text; ///< as typed, NULL: not given
  double from, to;  ///< of tf_real_t, or exact
  uint64_t count;
} cli_range_t;

/// Reads a number that stands in the value `whole` of an option; both: in, for
/// the message.
int cli_read_number(const char *option, const char *whole, const char *text,
                    tf_real_t *value);

/// Reads A:B:N, N in [1, most], from text. option, whole: in, for messages.
/// exact: in, of whole numbers that a float may not have.
int cli_read_range(const char *option, const char *whole, const char *text,
                   uint64_t most, bool exact, cli_range_t *range);

/// Value i of a range, i in [0, count - 1]: A and B themselves at its ends.
double cli_range_at(const cli_range_t *range, uint64_t i);
