/// @file
/// What all samples of `diverge` share.
#ifndef TWOFOLD_CLI_JOB_H
#define TWOFOLD_CLI_JOB_H

#include "../setup/setup.h"
#include "canard.h"
#include "diverge_args.h"

typedef struct {
  const cli_diverge_args_t *args;
  cli_setup_t setup;
  cli_two_fold_t two_fold;
  cli_canard_t canard;  ///< through the two-fold
  bool at_two_fold;     ///< the samples start there
  double dt;            ///< [s]
  double rate;          ///< of exits [1/s]
  tf_params_t params;   ///< of `machine`
  tf_machine_t machine; ///< its rule never leaves an escaping stick
} cli_job_t;

/// Prepares the machine, the two-fold and the start of all samples.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_job_prepare(cli_job_t *job, const cli_diverge_args_t *args);

#endif
