// A running scene: machine, state and inputs tick by tick.
#include "twofold/simulation.h"

#include <stddef.h>

TF_API tf_status_t tf_simulation_start(tf_simulation_t *simulation,
                                       const tf_scene_t *scene, uint32_t seed) {
  const tf_status_t status =
      tf_scene_start(scene, &simulation->machine, seed, &simulation->state,
                     &simulation->report);
  if (status != TF_OK) return status;
  simulation->input = tf_input_default(&simulation->machine);
  simulation->source = TF_INPUT_SCENE;
  simulation->stepped = TF_INPUT_SCENE;
  simulation->left = 0;
  return TF_OK;
}

TF_API tf_status_t tf_simulation_open(tf_simulation_t *simulation,
                                      const tf_scene_t *scene,
                                      const tf_params_t *params,
                                      uint32_t seed) {
  const tf_status_t status = tf_prepare(&simulation->machine, params, NULL);
  if (status != TF_OK) return status;
  simulation->tally = (tf_tally_t){0};
  simulation->deadman = 0;
  simulation->expired = 0;
  simulation->running = true;
  return tf_simulation_start(simulation, scene, seed);
}

TF_API void tf_simulation_set_input(tf_simulation_t *simulation,
                                    const tf_input_t *input) {
  simulation->input = *input;
  simulation->source = TF_INPUT_SET;
  simulation->left = simulation->deadman;
}

// A count of ticks that are left, not a tick at which the inputs end: the tick
// jumps when a state is restored.
static void count_down(tf_simulation_t *simulation) {
  if (simulation->deadman == 0) return;
  if (simulation->left > 0) {
    simulation->left--;
    return;
  }
  simulation->source = TF_INPUT_SAFE;
  simulation->expired++;
}

TF_API tf_input_t tf_simulation_input(tf_simulation_t *simulation,
                                      const tf_scene_t *scene) {
  const tf_machine_t *machine = &simulation->machine;
  if (simulation->source == TF_INPUT_SET) count_down(simulation);
  simulation->stepped = simulation->source;
  if (simulation->source == TF_INPUT_SET) {
    const tf_input_t input = simulation->input;
    simulation->input.alpha = 0;
    return input;
  }
  if (simulation->source == TF_INPUT_SAFE) return tf_input_default(machine);
  return tf_scene_input(scene, machine, simulation->state.tick + 1);
}
