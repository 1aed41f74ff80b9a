/* The scenes that come with the project: their texts, the start of `chaos` and
 * the inputs of `driven` over time. Their motions: law/test_reference.c. */
#include "scene_named.h"
#include "sim.h"

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

/* The paper's figure 5, and constants that put its two-fold at (r*, w*). */
TEST(chaos_starts_as_the_contract_says) {
  const tf_scene_t *scene = scene_named("chaos");
  const sim_t run = sim_at_start(scene, &scene->params, 0);
  CHECK(run.x.r == TF_R(0.18));
  CHECK(run.x.w == TF_R(-1.037));
  CHECK(scene->h == TF_R(1e-10));
  CHECK(!scene->v_is_given);
  CHECK_NEAR(wide(run.report.slip.h), 1e-10L, 4 * EPSILON);
  paper_t paper;
  paper_default(&paper);
  const tf_params_t *p = &scene->params;
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
static void judge_segment(const tf_scene_t *scene, const tf_machine_t *k,
                          const tf_knot_t *a, const tf_knot_t *b) {
  const real span = wide(b->t) - wide(a->t);
  const real size = fabsl(wide(a->omega0)) + fabsl(wide(b->omega0));
  for (int n = 1; n < 200; n++) {
    const tf_real_t t = (tf_real_t)(wide(a->t) + span * n / 200);
    const real share = (wide(b->t) - wide(t)) / span;
    const real want =
        wide(b->omega0) + (wide(a->omega0) - wide(b->omega0)) * share;
    const tf_input_t input = tf_scene_input(scene, k, t);
    CHECK_NEAR(wide(input.omega0), want, 4 * EPSILON * size);
  }
}

TEST(driven_profile_is_followed) {
  const tf_scene_t *scene = scene_named("driven");
  const tf_machine_t k = prepared(&scene->params);
  const int knots = scene->knots;
  const tf_knot_t *knot = scene->profile;
  CHECK(knots == 5);
  for (int i = 0; i < knots; i++) {
    const tf_input_t at = tf_scene_input(scene, &k, knot[i].t);
    CHECK(at.omega0 == knot[i].omega0);
    CHECK(at.r0 == scene->params.r0 && at.force == 0 && at.torque == 0);
    if (i + 1 < knots) {
      CHECK(knot[i].t < knot[i + 1].t);
      judge_segment(scene, &k, &knot[i], &knot[i + 1]);
    }
  }
  const tf_real_t outside[] = {-1, TF_R(-1e9), TF_R(10.5), TF_R(1e9)};
  for (int i = 0; i < 4; i++)
    CHECK(tf_scene_input(scene, &k, outside[i]).omega0 ==
          (outside[i] < 0 ? knot[0].omega0 : knot[knots - 1].omega0));
  const real known[][2] = {{1, -1.5L}, {3, -2}, {6, -0.5L}, {9, 0.5L}};
  for (int i = 0; i < 4; i++)
    CHECK_NEAR(wide(tf_scene_input(scene, &k, (tf_real_t)known[i][0]).omega0),
               known[i][1], 4 * EPSILON);
}

/* Two knots at one time are a jump: the step that ends there has the later
 * speed, and takes all of the jump as its acceleration. */
TEST(a_profile_may_jump) {
  tf_scene_t scene = *scene_named("driven");
  tf_machine_t k = prepared(&scene.params);
  const tf_knot_t knots[] = {{0, 1}, {1, 2}, {1, -1}, {2, -3}};
  memcpy(scene.profile, knots, sizeof knots);
  scene.knots = 4;
  k.dt = TF_R(0.25);
  const real want[] = {1, 1.25L, 1.5L, 1.75L, -1, -1.5L, -2, -2.5L, -3, -3};
  for (int i = 0; i < 10; i++) {
    const tf_real_t t = (tf_real_t)i / 4;
    const tf_input_t u = tf_scene_input(&scene, &k, t);
    CHECK(wide(u.omega0) == want[i]);
    CHECK(wide(u.alpha) == (i > 0 ? 4 * (want[i] - want[i - 1]) : 0));
  }
  /* What follows the last knot in memory is not a knot. */
  for (scene.knots = 1; scene.knots <= 3; scene.knots++)
    for (int t = 2; t < 6; t++) {
      const tf_input_t u = tf_scene_input(&scene, &k, (tf_real_t)t);
      CHECK(u.omega0 == knots[scene.knots - 1].omega0 && u.alpha == 0);
    }
}
