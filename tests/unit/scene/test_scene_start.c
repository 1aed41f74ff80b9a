/* A scene has one start wherever it is needed: a simulation, a reset over the
 * line, the firmware that has all scenes, and the constants that a firmware of
 * one scene is made of. Seen here by the side on which a slip starts. */
#include "common.h"
#include "firmware_start.h"
#include "same_state.h"

/* A scene that starts at h, so small a slip that its sign alone may decide. */
static tf_scene_t scene_at(const char *name, tf_real_t h) {
  tf_scene_t scene = *scene_named(name);
  scene.h = h;
  scene.v_is_given = false;
  return scene;
}

/* The mode that the written constants start in. */
static int written_mode(const tf_scene_t *scene) {
  char line[256];
  int mode = -1;
  bool in_state = false;
  FILE *out = tmpfile();
  CHECK(out != NULL);
  if (out == NULL) return -1;
  CHECK(write_firmware_constants(out, scene) == 0);
  rewind(out);
  while (fgets(line, sizeof line, out) != NULL) {
    if (strstr(line, " scene_start = {") != NULL) in_state = true;
    if (in_state && sscanf(line, " .mode = %d", &mode) == 1) break;
  }
  fclose(out);
  return mode;
}

/* Every way to start the scene ends in this mode, and in one state. */
static void judge(const tf_scene_t *scene, tf_mode_t mode) {
  tf_machine_t machine;
  tf_state_t state, generic;
  tf_report_t report;
  tf_simulation_t simulation;
  memset(&state, 0, sizeof state);
  memset(&generic, 0, sizeof generic);
  CHECK(tf_prepare(&machine, &scene->params, NULL) == TF_OK);
  CHECK(tf_scene_start(scene, &machine, 1, &state, &report) == TF_OK);
  CHECK(state.mode == mode && report.mode == mode && state.tick == 0);
  CHECK(tf_simulation_open(&simulation, scene, &scene->params, 1) == TF_OK);
  CHECK(same_state(&simulation.state, &state));
  const tf_slip_t slip = tf_slip(&machine, state.r, state.v, state.w,
                                 tf_scene_input(scene, &machine, 0).omega0);
  CHECK_NEAR(slip.h, scene->h, 8 * TF_REAL_EPSILON);
  CHECK(simulation.report.slip.h == slip.h);
  simulation.state.mode = TF_PINNED;
  simulation.state.r += 1;
  CHECK(tf_simulation_start(&simulation, scene, 1) == TF_OK);
  CHECK(same_state(&simulation.state, &state));
  CHECK(generic_firmware_start(scene, &generic, &report));
  CHECK(same_state(&generic, &state) && report.mode == mode);
  CHECK(written_mode(scene) == (int)mode);
}

TEST(negative_h_starts_in_slip_minus) {
  const char *names[] = {"chaos", "coulomb", "driven", "smooth", "string"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const tf_scene_t plus = scene_at(names[i], TF_R(0.01));
    const tf_scene_t minus = scene_at(names[i], TF_R(-0.01));
    judge(&plus, TF_SLIP_PLUS);
    judge(&minus, TF_SLIP_MINUS);
  }
}

/* In the escaping region stick and both slips are possible; a slip below
 * rounding differs from h = 0, which rests in the stick, by its sign alone. */
TEST(sign_of_h_decides_where_both_slips_are_possible) {
  int open = 0;
  for (int i = 0; i < 20000 && open < 11; i++) {
    tf_scene_t scene = scene_at("chaos", 0);
    tf_simulation_t simulation;
    scene.r = (tf_real_t)tap_uniform(-0.2, 0.2);
    scene.omega = (tf_real_t)tap_uniform(-1.4, -0.6);
    CHECK(tf_simulation_open(&simulation, &scene, &scene.params, 1) == TF_OK);
    if (simulation.report.choices != 3) continue;
    open++;
    CHECK(simulation.state.mode > TF_SLIP_MINUS);
    scene.h = TF_REAL_MIN;
    judge(&scene, TF_SLIP_PLUS);
    scene.h = -TF_REAL_MIN;
    judge(&scene, TF_SLIP_MINUS);
  }
  CHECK(open == 11);
}

TEST(impossible_start_is_refused_and_touches_nothing) {
  tf_scene_t scene = scene_at("gamma_zero", TF_R(0.01));
  tf_machine_t machine;
  tf_state_t state = {.r = 3}, state_before = state;
  tf_report_t report = {.choices = 9};
  CHECK(tf_prepare(&machine, &scene.params, NULL) == TF_OK);
  CHECK(tf_scene_start(&scene, &machine, 1, &state, &report) == TF_BAD_STATE);
  CHECK(same_state(&state, &state_before) && report.choices == 9);
  CHECK(!generic_firmware_start(&scene, &state, &report));
  scene = *scene_named("gamma_zero");
  scene.r = 2 * TF_STATE_LIMIT;
  CHECK(tf_scene_start(&scene, &machine, 1, &state, &report) == TF_BAD_STATE);
  CHECK(same_state(&state, &state_before) && report.choices == 9);
  /* Nor is a simulation that is under way. */
  tf_simulation_t simulation;
  CHECK(tf_simulation_open(&simulation, tf_scenes[0], &tf_scenes[0]->params,
                           0) == TF_OK);
  const tf_simulation_t before = simulation;
  CHECK(tf_simulation_start(&simulation, &scene, 7) == TF_BAD_STATE);
  CHECK(same_state(&simulation.state, &before.state));
  CHECK(simulation.report.mode == before.report.mode);
}
