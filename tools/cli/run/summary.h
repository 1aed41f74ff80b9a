/// @file
/// The summary of a run.
#ifndef TWOFOLD_CLI_SUMMARY_H
#define TWOFOLD_CLI_SUMMARY_H

#include "record.h"

/// Prints it on standard error; json: as cli_summary_json does, after the
/// reason of an early end. code: in, the exit code.
void cli_summary(const cli_run_t *run, bool json, int code);

#endif
