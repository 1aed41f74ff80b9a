/// @file
/// The summary of a run.
#ifndef TWOFOLD_CLI_SUMMARY_H
#define TWOFOLD_CLI_SUMMARY_H

#include "record.h"

/// Prints it on standard error.
void cli_summary(const cli_run_t *run);

#endif
