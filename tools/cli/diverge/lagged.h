/// @file
/// The stepper of --by hysteresis and --by delay.
#ifndef TWOFOLD_CLI_LAGGED_H
#define TWOFOLD_CLI_LAGGED_H

#include "motion.h"

extern const cli_stepper_t cli_lagged_stepper;

#endif
