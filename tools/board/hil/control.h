/// The controller of the demonstration: it computes the inputs of the board
/// from a state. To try another controller, change this file. It uses only
/// + - * and comparisons, which give the same bits on every host.
#pragma once

#include "twofold.h"

#define HIL_SPEED TF_R(-0.9) ///< set point of the disc's speed [rad/s]
#define HIL_GAIN TF_R(0.1)   ///< of the turntable's speed, dimensionless
/// Torque over speed while the disc is too fast [N m s].
#define HIL_BRAKE TF_R(0.2)

/// Drives the turntable in proportion to the error of the disc's speed, and
/// brakes the disc where it turns faster than the set point. The turntable is
/// put to each speed by a jump, alpha = 0; one that is to move there within the
/// step has alpha = (omega0 - its last value)/dt (tf_turntable_to).
static inline tf_input_t hil_control(const tf_machine_t *machine,
                                     const tf_state_t *x) {
  const tf_real_t error = HIL_SPEED - x->w;
  tf_input_t input = tf_input_default(machine);
  input.omega0 += HIL_GAIN * error;
  if (x->w * x->w > HIL_SPEED * HIL_SPEED) input.torque = -HIL_BRAKE * x->w;
  return input;
}
