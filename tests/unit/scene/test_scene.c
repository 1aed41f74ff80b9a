/* The scenes that come with the project: their texts, the start of `chaos` and
 * inputs over time. Their motions: law/test_reference.c. */
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

/* The paper's figure 5. Its constants: two_fold_of_the_paper_is_found. */
TEST(chaos_starts_as_the_contract_says) {
  const tf_scene_t *scene = scene_named("chaos");
  const sim_t run = sim_at_start(scene, &scene->params, 0);
  CHECK(run.x.r == TF_R(0.18));
  CHECK(run.x.w == TF_R(-1.037));
  CHECK(scene->h == TF_R(1e-10));
  CHECK(!scene->v_is_given);
  CHECK_NEAR(wide(run.report.slip.h), 1e-10L, 4 * EPSILON);
  const tf_params_t *p = &scene->params;
  CHECK(p->law == TF_TYRE_JUMP && p->rule == TF_RULE_PERSIST);
}

/* A step goes on where the one before has come to, but for jumps at its start;
 * so all that omega0 does between two instants is alpha, and jumps. */
static real path_of(const tf_scene_t *scene, const tf_machine_t *k,
                    uint64_t ticks, int *jumps) {
  real omega0 = wide(tf_scene_input(scene, k, 0).omega0), moved = 0;
  for (uint64_t n = 1; n <= ticks; n++) {
    const tf_input_t u = tf_scene_input(scene, k, n);
    const real start = wide(u.omega0) - wide(u.alpha) * wide(k->dt);
    *jumps += fabsl(start - omega0) > 1e-3L;
    moved += wide(u.alpha) * wide(k->dt);
    omega0 = wide(u.omega0);
  }
  return moved;
}

/* Two knots at one time are a jump. On the boundary of two steps it acts
 * between them, also where neither dt nor its time is a binary number; within a
 * step it acts at the start of that step. alpha has nothing of it. */
TEST(a_profile_may_jump) {
  tf_scene_t scene = *scene_named("driven");
  tf_machine_t k = prepared(&scene.params);
  const tf_knot_t knots[] = {
      {0, 1}, {TF_R(0.7), 2}, {TF_R(0.7), -1}, {TF_R(1.4), -3}};
  memcpy(scene.profile, knots, sizeof knots);
  scene.knots = 4;
  const real dts[] = {0.1L, 0.07L, 0.01L, 0.35L, 0.0007L, 1e-4L, 0.4L, 0.3L};
  for (int i = 0; i < 8; i++) {
    k.dt = (tf_real_t)dts[i];
    const real n = roundl(0.7L / dts[i]);
    const bool within = fabsl(n * dts[i] - 0.7L) > 1e-6L;
    const uint64_t before = (uint64_t)(within ? floorl(0.7L / dts[i]) : n);
    const tf_input_t last = tf_scene_input(&scene, &k, before);
    const tf_input_t next = tf_scene_input(&scene, &k, before + 1);
    const real dt = wide(k.dt), end = (before + 1) * dt;
    const real from = before * dt, off = 8 * EPSILON / dt;
    CHECK_NEAR(wide(last.omega0), 1 + from / 0.7L, 8 * EPSILON);
    CHECK_NEAR(wide(last.alpha), 1 / 0.7L, off);
    CHECK_NEAR(wide(next.omega0), end < 1.4L ? -1 - (end - 0.7L) / 0.35L : -3,
               16 * EPSILON);
    const real rises = within ? 0.7L - from : 0, falls = fminl(end, 1.4L);
    CHECK_NEAR(wide(next.alpha) * dt,
               rises / 0.7L - (falls - from - rises) / 0.35L, off);
    int jumps = 0;
    CHECK_NEAR(path_of(&scene, &k, (uint64_t)(2 / dts[i]), &jumps), -1,
               EPSILON * 16 / dt);
    CHECK(jumps == 1);
  }
  /* What follows the last knot in memory is not a knot. */
  for (scene.knots = 1; scene.knots <= 3; scene.knots++)
    for (uint64_t tick = 20000; tick < 20005; tick++) {
      const tf_input_t u = tf_scene_input(&scene, &k, tick);
      CHECK(u.omega0 == knots[scene.knots - 1].omega0 && u.alpha == 0);
      CHECK(tf_scene_input(&scene, &k, UINT64_MAX - tick).omega0 == u.omega0);
    }
}

/* The start has the speed at t = 0 and the alpha with which the first step sets
 * out, and a turntable that is moved on has the mean over the step. */
TEST(the_turntable_is_moved_on) {
  const tf_scene_t *scene = scene_named("driven");
  const tf_machine_t k = prepared(&scene->params);
  const tf_input_t start = tf_scene_input(scene, &k, 0);
  tf_input_t input = start;
  CHECK(input.omega0 == scene->profile[0].omega0);
  for (uint64_t n = 1; n <= 50000; n++) {
    const tf_input_t want = tf_scene_input(scene, &k, n);
    tf_turntable_to(&input, want.omega0, k.dt);
    CHECK(input.omega0 == want.omega0 && input.alpha == want.alpha);
    CHECK(input.r0 == start.r0);
    if (n == 1) CHECK(start.alpha == input.alpha && input.alpha != 0);
  }
  tf_turntable_to(&input, input.omega0, k.dt);
  CHECK(input.alpha == 0);
}
