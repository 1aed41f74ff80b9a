/// @file
/// What the commands share that examine a machine without running it:
/// singularities, regions, design and atlas.
#ifndef TWOFOLD_CLI_ANALYSIS_H
#define TWOFOLD_CLI_ANALYSIS_H

#include "../host/output.h"
#include "../setup/args.h"
#include "../setup/setup.h"

/// One of the commands, ready to compute and write.
typedef struct {
  const cli_args_t *args;
  cli_setup_t setup; ///< machine and input at t = 0
  cli_output_t output;
} cli_analysis_t;

/// Prepares the machine. finds_kappa: the command computes kappa, so a scene
/// without kappa is not refused.
int cli_analysis_begin(cli_analysis_t *a, const cli_args_t *args,
                       bool finds_kappa);

#endif
