/// @file
/// The summary of a run for programs.
#ifndef TWOFOLD_CLI_SUMMARY_JSON_H
#define TWOFOLD_CLI_SUMMARY_JSON_H

#include "record.h"

/// Prints it on standard error, as one line. code: in, the exit code.
void cli_summary_json(const cli_run_t *run, int code);

#endif
