/// @file
/// The steps of a run that were not TF_OK, counted by status, in one struct for
/// all steps since the start. A report says so of its own step alone:
///
///   tf_tally_count(&simulation.tally, simulation.state.tick,
///                  tf_step(&simulation.machine, &simulation.state, &input,
///                          &simulation.report));
///
/// A count of 0 says that no step found a reason to be flagged, and not that
/// none was wrong: docs/VERIFICATION.md ("An independent reference") has the
/// rates of steps that are wrong and say TF_OK.
#ifndef TWOFOLD_TALLY_H
#define TWOFOLD_TALLY_H

#include <stdint.h>

#include "twofold/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Steps that did not return TF_OK. All zero at the start.
typedef struct {
  uint64_t degraded;  ///< TF_DEGRADED
  uint64_t fell_back; ///< TF_FELL_BACK
  uint64_t coarse;    ///< TF_COARSE
  uint64_t refused;   ///< negative codes: the state stood still
  uint64_t first;     ///< tick of the first of all these, if there is one
} tf_tally_t;

/// Counts one step.
/// Scheme: none.
/// tally: in/out. tick: in, of the state after the step. status: in, of it.
/// Returns: nothing.
/// Cost: at most 34 instructions. Stack: 80 B.
/// Memory: caller's, reentrant.
/// Claims: tally_counts_every_status
#define tf_tally_count TF_LINK(tf_tally_count)
TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status);

#ifdef __cplusplus
}
#endif

#endif
