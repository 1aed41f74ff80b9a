/// @file
/// A second integration of the same motion by other means, to judge the
/// reference: state (r, v, w), the mass matrix, Dormand and Prince's pair of
/// orders 5 and 4, events by bisection. It ends where h = g = 0 comes near or
/// A = 0, so that it needs no theory of either.
#ifndef REFERENCE_SECOND_H
#define REFERENCE_SECOND_H

#include "draw.h"

/// Integrates from x = (r, v, w), in place, to the time `end` or as far as it
/// may; returns the time reached and sets the number of events.
real_t ref_second(const ref_machine_t *machine, real_t x[3], real_t end,
                  real_t tolerance, int *events);

#endif
