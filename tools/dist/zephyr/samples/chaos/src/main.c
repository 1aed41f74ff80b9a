/* One second of scene `chaos` at 1 kHz, in real time. */
#include <twofold.h>
#include <zephyr/kernel.h>
#include <zephyr/sys/printk.h>

static tf_session_t session;

int main(void) {
  const tf_scene_t *scene = tf_scenes[0];
  tf_params_t params = scene->params;
  params.dt = TF_R(1e-3);
  if (tf_session_open(&session, scene, &params, 1) != TF_OK) return 1;
  while (session.state.tick < 1000) {
    const tf_input_t input = tf_session_input(&session, scene);
    if (tf_step(&session.machine, &session.state, &input, &session.report) < 0)
      return 2;
    k_msleep(1);
  }
  printk("%s: tick %u, mode %s\n", scene->name, (unsigned)session.state.tick,
         tf_mode_name(session.report.mode));
  return 0;
}
