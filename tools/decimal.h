/// @file
/// Numbers as text, on a host: the command line and the FMU write them so.
#ifndef TWOFOLD_DECIMAL_H
#define TWOFOLD_DECIMAL_H

#include <stdbool.h>
#include <stddef.h>

/// Room for any number with its terminating zero.
#define DECIMAL_ROOM 40

/// Writes the shortest decimal that reads back to the same bits, of a float
/// (is_float) or a double; or nan, inf, -inf.
/// out: out, zero-terminated. Returns: the length without the zero.
size_t decimal_write(char out[DECIMAL_ROOM], double value, bool is_float);

#endif
