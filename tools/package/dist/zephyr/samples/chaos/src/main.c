/* One second of scene `chaos` at 1 kHz, in real time. */
#include <twofold.h>
#include <zephyr/kernel.h>
#include <zephyr/sys/printk.h>

static tf_simulation_t simulation;

int main(void) {
  const tf_scene_t *scene = tf_scenes[0];
  tf_params_t params = scene->params;
  params.dt = TF_R(1e-3);
  if (tf_simulation_open(&simulation, scene, &params, 1) != TF_OK) return 1;
  while (simulation.state.tick < 1000) {
    const tf_input_t input = tf_simulation_input(&simulation, scene);
    if (tf_step(&simulation.machine, &simulation.state, &input,
                &simulation.report) < 0)
      return 2;
    k_msleep(1);
  }
  printk("%s: tick %u, mode %s\n", scene->name, (unsigned)simulation.state.tick,
         tf_mode_name(simulation.report.mode));
  return 0;
}
