/// @file
/// The compensated step: tf_step with the rounding of its state kept, as in
/// compensated summation. At dt = 1e-6 s a step changes the state by less than
/// the resolution of a float; this one keeps what a plain step then loses
/// as the compensation, and adds it in the next. A program that
/// does not call it does not contain it.
#ifndef TWOFOLD_COMPENSATED_H
#define TWOFOLD_COMPENSATED_H

#include "twofold/step.h"

TF_BEGIN_C

/// What the rounding of a tf_state_t has left out: the machine is at state +
/// compensation. 0 after tf_begin, or the remainder of a more precise start.
typedef struct {
  tf_real_t r, v, w; ///< [m], [m/s], [rad/s]
  tf_real_t phi;     ///< [rad], 0 unless with_angle
} tf_compensation_t;

/// A machine, and what rounding has left out of its constants.
typedef struct {
  tf_machine_t machine;                   ///< for every other function
  tf_real_t low_sin_gamma, low_cos_gamma; ///< sin(gamma) - machine.sin_gamma
  tf_real_t low_inertia;                  ///< of machine.inertia [kg m^2]
} tf_compensated_t;

/// tf_prepare for the compensated step; arguments and codes as there.
#define tf_prepare_compensated TF_LINK(tf_prepare_compensated)
TF_API tf_status_t tf_prepare_compensated(tf_compensated_t *machine,
                                          const tf_params_t *params,
                                          int *offender);

/// Speed v for a given lateral slip speed h at (r, w), as precise as the
/// compensated step: with tf_speed_for_slip the start would miss h by the
/// rounding of v, which the first step would correct by an impulse of friction.
/// machine: in. omega0 [rad/s], h [m/s]: in.
/// state, compensation: in/out; r, w are read, v is set [m/s].
/// Returns: TF_OK; TF_BAD_STATE where |sin(gamma)| < TF_MIN_SINE (nothing
///   touched).
#define tf_speed_for_slip_compensated TF_LINK(tf_speed_for_slip_compensated)
TF_API tf_status_t tf_speed_for_slip_compensated(
    const tf_compensated_t *machine, tf_state_t *state,
    tf_compensation_t *compensation, tf_real_t omega0, tf_real_t h);

/// tf_step with the rounding of r, v, w and phi compensated: the slip at the
/// start of the step is that of state + compensation, and the changes of p and
/// z, refined once by the residual of (6), are added in pairs of tf_real_t. F
/// and M of a slip are as precise as tf_real_t, which limits float under JUMP.
/// machine, input: in. state: in/out, from tf_begin. compensation: in/out.
/// report: out; slip and residual are those of state + compensation.
/// Returns: as tf_step; where it refuses, state and compensation are untouched.
/// Trust: TF_OK promises the same as in tf_step.
#define tf_step_compensated TF_LINK(tf_step_compensated)
TF_API tf_status_t tf_step_compensated(const tf_compensated_t *machine,
                                       tf_state_t *state,
                                       tf_compensation_t *compensation,
                                       const tf_input_t *input,
                                       tf_report_t *report);

TF_END_C

#endif
