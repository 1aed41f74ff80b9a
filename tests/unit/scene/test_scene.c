/* The scenes that come with the project: their texts, their starts, their
 * inputs over time, and what the text of some of them promises about the
 * motion, stepped to the end. */
#include "common.h"
#include "resolved.h"
#include "scene_named.h"

/* A scene at its start. */
typedef struct {
  const tf_scene_t *scene;
  tf_machine_t machine;
  tf_state_t state;
  tf_report_t report;
} run_t;

static run_t started(const tf_scene_t *scene) {
  run_t run;
  memset(&run, 0, sizeof run);
  run.scene = scene;
  CHECK(tf_prepare(&run.machine, &scene->params, NULL) == TF_OK);
  CHECK(tf_scene_start(scene, &run.machine, 0, &run.state, &run.report) ==
        TF_OK);
  return run;
}

/* The input of the step that ends at tick + 1. */
static tf_status_t advance(run_t *run) {
  const real t = wide(run->machine.dt) * (real)(run->state.tick + 1);
  const tf_input_t input =
      tf_scene_input(run->scene, &run->machine, (tf_real_t)t);
  return tf_step(&run->machine, &run->state, &input, &run->report);
}

static uint64_t steps_of(const run_t *run) {
  return (uint64_t)(run->scene->t_end / run->machine.dt + TF_R(0.5));
}

static void one_line(const char *text, size_t longest) {
  const size_t length = strlen(text);
  CHECK(length > 0 && length <= longest);
  for (size_t i = 0; i < length; i++) CHECK(text[i] >= ' ' && text[i] <= '~');
}

TEST(scene_texts_are_usable) {
  for (int i = 0; i < TF_SCENES; i++) {
    one_line(tf_scenes[i]->name, 20);
    one_line(tf_scenes[i]->shows, 100);
    one_line(tf_scenes[i]->leaves_out, 100);
    CHECK(!strpbrk(tf_scenes[i]->name, " /-."));
    for (int j = 0; j < i; j++) {
      CHECK(strcmp(tf_scenes[i]->name, tf_scenes[j]->name));
      CHECK(strcmp(tf_scenes[i]->shows, tf_scenes[j]->shows));
    }
  }
  CHECK(!strcmp(tf_scenes[0]->name, "chaos")); /* the default */
}

TEST(scenes_begin_and_run) {
  for (int i = 0; i < TF_SCENES; i++) {
    run_t run = started(tf_scenes[i]);
    CHECK(tf_scenes[i]->t_end > 0);
    for (int n = 0; n < 3000; n++) {
      const tf_status_t status = advance(&run);
      CHECK(ok_to_resolution(status));
      CHECK(run.report.choices >= 1);
    }
    CHECK(run.state.tick == 3000);
    CHECK((run.state.phi != 0) == tf_scenes[i]->params.with_angle);
  }
}

TEST(chaos_begins_in_slip) {
  if (!IS_DOUBLE) SKIP("h = 1e-10 m/s is below the rounding of float");
  const run_t run = started(scene_named("chaos"));
  CHECK(run.state.mode == TF_SLIP_PLUS);
  CHECK(run.report.choices == 1);
}

