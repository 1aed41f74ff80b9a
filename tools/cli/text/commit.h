/// @file
/// Of which commit this program is.
#ifndef TWOFOLD_CLI_COMMIT_H
#define TWOFOLD_CLI_COMMIT_H

#include "twofold.h"

/// Its short hash, with "-dirty" behind it where files had been changed, or
/// "unknown" where it was not compiled in a git work tree; then "-" and the
/// checksum of its sources, by cksum.
extern const char *const cli_commit;

#ifdef TF_REAL_FLOAT
#define CLI_NUMBER_TYPE "float"
#else
#define CLI_NUMBER_TYPE "double"
#endif

#endif
