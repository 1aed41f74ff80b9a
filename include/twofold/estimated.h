/// @file
/// A step that says how far it is off. TF_OK of tf_step excludes causes of a
/// wrong step that are known by their symptoms; it does not bound the error of
/// a step that is merely too long. This one is taken twice, whole and in
/// halves, at three times the cost. A program that does not call it contains
/// none of it.
#ifndef TWOFOLD_ESTIMATED_H
#define TWOFOLD_ESTIMATED_H

#include "twofold/step.h"

TF_BEGIN_C

/// tf_step, to the bit, and beside it two steps of dt/2 from the same state.
/// machine, input: in. state: in/out, from tf_begin. report: out.
/// accuracy: in, the largest error that is OK, dimensionless.
/// error: out; by how much the two ends differ, in p = v - d z, R z and r/dt,
///   as a share of |p| + R |z| and of their change in the step, with R^2 =
///   beta^2 + r^2: what `tolerance` of the located step is a share of. What
///   rounding may make of it is taken off. TF_REAL_MAX where a half is refused,
///   0 where the step is.
/// Returns: as tf_step; TF_COARSE too where error > accuracy. Under rule RANDOM
///   one draw decides the step and its halves.
/// Trust: an estimate, of the end that the halves do not share with the step;
///   what it sees and what it does not: docs/SCHEMES.md, "An estimate".
#define tf_step_estimated TF_LINK(tf_step_estimated)
TF_API tf_status_t tf_step_estimated(const tf_machine_t *machine,
                                     tf_state_t *state, const tf_input_t *input,
                                     tf_real_t accuracy, tf_report_t *report,
                                     tf_real_t *error);

TF_END_C

#endif
