// A scene under way: its start, and its inputs tick by tick.
#include "twofold/session.h"

#include <stddef.h>

TF_API tf_status_t tf_session_start(tf_session_t *session,
                                    const tf_scene_t *scene, uint32_t seed) {
  const tf_machine_t *machine = &session->machine;
  const tf_input_t input = tf_scene_input(scene, machine, 0);
  tf_state_t state = {.r = scene->r,
                      .v = scene->v,
                      .w = scene->omega,
                      .seed = seed,
                      .mode = TF_MODES};
  if (!scene->v_is_given) {
    const tf_status_t status = tf_speed_for_slip(
        machine, state.r, state.w, input.omega0, scene->h, &state.v);
    if (status != TF_OK) return status;
    if (scene->h > 0) state.mode = TF_SLIP_PLUS;
    if (scene->h < 0) state.mode = TF_SLIP_MINUS;
  }
  tf_report_t report;
  const tf_status_t status = tf_begin(machine, &state, &input, &report);
  if (status != TF_OK) return status;
  session->state = state;
  session->report = report;
  session->input = input;
  session->driven = false;
  return TF_OK;
}

TF_API tf_status_t tf_session_open(tf_session_t *session,
                                   const tf_scene_t *scene,
                                   const tf_params_t *params, uint32_t seed) {
  const tf_status_t status = tf_prepare(&session->machine, params, NULL);
  if (status != TF_OK) return status;
  session->running = true;
  return tf_session_start(session, scene, seed);
}

// The tick is exact in double, and in float up to 2^24 steps: far beyond the
// last knot of a scene, where the inputs are constant.
TF_API tf_input_t tf_session_input(const tf_session_t *session,
                                   const tf_scene_t *scene) {
  if (session->driven) return session->input;
  const tf_machine_t *machine = &session->machine;
  const tf_real_t tick = (tf_real_t)(session->state.tick + 1);
  return tf_scene_input(scene, machine,
                        scene->knots == 0 ? 0 : tick * machine->dt);
}
