/// @file
/// `diverge --exhaustive`: all branches instead of samples.
#ifndef TWOFOLD_CLI_EXHAUSTIVE_H
#define TWOFOLD_CLI_EXHAUSTIVE_H

#include "job.h"

/// Follows all branches and writes them. Returns: the exit code.
int cli_exhaustive(const cli_job_t *job);

#endif
