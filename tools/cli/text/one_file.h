/// @file
/// Whether two paths are one file, whatever they are called.
#ifndef TWOFOLD_CLI_ONE_FILE_H
#define TWOFOLD_CLI_ONE_FILE_H

#include <stdbool.h>

/// Whether two paths name one regular file, there or not yet; NULL and "-" are
/// none, and what is no regular file (a terminal, /dev/null) may come twice.
bool cli_one_file(const char *one, const char *other);

#endif
