/// The controller of the demonstration: it computes the inputs of the board
/// from a state. To try another controller, change this file. It uses only
/// + - * and comparisons, which give the same bits on every host.
#pragma once

#include "twofold.h"

typedef struct {
  tf_real_t speed; ///< set point of the disc's speed [rad/s]
  tf_real_t gain;  ///< of the turntable's speed, dimensionless
  tf_real_t brake; ///< torque over speed while the disc is too fast [N m s]
} hil_control_t;

/// Drives the turntable in proportion to the error of the disc's speed, and
/// brakes the disc where it turns faster than the set point. The turntable is
/// put to each speed by a jump, alpha = 0; one that is to move there within the
/// step has alpha = (omega0 - its last value)/dt (tf_turntable_to).
static inline tf_input_t hil_control(const hil_control_t *control,
                                     const tf_machine_t *machine,
                                     const tf_state_t *x) {
  const tf_real_t error = control->speed - x->w;
  tf_input_t input = tf_input_default(machine);
  input.omega0 += control->gain * error;
  if (x->w * x->w > control->speed * control->speed)
    input.torque = -control->brake * x->w;
  return input;
}
