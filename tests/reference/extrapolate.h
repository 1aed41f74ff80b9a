/// Steps by extrapolation of the midpoint rule (Gragg, Bulirsch, Stoer): it has
/// no table of coefficients, so it is as exact as its numbers.
#ifndef REFERENCE_EXTRAPOLATE_H
#define REFERENCE_EXTRAPOLATE_H

#include "reference.h"

/// How a state changes, in the time of the step.
typedef ref_state_t (*ref_slope_t)(void *context, ref_state_t x);
/// Takes a step of this length; returns what is watched at its end.
typedef ref_real_t (*ref_after_t)(void *context, ref_real_t length,
                                  ref_state_t *end);

/// Columns of the table that suit a tolerance; the order is twice that.
int ref_columns(ref_real_t tolerance);
/// One step of length H from x. coarser: out, the same by a column less.
ref_state_t ref_extrapolate(ref_slope_t slope, void *context, ref_state_t x,
                            ref_real_t H, int columns, ref_state_t *coarser);
/// What to multiply the length of a step with whose error is e tolerances; NaN
/// is an error that is too large.
ref_real_t ref_step_factor(ref_real_t e, int columns);
/// Length of the step at whose end what is watched crosses 0, by the Illinois
/// form of false position; it is positive at `low`. at: out, that end.
ref_real_t ref_locate(ref_after_t after, void *context, ref_real_t low,
                      ref_real_t high, ref_state_t *at);

#endif
