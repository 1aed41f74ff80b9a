// A running scene: machine, state and inputs tick by tick.
#include "twofold/session.h"

#include <stddef.h>

TF_API tf_status_t tf_session_start(tf_session_t *session,
                                    const tf_scene_t *scene, uint32_t seed) {
  const tf_status_t status = tf_scene_start(scene, &session->machine, seed,
                                            &session->state, &session->report);
  if (status != TF_OK) return status;
  session->input = tf_input_default(&session->machine);
  session->input_is_set = false;
  return TF_OK;
}

TF_API tf_status_t tf_session_open(tf_session_t *session,
                                   const tf_scene_t *scene,
                                   const tf_params_t *params, uint32_t seed) {
  const tf_status_t status = tf_prepare(&session->machine, params, NULL);
  if (status != TF_OK) return status;
  session->tally = (tf_tally_t){0};
  session->running = true;
  return tf_session_start(session, scene, seed);
}

// In float the tick is exact up to 2^24 steps: far beyond the last knot of a
// scene, after which the inputs are constant.
TF_API tf_input_t tf_session_input(const tf_session_t *session,
                                   const tf_scene_t *scene) {
  if (session->input_is_set) return session->input;
  const tf_machine_t *machine = &session->machine;
  const tf_real_t tick = (tf_real_t)(session->state.tick + 1);
  return tf_scene_input(scene, machine,
                        scene->knots == 0 ? 0 : tick * machine->dt);
}
