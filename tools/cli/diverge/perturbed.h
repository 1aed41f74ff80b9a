/// @file
/// The stepper of --by noise and --by smoothing.
#ifndef TWOFOLD_CLI_PERTURBED_H
#define TWOFOLD_CLI_PERTURBED_H

#include "motion.h"

extern const cli_stepper_t cli_perturbed_stepper;

#endif
