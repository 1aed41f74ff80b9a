/* Scene `chaos`, a line every second. A task of FreeRTOS with the stack of
 * app_main (CONFIG_ESP_MAIN_TASK_STACK_SIZE, 3584 B by default) has room for
 * tf_step. */
#include <stdio.h>

#include "freertos/FreeRTOS.h"
#include "freertos/task.h"
#include "twofold.h"

static tf_simulation_t simulation;

void app_main(void) {
  const tf_scene_t *scene = tf_scenes[0];
  tf_params_t params = scene->params;
  params.dt = TF_R(1e-2);
  if (tf_simulation_open(&simulation, scene, &params, 1) != TF_OK) return;
  for (;;) {
    const tf_input_t input = tf_simulation_input(&simulation, scene);
    if (tf_step(&simulation.machine, &simulation.state, &input,
                &simulation.report) < 0)
      return;
    if (simulation.state.tick % 100 == 0)
      printf("r:%.6f omega:%.6f mode:%s\n", (double)simulation.state.r,
             (double)simulation.state.w, tf_mode_name(simulation.report.mode));
    vTaskDelay(pdMS_TO_TICKS(10));
  }
}
