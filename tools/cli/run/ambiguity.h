/// @file
/// How often a motion has several consistent modes, and since when: at its
/// start, which is no step, and in its steps.
#ifndef TWOFOLD_CLI_AMBIGUITY_H
#define TWOFOLD_CLI_AMBIGUITY_H

#include "twofold.h"

typedef struct {
  unsigned start; ///< consistent modes at the start, 0: not seen
  uint64_t steps; ///< with several of them
  double since;   ///< [s], NaN: at no time so far
} cli_ambiguity_t;

/// Begins. start: in, the report of the start, NULL where the motion goes on
/// from another one.
void cli_ambiguity_begin(cli_ambiguity_t *ambiguity, const tf_report_t *start);

/// Sees a step. t: its end [s].
void cli_ambiguity_see(cli_ambiguity_t *ambiguity, const tf_report_t *report,
                       double t);

#endif
