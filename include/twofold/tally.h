/// @file
/// The steps of a run that were not TF_OK, counted by status since its start
/// (simulation.h shows the call). A count of 0 says that no step was flagged,
/// and not that none was wrong: docs/VERIFICATION.md has the rates of wrong
/// steps that say TF_OK.
#ifndef TWOFOLD_TALLY_H
#define TWOFOLD_TALLY_H

#include "twofold/status.h"

TF_BEGIN_C

/// Steps that did not return TF_OK. All zero at the start.
typedef struct {
  uint64_t degraded;  ///< TF_DEGRADED
  uint64_t fell_back; ///< TF_FELL_BACK
  uint64_t coarse;    ///< TF_COARSE
  uint64_t stalled;   ///< TF_STALLED
  uint64_t refused;   ///< negative codes: the state is untouched
  uint64_t first;     ///< tick of the first of all these, if there is one
} tf_tally_t;

/// Counts one step.
/// tally: in/out. tick: in, of the state after the step. status: in, of it.
#define tf_tally_count TF_LINK(tf_tally_count)
TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status);

TF_END_C

#endif
