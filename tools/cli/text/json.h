/// @file
/// Members of an object of JSON on standard error, for summaries: each with its
/// comma, but the last.
#ifndef TWOFOLD_CLI_JSON_H
#define TWOFOLD_CLI_JSON_H

#include <stdbool.h>
#include <stdint.h>

#include "twofold/real.h"

/// A number without a comma after it, in the digits of a float (is_float) or of
/// a double; null where it is not finite.
void cli_put_number(const char *key, double value, bool is_float);

/// The same with a comma: of the number type of this program, or a double.
void cli_put_real(const char *key, tf_real_t value);
void cli_put_double(const char *key, double value);

/// What is not known.
void cli_put_null(const char *key);

void cli_put_count(const char *key, uint64_t value);

/// 32 bits as eight hexadecimal digits in quotes.
void cli_put_hash(const char *key, uint32_t value);

/// A word of this program, without a character that JSON escapes.
void cli_put_word(const char *key, const char *word);

/// The member by which every summary ends, the brace and a newline.
/// code: in, the exit code.
void cli_put_exit(int code);

/// Whether a summary was written.
bool cli_put_ended(void);

/// Text from outside: the path of a file, what a board says of itself.
void cli_put_text(const char *key, const char *text);

#endif
