/* A scene under way is what the command line runs, and starts where its scene
 * says or not at all. */
#include "same_state.h"
#include "scene_named.h"
#include "tap.h"
#include "twofold.h"

TEST(simulation_is_the_run_of_the_command_line) {
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_scene_t *scene = tf_scenes[i];
    tf_simulation_t simulation;
    CHECK(tf_simulation_open(&simulation, scene, &scene->params, 0) == TF_OK);
    tf_state_t state;
    tf_report_t report;
    CHECK(tf_scene_start(scene, &simulation.machine, 0, &state, &report) ==
          TF_OK);
    CHECK(same_state(&state, &simulation.state));
    CHECK(report.choices == simulation.report.choices && simulation.running);
    for (int n = 1; n <= 30000; n++) {
      const tf_input_t input = tf_scene_input(
          scene, &simulation.machine,
          (tf_real_t)((double)n * (double)simulation.machine.dt));
      tf_step(&simulation.machine, &state, &input, &report);
      const tf_input_t own = tf_simulation_input(&simulation, scene);
      CHECK(own.omega0 == input.omega0 && own.alpha == input.alpha);
      tf_step(&simulation.machine, &simulation.state, &own, &simulation.report);
    }
    CHECK(same_state(&state, &simulation.state));
  }
  tf_simulation_t simulation;
  tf_params_t params = tf_scenes[0]->params;
  params.m = -1;
  CHECK(tf_simulation_open(&simulation, tf_scenes[0], &params, 0) ==
        TF_BAD_PARAMETER);
  params.m = 1;
  params.gamma = 0; /* h does not depend on v there */
  CHECK(tf_simulation_open(&simulation, tf_scenes[0], &params, 0) ==
        TF_BAD_STATE);
}

/* A start with h < 0 slips to that side; one that is out of reach is refused,
 * and a simulation under way stays as it was. */
TEST(simulation_starts_on_either_side) {
  tf_scene_t scene = *scene_named("chaos");
  tf_simulation_t simulation;
  for (int side = -1; side <= 1; side += 2) {
    scene.h = (tf_real_t)side * TF_R(0.01);
    CHECK(tf_simulation_open(&simulation, &scene, &scene.params, 0) == TF_OK);
    CHECK(simulation.state.mode == (side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
    CHECK_NEAR(simulation.report.slip.h, scene.h, 8 * TF_REAL_EPSILON);
  }
  const tf_simulation_t before = simulation;
  scene.v_is_given = true;
  scene.r = 2 * TF_STATE_LIMIT;
  CHECK(tf_simulation_start(&simulation, &scene, 7) == TF_BAD_STATE);
  CHECK(same_state(&simulation.state, &before.state));
  CHECK(simulation.report.mode == before.report.mode);
}

/* Where h = 0 escapes, the side on which a start lies decides even where the
 * real type cannot resolve its h; h = 0 itself rests in the stick. */
TEST(simulation_keeps_the_side_of_a_start_below_rounding) {
  int open = 0;
  for (int i = 0; i < 20000; i++) {
    tf_scene_t scene = *scene_named("chaos");
    scene.r = (tf_real_t)tap_uniform(-0.2, 0.2);
    scene.omega = (tf_real_t)tap_uniform(-1.4, -0.6);
    scene.h = 0;
    tf_simulation_t simulation;
    CHECK(tf_simulation_open(&simulation, &scene, &scene.params, 0) == TF_OK);
    if (simulation.report.choices != 3) continue;
    open++;
    CHECK(simulation.state.mode > TF_SLIP_MINUS);
    for (int side = -1; side <= 1; side += 2) {
      scene.h = (tf_real_t)side * TF_REAL_MIN;
      CHECK(tf_simulation_start(&simulation, &scene, 0) == TF_OK);
      CHECK(simulation.state.mode == (side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS));
    }
  }
  CHECK(open > 10);
}

/* Inputs from outside hold for as many steps as was declared, whatever the tick
 * does meanwhile, then the safe ones until they are set again. */
TEST(inputs_expire_after_their_steps) {
  const tf_scene_t *scene = scene_named("driven");
  tf_simulation_t simulation;
  CHECK(tf_simulation_open(&simulation, scene, &scene->params, 0) == TF_OK);
  CHECK(simulation.deadman == 0 && simulation.expired == 0);
  const tf_input_t push = {TF_R(-0.5), TF_R(0.125), 1, 2, 0};
  const tf_input_t safe = tf_input_default(&simulation.machine);
  tf_simulation_set_input(&simulation, &push); /* without end */
  for (int n = 0; n < 100000; n++)
    CHECK(tf_simulation_input(&simulation, scene).torque == 2);
  simulation.deadman = 7;
  for (uint32_t again = 1; again <= 3; again++) {
    tf_simulation_set_input(&simulation, &push);
    for (int n = 0; n < 7; n++) {
      simulation.state.tick = tap_bits();
      CHECK(tf_simulation_input(&simulation, scene).force == 1);
      CHECK(simulation.stepped == TF_INPUT_SET);
    }
    for (int n = 0; n < 100; n++) {
      const tf_input_t got = tf_simulation_input(&simulation, scene);
      CHECK(got.force == 0 && got.torque == 0 && got.alpha == 0);
      CHECK(got.omega0 == safe.omega0 && got.r0 == safe.r0);
      CHECK(simulation.stepped == TF_INPUT_SAFE && simulation.expired == again);
    }
  }
  simulation.deadman = UINT32_MAX; /* the longest */
  tf_simulation_set_input(&simulation, &push);
  CHECK(simulation.left == UINT32_MAX);
  simulation.left = 1;
  CHECK(tf_simulation_input(&simulation, scene).torque == 2);
  CHECK(tf_simulation_input(&simulation, scene).torque == 0);
  CHECK(tf_simulation_start(&simulation, scene, 0) == TF_OK);
  CHECK(simulation.source == TF_INPUT_SCENE &&
        simulation.deadman == UINT32_MAX);
}
