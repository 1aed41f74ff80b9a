/// The key of a board that takes only tagged commands, from a file: an argument
/// would stand in the list of processes. `monitor`, `hil` and `make firmware`
/// read it by this function alone.
#pragma once

#include "twofold.h"

/// Reads 32 hexadecimal digits, with nothing behind them but white space: their
/// line may end as any editor ends it. The file's owner alone may read it.
/// Returns: NULL; or what is wrong with the file.
const char *cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]);
