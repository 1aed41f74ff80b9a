/// @file
/// The stepper of --by random, and single branches of --exhaustive.
#ifndef TWOFOLD_CLI_RANDOM_H
#define TWOFOLD_CLI_RANDOM_H

#include "motion.h"

extern const cli_stepper_t cli_random_stepper;

/// Where a branch ends.
typedef enum {
  CLI_BRANCH_TWO_FOLD,
  CLI_BRANCH_CODIM2,   ///< at h = g = 0 with several consistent modes
  CLI_BRANCH_ESCAPING, ///< in an escaping stick
  CLI_BRANCH_TIME      ///< the time is up, or a step was refused
} cli_branch_t;

/// Goes from motion->state in a given mode to the next point where several
/// modes are consistent.
/// set: out, the modes that are consistent there.
cli_branch_t cli_random_branch(cli_motion_t *motion, unsigned mode,
                               unsigned *set);

#endif