/* The paper's figure 5, and constants that put its two-fold at (r*, w*). */
TEST(chaos_starts_as_the_contract_says) {
  const run_t run = started(scene_named("chaos"));
  CHECK(run.state.r == TF_R(0.18));
  CHECK(run.state.w == TF_R(-1.037));
  CHECK(run.scene->h == TF_R(1e-10));
  CHECK(!run.scene->v_is_given);
  CHECK_NEAR(wide(run.report.slip.h), 1e-10L, 4 * EPSILON);
  paper_t paper;
  paper_default(&paper);
  const tf_params_t *p = &run.scene->params;
  CHECK_NEAR(wide(p->kappa), paper.kappa, EPSILON * paper.kappa);
  CHECK_NEAR(wide(p->k2), paper.k2, 2 * EPSILON * paper.k2);
  CHECK_NEAR(wide(p->gamma), paper.gamma, 3 * EPSILON);
  CHECK_NEAR(wide(p->beta), paper.beta, EPSILON * paper.beta);
  CHECK_NEAR(wide(p->c1), paper.c1, EPSILON * paper.c1);
  CHECK_NEAR(wide(p->c2), paper.c2, EPSILON * paper.c2);
  CHECK_NEAR(wide(p->r0), paper.r0, EPSILON * paper.r0);
  CHECK(p->m == 1 && p->d == 1 && p->mu == 1 && p->omega0 == -1);
  CHECK(p->law == TF_TYRE_JUMP && p->rule == TF_RULE_PERSIST);
}

/* Linear between knots: the reference is interpolated from the later knot. */
static void judge_segment(const run_t *run, const tf_knot_t *a,
                          const tf_knot_t *b) {
  const real span = wide(b->t) - wide(a->t);
  const real size = fabsl(wide(a->omega0)) + fabsl(wide(b->omega0));
  for (int n = 1; n < 200; n++) {
    const tf_real_t t = (tf_real_t)(wide(a->t) + span * n / 200);
    const real share = (wide(b->t) - wide(t)) / span;
    const real want =
        wide(b->omega0) + (wide(a->omega0) - wide(b->omega0)) * share;
    const tf_input_t input = tf_scene_input(run->scene, &run->machine, t);
    CHECK_NEAR(wide(input.omega0), want, 4 * EPSILON * size);
  }
}

TEST(driven_profile_is_followed) {
  const run_t run = started(scene_named("driven"));
  const tf_scene_t *scene = run.scene;
  const int knots = scene->knots;
  const tf_knot_t *knot = scene->profile;
  CHECK(knots == 5);
  for (int i = 0; i < knots; i++) {
    const tf_input_t at = tf_scene_input(scene, &run.machine, knot[i].t);
    CHECK(at.omega0 == knot[i].omega0);
    CHECK(at.r0 == scene->params.r0 && at.force == 0 && at.torque == 0);
    if (i + 1 < knots) {
      CHECK(knot[i].t < knot[i + 1].t);
      judge_segment(&run, &knot[i], &knot[i + 1]);
    }
  }
  const tf_real_t outside[] = {-1, TF_R(-1e9), TF_R(10.5), TF_R(1e9)};
  for (int i = 0; i < 4; i++)
    CHECK(tf_scene_input(scene, &run.machine, outside[i]).omega0 ==
          (outside[i] < 0 ? knot[0].omega0 : knot[knots - 1].omega0));
  const real known[][2] = {{1, -1.5L}, {3, -2}, {6, -0.5L}, {9, 0.5L}};
  for (int i = 0; i < 4; i++)
    CHECK_NEAR(
        wide(
            tf_scene_input(scene, &run.machine, (tf_real_t)known[i][0]).omega0),
        known[i][1], 4 * EPSILON);
}

/* Two knots at one time are a jump: the step that ends there has the later
 * speed, and takes all of the jump as its acceleration. */
TEST(a_profile_may_jump) {
  run_t run = started(scene_named("driven"));
  tf_scene_t scene = *run.scene;
  const tf_knot_t knots[] = {{0, 1}, {1, 2}, {1, -1}, {2, -3}};
  memcpy(scene.profile, knots, sizeof knots);
  scene.knots = 4;
  run.machine.dt = TF_R(0.25);
  const real want[] = {1, 1.25L, 1.5L, 1.75L, -1, -1.5L, -2, -2.5L, -3, -3};
  for (int i = 0; i < 10; i++) {
    const tf_real_t t = (tf_real_t)i / 4;
    const tf_input_t u = tf_scene_input(&scene, &run.machine, t);
    CHECK(wide(u.omega0) == want[i]);
    CHECK(wide(u.alpha) == (i > 0 ? 4 * (want[i] - want[i - 1]) : 0));
  }
  /* What follows the last knot in memory is not a knot. */
  for (scene.knots = 1; scene.knots <= 3; scene.knots++)
    for (int t = 2; t < 6; t++) {
      const tf_input_t u = tf_scene_input(&scene, &run.machine, (tf_real_t)t);
      CHECK(u.omega0 == knots[scene.knots - 1].omega0 && u.alpha == 0);
    }
}

