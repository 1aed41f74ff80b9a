/* A scene under way is what the command line runs, and starts where its scene
 * says or not at all. */
#include "same_state.h"
#include "scene_named.h"
#include "tap.h"
#include "twofold.h"

TEST(session_is_the_run_of_the_command_line) {
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_scene_t *scene = tf_scenes[i];
    tf_session_t session;
    CHECK(tf_session_open(&session, scene, &scene->params, 0) == TF_OK);
    tf_state_t state;
    memset(&state, 0, sizeof state);
    tf_input_t input = tf_scene_input(scene, &session.machine, 0);
    state.r = scene->r;
    state.w = scene->omega;
    state.v = scene->v;
    state.mode = TF_NO_MODE;
    if (!scene->v_is_given) {
      CHECK(tf_speed_for_slip(&session.machine, state.r, state.w, input.omega0,
                              scene->h, &state.v) == TF_OK);
      if (scene->h > 0) state.mode = TF_SLIP_PLUS;
    }
    tf_report_t report;
    CHECK(tf_begin(&session.machine, &state, &input, &report) == TF_OK);
    CHECK(same_state(&state, &session.state));
    CHECK(report.choices == session.report.choices && session.running);
    for (int n = 1; n <= 30000; n++) {
      input =
          tf_scene_input(scene, &session.machine,
                         (tf_real_t)((double)n * (double)session.machine.dt));
      tf_step(&session.machine, &state, &input, &report);
      const tf_input_t own = tf_session_input(&session, scene);
      CHECK(own.omega0 == input.omega0 && own.alpha == input.alpha);
      tf_step(&session.machine, &session.state, &own, &session.report);
    }
    CHECK(same_state(&state, &session.state));
  }
  tf_session_t session;
  tf_params_t params = tf_scenes[0]->params;
  params.m = -1;
  CHECK(tf_session_open(&session, tf_scenes[0], &params, 0) ==
        TF_BAD_PARAMETER);
  params.m = 1;
  params.gamma = 0; /* h does not depend on v there */
  CHECK(tf_session_open(&session, tf_scenes[0], &params, 0) == TF_BAD_STATE);
}

/* A start with h < 0 slips to that side; one that is out of reach is refused,
 * and a session under way stays as it was. */
TEST(session_starts_on_either_side) {
  tf_scene_t scene = *scene_named("chaos");
  tf_session_t session;
  for (int side = -1; side <= 1; side += 2) {
    scene.h = (tf_real_t)side * TF_R(0.01);
    CHECK(tf_session_open(&session, &scene, &scene.params, 0) == TF_OK);
    CHECK(session.state.mode == (side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
    CHECK_NEAR(session.report.slip.h, scene.h, 8 * TF_REAL_EPSILON);
  }
  const tf_session_t before = session;
  scene.v_is_given = true;
  scene.r = 2 * TF_STATE_LIMIT;
  CHECK(tf_session_start(&session, &scene, 7) == TF_BAD_STATE);
  CHECK(same_state(&session.state, &before.state));
  CHECK(session.report.mode == before.report.mode);
}

/* Where h = 0 escapes, the side on which a start lies decides even where the
 * real type cannot tell its h from 0; h = 0 itself rests in the stick. */
TEST(session_keeps_the_side_of_a_start_below_rounding) {
  int open = 0;
  for (int i = 0; i < 20000; i++) {
    tf_scene_t scene = *scene_named("chaos");
    scene.r = (tf_real_t)tap_uniform(-0.2, 0.2);
    scene.omega = (tf_real_t)tap_uniform(-1.4, -0.6);
    scene.h = 0;
    tf_session_t session;
    CHECK(tf_session_open(&session, &scene, &scene.params, 0) == TF_OK);
    if (session.report.choices != 3) continue;
    open++;
    CHECK(session.state.mode > TF_SLIP_MINUS);
    for (int side = -1; side <= 1; side += 2) {
      scene.h = (tf_real_t)side * TF_REAL_MIN;
      CHECK(tf_session_start(&session, &scene, 0) == TF_OK);
      CHECK(session.state.mode == (side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
    }
  }
  CHECK(open > 10);
}

/* Inputs from outside hold for as many steps as was declared, whatever the tick
 * does meanwhile, then the safe ones until they are set again. */
TEST(inputs_expire_after_their_steps) {
  const tf_scene_t *scene = scene_named("driven");
  tf_session_t session;
  CHECK(tf_session_open(&session, scene, &scene->params, 0) == TF_OK);
  CHECK(session.deadman == 0 && session.expired == 0);
  const tf_input_t push = {TF_R(-0.5), TF_R(0.125), 1, 2, 0};
  const tf_input_t safe = tf_input_default(&session.machine);
  tf_session_set_input(&session, &push); /* without end */
  for (int n = 0; n < 100000; n++)
    CHECK(tf_session_input(&session, scene).torque == 2);
  session.deadman = 7;
  for (uint32_t again = 1; again <= 3; again++) {
    tf_session_set_input(&session, &push);
    for (int n = 0; n < 7; n++) {
      session.state.tick = tap_bits();
      CHECK(tf_session_input(&session, scene).force == 1);
      CHECK(session.stepped == TF_INPUT_SET);
    }
    for (int n = 0; n < 100; n++) {
      const tf_input_t got = tf_session_input(&session, scene);
      CHECK(got.force == 0 && got.torque == 0 && got.alpha == 0);
      CHECK(got.omega0 == safe.omega0 && got.r0 == safe.r0);
      CHECK(session.stepped == TF_INPUT_SAFE && session.expired == again);
    }
  }
  session.deadman = UINT32_MAX; /* the longest */
  tf_session_set_input(&session, &push);
  CHECK(session.left == UINT32_MAX);
  session.left = 1;
  CHECK(tf_session_input(&session, scene).torque == 2);
  CHECK(tf_session_input(&session, scene).torque == 0);
  CHECK(tf_session_start(&session, scene, 0) == TF_OK);
  CHECK(session.source == TF_INPUT_SCENE && session.deadman == UINT32_MAX);
}

int main(int argc, char **argv) {
  tap_begin(argc, argv);
  RUN(session_is_the_run_of_the_command_line);
  RUN(session_starts_on_either_side);
  RUN(session_keeps_the_side_of_a_start_below_rounding);
  RUN(inputs_expire_after_their_steps);
  return tap_end();
}
