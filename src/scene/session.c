// A running scene: machine, state and inputs tick by tick.
#include "twofold/session.h"

#include <stddef.h>

TF_API tf_status_t tf_session_start(tf_session_t *session,
                                    const tf_scene_t *scene, uint32_t seed) {
  const tf_status_t status = tf_scene_start(scene, &session->machine, seed,
                                            &session->state, &session->report);
  if (status != TF_OK) return status;
  session->input = tf_input_default(&session->machine);
  session->source = TF_INPUT_SCENE;
  session->stepped = TF_INPUT_SCENE;
  session->left = 0;
  return TF_OK;
}

TF_API tf_status_t tf_session_open(tf_session_t *session,
                                   const tf_scene_t *scene,
                                   const tf_params_t *params, uint32_t seed) {
  const tf_status_t status = tf_prepare(&session->machine, params, NULL);
  if (status != TF_OK) return status;
  session->tally = (tf_tally_t){0};
  session->deadman = 0;
  session->expired = 0;
  session->running = true;
  return tf_session_start(session, scene, seed);
}

TF_API void tf_session_set_input(tf_session_t *session,
                                 const tf_input_t *input) {
  session->input = *input;
  session->source = TF_INPUT_SET;
  session->left = session->deadman;
}

// A count of steps that are left, not a tick at which the inputs end: the tick
// jumps when a state is restored.
static void count_down(tf_session_t *session) {
  if (session->deadman == 0) return;
  if (session->left > 0) {
    session->left--;
    return;
  }
  session->source = TF_INPUT_SAFE;
  session->expired++;
}

// In float the tick is exact up to 2^24 steps: far beyond the last knot of a
// scene, after which the inputs are constant.
TF_API tf_input_t tf_session_input(tf_session_t *session,
                                   const tf_scene_t *scene) {
  const tf_machine_t *machine = &session->machine;
  if (session->source == TF_INPUT_SET) count_down(session);
  session->stepped = session->source;
  if (session->source == TF_INPUT_SET) return session->input;
  if (session->source == TF_INPUT_SAFE) return tf_input_default(machine);
  const tf_real_t tick = (tf_real_t)(session->state.tick + 1);
  return tf_scene_input(scene, machine,
                        scene->knots == 0 ? 0 : tick * machine->dt);
}
