/// @file
/// The controller of the demonstration: what is computed from a state that was
/// read, and goes back to the board as inputs. To try another, this is the file
/// to change. Only + - * and comparisons: the same bits on every host.
#ifndef TWOFOLD_HIL_CONTROL_H
#define TWOFOLD_HIL_CONTROL_H

#include "twofold.h"

typedef struct {
  tf_real_t speed; ///< wished of the disc [rad/s]
  tf_real_t gain;  ///< of the turntable's speed, dimensionless
  tf_real_t brake; ///< torque over speed while the disc is too fast [N m s]
} hil_control_t;

/// Drives the turntable in proportion to what the disc's speed lacks, and
/// brakes the disc where it turns faster than is wished.
static inline tf_input_t hil_control(const hil_control_t *control,
                                     const tf_machine_t *machine,
                                     const tf_state_t *x) {
  const tf_real_t lacks = control->speed - x->w;
  tf_input_t input = tf_input_default(machine);
  input.omega0 += control->gain * lacks;
  if (x->w * x->w > control->speed * control->speed)
    input.torque = -control->brake * x->w;
  return input;
}

#endif
