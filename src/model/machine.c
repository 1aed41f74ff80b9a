// Kinematics and energy of the prepared machine.
#include "twofold/machine.h"

#include "mechanics.h"

TF_API tf_input_t tf_input_default(const tf_machine_t *machine) {
  return (tf_input_t){machine->omega0, machine->r0, 0, 0, 0};
}

TF_API void tf_turntable_to(tf_input_t *input, tf_real_t omega0, tf_real_t dt) {
  input->alpha = (omega0 - input->omega0) / dt;
  input->omega0 = omega0;
}

TF_API tf_slip_t tf_slip(const tf_machine_t *machine, tf_real_t r, tf_real_t v,
                         tf_real_t w, tf_real_t omega0) {
  return slip_speeds(machine, r, v, w - omega0);
}

TF_API tf_status_t tf_speed_for_slip(const tf_machine_t *machine, tf_real_t r,
                                     tf_real_t w, tf_real_t omega0, tf_real_t h,
                                     tf_real_t *v) {
  const tf_real_t z = w - omega0;
  if (!(magnitude(machine->sin_gamma) >= TF_MIN_SINE)) return TF_BAD_STATE;
  *v = machine->d * z - (h + r * z * machine->cos_gamma) / machine->sin_gamma;
  return TF_OK;
}

TF_API tf_real_t tf_energy(const tf_machine_t *machine, const tf_state_t *state,
                           tf_real_t r0) {
  return twice_energy(machine, state->r, state->v, state->w, r0) / 2;
}
