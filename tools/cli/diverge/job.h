/// @file
/// What all samples of `diverge` share.
#ifndef TWOFOLD_CLI_JOB_H
#define TWOFOLD_CLI_JOB_H

#include "../setup/args.h"
#include "../setup/setup.h"
#include "../text/buffer.h"
#include "canard.h"
#include "diverge.h"

typedef struct {
  const cli_args_t *args;
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
int cli_job_prepare(cli_job_t *job, const cli_args_t *args);

/// Room for what cli_job_describe writes.
#define CLI_JOB_TEXT 1024

/// Writes what the rows of all samples follow from: version, machine, start and
/// options. It is the same in all shards of a run.
void cli_job_describe(const cli_job_t *job, cli_buffer_t *text);

/// What the rows are of, as the comment lines of --provenance. units: in, of
/// the columns.
size_t cli_job_provenance(const cli_job_t *job, const char *units,
                          char out[CLI_PROVENANCE_ROOM]);

#endif
