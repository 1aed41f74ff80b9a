// How a scene starts, and its inputs over time.
#include "twofold/scene.h"

#include "../num/rounding.h"

static tf_real_t speed_at(const tf_scene_t *scene, tf_real_t t) {
  const tf_knot_t *knot = scene->profile;
  int i = 0;
  while (i + 1 < scene->knots && knot[i + 1].t <= t) i++;
  tf_real_t speed = knot[i].omega0;
  if (i + 1 < scene->knots && t > knot[i].t)
    speed += (knot[i + 1].omega0 - knot[i].omega0) *
             ((t - knot[i].t) / (knot[i + 1].t - knot[i].t));
  return speed;
}

TF_API tf_input_t tf_scene_input(const tf_scene_t *scene,
                                 const tf_machine_t *machine, tf_real_t t) {
  tf_input_t input = tf_input_default(machine);
  if (scene->knots == 0) return input;
  const tf_real_t dt = machine->dt;
  input.omega0 = speed_at(scene, t);
  input.alpha = (input.omega0 - speed_at(scene, t - dt)) / dt;
  return input;
}

TF_API tf_status_t tf_scene_start(const tf_scene_t *scene,
                                  const tf_machine_t *machine, uint32_t seed,
                                  tf_state_t *state, tf_report_t *report) {
  const tf_input_t input = tf_scene_input(scene, machine, 0);
  tf_state_t start = {.r = scene->r,
                      .v = scene->v,
                      .w = scene->omega,
                      .seed = seed,
                      .mode = TF_NO_MODE};
  const tf_status_t status =
      scene->v_is_given
          ? tf_begin(machine, &start, &input, report)
          : tf_begin_with_slip(machine, &start, &input, scene->h, report);
  if (status == TF_OK) *state = start;
  return status;
}