/* No knots: the parameters' own, and those may have been altered. */
TEST(other_scenes_have_constant_inputs) {
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_scene_t *scene = tf_scenes[i];
    CHECK(scene->knots <= TF_SCENE_KNOTS);
    if (scene->knots) continue;
    tf_params_t params = scene->params;
    tf_machine_t machine;
    params.omega0 = TF_R(-0.7);
    params.r0 = TF_R(0.25);
    CHECK(tf_prepare(&machine, &params, NULL) == TF_OK);
    for (int t = -5; t < 20; t++) {
      const tf_input_t input = tf_scene_input(scene, &machine, (tf_real_t)t);
      CHECK(input.omega0 == params.omega0 && input.r0 == params.r0);
      CHECK(input.force == 0 && input.torque == 0);
    }
  }
}

/* "starts on the upper sliding region (omega > omega0), never slips" */
TEST(rolling_never_slips) {
  run_t run = started(scene_named("rolling"));
  const uint64_t steps = steps_of(&run);
  CHECK(run.state.mode == TF_STICK_PLUS || run.state.mode == TF_STICK_MINUS);
  CHECK(run.state.w > run.machine.omega0);
  CHECK(steps > 1000);
  for (uint64_t n = 0; n < steps; n++) {
    const tf_status_t status = advance(&run);
    CHECK(ok_to_resolution(status));
    CHECK(run.report.mode == TF_STICK_PLUS ||
          run.report.mode == TF_STICK_MINUS);
    CHECK(run.report.delassus > 0);
    CHECK(fabsl(wide(run.report.slip.h)) <= 100 * EPSILON);
  }
}

/* "friction is associated, one future" */
TEST(coulomb_has_one_consistent_mode) {
  run_t run = started(scene_named("coulomb"));
  const uint64_t steps = steps_of(&run);
  uint64_t sticks = 0;
  CHECK(run.report.choices == 1);
  CHECK(steps > 1000);
  for (uint64_t n = 0; n < steps; n++) {
    const tf_status_t status = advance(&run);
    CHECK(ok_to_resolution(status));
    CHECK(run.report.choices == 1);
    CHECK(run.report.force.M == 0 && run.report.delassus > 0);
    sticks += run.report.mode > TF_SLIP_MINUS;
  }
  printf("# %d of %d steps stick\n", (int)sticks, (int)steps);
  CHECK(sticks > 0);
}

/* gamma = 0 and pi/2, and the smoothed, string and frictionless laws: what
 * their texts say about choice. */
TEST(other_scenes_do_what_they_show) {
  for (int i = 0; i < TF_SCENES; i++) {
    run_t run = started(tf_scenes[i]);
    const tf_tyre_law_t law = tf_scenes[i]->params.law;
    if (tf_tyre_is_set_valued(law)) continue;
    for (int n = 0; n < 20000; n++) {
      const tf_status_t status = advance(&run);
      CHECK(ok_to_resolution(status));
      CHECK(run.report.choices == 1 && run.report.mode <= TF_SLIP_MINUS);
      if (law == TF_TYRE_NONE)
        CHECK(run.report.force.F == 0 && run.report.force.M == 0);
    }
  }
  CHECK(scene_named("gamma_zero")->params.gamma == 0);
  CHECK_NEAR(wide(scene_named("gamma_right")->params.gamma), acosl(0),
             2 * EPSILON);
}
