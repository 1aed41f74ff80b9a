/* Ten seconds of the scene `chaos`: prints where the slider ends. */
#include <stdio.h>

#include "twofold.h"

int main(void) {
  tf_simulation_t simulation;
  const tf_scene_t *scene = tf_scenes[0];
  if (tf_simulation_open(&simulation, scene, &scene->params, 1) != TF_OK)
    return 1;
  for (int i = 0; i < 100000; i++) {
    const tf_input_t input = tf_simulation_input(&simulation, scene);
    if (tf_step(&simulation.machine, &simulation.state, &input,
                &simulation.report) < 0)
      return 2;
  }
  printf("%s r = %a m\n", scene->name, (double)simulation.state.r);
  return 0;
}
