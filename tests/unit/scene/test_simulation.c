/* A scene under way is what the command line runs: its inputs, and how what its
 * steps said is counted. */
#include "common.h"

/* Whatever was in its memory before. */
static tf_simulation_t opened(const tf_scene_t *scene) {
  tf_simulation_t simulation;
  memset(&simulation, 0xff, sizeof simulation);
  CHECK(tf_simulation_open(&simulation, scene, &scene->params, 0) == TF_OK);
  const tf_tally_t *t = &simulation.tally;
  CHECK(t->degraded + t->fell_back + t->coarse + t->refused + t->stalled == 0);
  return simulation;
}

/* Its inputs are those of the scene; its start: test_scene_start.c. */
TEST(simulation_has_the_inputs_of_its_scene) {
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_scene_t *scene = tf_scenes[i];
    tf_simulation_t simulation = opened(scene);
    CHECK(simulation.running);
    for (uint64_t n = 1; n <= 30000; n++) {
      const tf_input_t want = tf_scene_input(scene, &simulation.machine, n);
      const tf_input_t own = tf_simulation_input(&simulation, scene);
      CHECK(own.omega0 == want.omega0 && own.alpha == want.alpha);
      simulation.state.tick = n;
    }
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

/* Inputs from outside hold for as many steps as was declared, whatever the tick
 * does meanwhile, then the safe ones until they are set again. */
TEST(inputs_expire_after_their_steps) {
  const tf_scene_t *scene = scene_named("driven");
  tf_simulation_t simulation = opened(scene);
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

/* A tick without a step is one of those for which inputs hold, but not while
 * the simulation stands. */
TEST(ticks_without_a_step_count) {
  tf_simulation_t simulation = opened(tf_scenes[0]);
  for (uint32_t left = 0; left < 5; left++)
    for (uint32_t ticks = 0; ticks < 7; ticks++) {
      simulation.left = left;
      simulation.running = false;
      tf_simulation_pass(&simulation, ticks);
      CHECK(simulation.left == left);
      simulation.running = true;
      tf_simulation_pass(&simulation, ticks < 6 ? ticks : UINT32_MAX);
      CHECK(simulation.left == (ticks < left ? left - ticks : 0));
    }
}

/* alpha is that of the first step, whether the next command comes in time, late
 * or never: the turntable stays where it has come to. */
TEST(alpha_acts_on_its_first_step_only) {
  const tf_scene_t *scene = scene_named("driven");
  tf_simulation_t simulation = opened(scene);
  const tf_real_t dt = simulation.machine.dt;
  simulation.deadman = 12;
  tf_input_t sent = tf_input_default(&simulation.machine);
  for (int steps = 1; steps <= 20; steps++) {
    tf_turntable_to(&sent, sent.omega0 + TF_R(0.25), dt);
    sent.torque = (tf_real_t)steps;
    tf_simulation_set_input(&simulation, &sent);
    for (int n = 0; n < steps; n++) {
      const tf_input_t got = tf_simulation_input(&simulation, scene);
      CHECK(got.alpha == (n == 0 ? sent.alpha : 0) && sent.alpha != 0);
      CHECK(got.omega0 == (n < 12 ? sent.omega0 : simulation.machine.omega0));
      CHECK(got.torque == (n < 12 ? sent.torque : 0));
    }
  }
}

/* What the steps of a run said is counted by status, and the first that was not
 * TF_OK is remembered, whichever it was. */
TEST(tally_counts_every_status) {
  const uint64_t early = UINT64_C(1) << 33;
  for (int first = TF_STEP_TOO_LONG; first <= TF_STALLED; first++) {
    tf_tally_t tally;
    uint64_t tick = early;
    memset(&tally, 0, sizeof tally);
    tf_tally_count(&tally, tick++, TF_OK);
    tf_tally_count(&tally, tick++, (tf_status_t)first);
    tf_tally_count(&tally, tick++, (tf_status_t)first);
    for (int status = TF_STEP_TOO_LONG; status <= TF_STALLED; status++)
      for (int n = status == first ? 2 : 0; n < 10 + status; n++)
        tf_tally_count(&tally, tick++, (tf_status_t)status);
    CHECK(tally.degraded == 11 && tally.fell_back == 12);
    CHECK(tally.coarse == 13 && tally.stalled == 14);
    CHECK(tally.refused == 6 + 7 + 8 + 9);
    if (first != TF_OK) CHECK(tally.first == early + 1);
  }
}
