// A step beside two halves of it: how far both ends lie apart is the estimate
// of its error. Nothing that one step has by itself tells a step that is too
// long from one that is not (docs/SCHEMES.md has what was tried).
#include "../model/mechanics.h"
#include "twofold/step.h"

// The end of two halves. The draw of a random exit is that of the whole step:
// set_step_length() keeps its chance, and both halves have the tick of the
// step. False where one is refused.
static bool halve(const tf_machine_t *k, const tf_input_t *input,
                  tf_state_t *state) {
  const uint64_t tick = state->tick;
  tf_machine_t half = *k;
  tf_input_t first = *input;
  tf_report_t report;
  set_step_length(&half, k->dt / 2);
  first.omega0 -= input->alpha * half.dt;
  if (tf_step(&half, state, &first, &report) < TF_OK) return false;
  state->tick = tick;
  return tf_step(&half, state, input, &report) >= TF_OK;
}

// |p| + R |z| of a velocity.
static tf_real_t size_of_velocity(const tf_machine_t *k, tf_real_t R,
                                  tf_real_t v, tf_real_t z) {
  return magnitude(slider_speed(k, v, z)) + R * magnitude(z);
}

static tf_real_t difference(const tf_machine_t *k, const tf_input_t *input,
                            const tf_state_t *start, const tf_state_t *whole,
                            const tf_state_t *halves) {
  const tf_real_t R = square_root(gyration2_at(k, whole->r));
  const tf_real_t omega0 = input->omega0;
  const tf_real_t size =
      size_of_velocity(k, R, start->v,
                       start->w - (omega0 - input->alpha * k->dt)) +
      size_of_velocity(k, R, whole->v - start->v, whole->w - start->w);
  const tf_real_t apart =
      size_of_velocity(k, R, whole->v - halves->v, whole->w - halves->w) +
      magnitude(whole->r - halves->r) / k->dt;
  // r is known to half of its last digit at both ends.
  const tf_real_t rounding =
      slip_rounding(k, whole->r, whole->v, whole->w, omega0) +
      TF_REAL_EPSILON * magnitude(whole->r) / k->dt;
  return apart > rounding ? (apart - rounding) / size : 0;
}

TF_API tf_status_t tf_step_estimated(const tf_machine_t *machine,
                                     tf_state_t *state, const tf_input_t *input,
                                     tf_real_t accuracy, tf_report_t *report,
                                     tf_real_t *error) {
  const tf_state_t start = *state;
  const tf_status_t status = tf_step(machine, state, input, report);
  *error = 0;
  if (status < TF_OK) return status;
  tf_state_t halves = start;
  *error = halve(machine, input, &halves)
               ? difference(machine, input, &start, state, &halves)
               : TF_REAL_MAX;
  // Written so that an error that is not a number counts as too large.
  if (!(*error <= accuracy) && status == TF_OK) report->status = TF_COARSE;
  return report->status;
}
