/// @file
/// What a step is told of inputs that move.
#ifndef REFERENCE_TOLD_H
#define REFERENCE_TOLD_H

#include "machine.h"
#include "reference.h"

/// What a step is told: omega0 at its end, the mean of its slope between jumps,
/// and mean loads.
typedef struct {
  double omega0, alpha, force, torque;
} told_t;
/// From a time to another; of an empty span the values and the slope behind it.
told_t moving_told(const lib_machine_t *machine, double from, double to);

/// What `steps` steps of a machine's dt are told, as inputs of the reference:
/// straight within a step, a jump at its start where one lies in it. Writes up
/// to `most` knots; returns how many, or 0 where they are more.
int moving_table(const lib_machine_t *machine, long steps, ref_knot_t *table,
                 int most);

#endif
