/// @file
/// How far the steps of a run can be trusted, counted by status.
///
/// TF_OK means: every consistent mode of the step was found and reported, the
/// one that the declared rule takes was taken, and the state at its end obeys
/// the law to the rounding of its type. What a step does not keep of that it
/// says in its status, and a program counts it here, in one struct that holds
/// the answer for all steps since the start:
///
///   tf_tally_count(&session.tally, session.state.tick,
///                  tf_step(&session.machine, &session.state, &input,
///                          &session.report));
#ifndef TWOFOLD_TALLY_H
#define TWOFOLD_TALLY_H

#include <stdint.h>

#include "twofold/status.h"

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
/// Cost: at most 33 instructions. Stack: 80 B.
/// Memory: caller's, reentrant.
/// Claims: tally_counts_every_status
#define tf_tally_count TF_LINK(tf_tally_count)
TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status);

#endif
