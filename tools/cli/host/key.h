/// @file
/// The key of a board that takes only tagged commands, from a file: an argument
/// would stand in the list of processes.
#ifndef TWOFOLD_CLI_KEY_H
#define TWOFOLD_CLI_KEY_H

#include <stdbool.h>

#include "twofold.h"

/// Reads 32 hexadecimal digits, with nothing behind them but white space.
/// Returns: whether the file has them.
bool cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]);

#endif
