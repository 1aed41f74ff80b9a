// The one file that is compiled again with every commit; TF_COMMIT is a flag of
// the Makefile.

#include "text.h"

#ifndef TF_COMMIT
#define TF_COMMIT "unknown"
#endif

const char *const cli_commit = TF_COMMIT;
