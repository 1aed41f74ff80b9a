/// What all samples of `diverge` share.
#pragma once

#include "../setup/args.h"
#include "../text/text.h"
#include "canard.h"

// What selects the exit of a motion whose future is not unique.

typedef enum {
  CLI_BY_RANDOM, ///< a draw: exit at a rate, to either side
  CLI_BY_NOISE   ///< additive white noise on h
} cli_mechanism_t;
extern const char *const cli_mechanisms[]; ///< their names

/// What --by random does where the wheel comes to h = g = 0.
typedef enum {
  CLI_CODIM2_REST,       ///< pinned where that is consistent, as in `run`
  CLI_CODIM2_ATTRACTING, ///< the attracting stick where there is one: `persist`
  CLI_CODIM2_EVEN        ///< draws one of the consistent modes, all equally
} cli_codim2_choice_t;

typedef struct {
  const cli_args_t *args;
  cli_setup_t setup;
  cli_two_fold_t two_fold;
  cli_canard_t canard;  ///< through the two-fold
  bool at_two_fold;     ///< the samples start there
  double refinement;    ///< dt / step near the two-fold
  double near;          ///< step near the two-fold, of random ones in slip [s]
  tf_params_t params;   ///< of `machine`
  tf_machine_t machine; ///< its rule never leaves an escaping stick
} cli_job_t;

/// Prepares the machine, the two-fold and the start of all samples.
int cli_job_prepare(cli_job_t *job, const cli_args_t *args);

/// Writes what the rows follow from: program, machine, start and options.
void cli_job_describe(const cli_job_t *job, cli_buffer_t *text);

/// What the rows are of, as the comment lines of --provenance. units: in, of
/// the columns.
size_t cli_job_provenance(const cli_job_t *job, const char *units,
                          char out[CLI_PROVENANCE_ROOM]);
