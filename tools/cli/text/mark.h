/// @file
/// The mark of UTF-8 by which Windows programs begin a text file.
#ifndef TWOFOLD_CLI_MARK_H
#define TWOFOLD_CLI_MARK_H

#include <stddef.h>

/// Its length where a file begins with it, else 0.
/// text: in, size bytes, the first ones of the file.
size_t cli_utf8_mark(const char *text, size_t size);

#endif
