/* One second of scene `chaos`: prints where the slider is. */
#include <stdio.h>
#include <twofold.h>

int main(void) {
  static tf_session_t session;
  const tf_scene_t *scene = tf_scenes[0];
  if (tf_session_open(&session, scene, &scene->params, 1) != TF_OK) return 1;
  while (session.state.tick < 10000) {
    const tf_input_t input = tf_session_input(&session, scene);
    if (tf_step(&session.machine, &session.state, &input, &session.report) < 0)
      return 2;
  }
  printf("%s r = %a m\n", scene->name, (double)session.state.r);
  return 0;
}
