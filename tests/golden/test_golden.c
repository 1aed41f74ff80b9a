/* Trajectory hashes: one number per scene and scheme over 1e5 steps, the same
 * for every compiler, optimisation level and target of a real type. A hash
 * changes only in a commit that says which arithmetic changed and why. */
#include "population.h"
#include "sim.h"

/* Over the bits of r, v, w and phi, mode and set. A printed trajectory cannot
 * show the sign of 0, so that it does not count. */
static uint64_t trajectory_hash(const tf_scene_t *scene, tf_rule_t rule,
                                scheme_t scheme) {
  tf_params_t p = scene->params;
  draw_t d = population(0);
  p.rule = rule;
  sim_t s = sim_at_start(scene, &p, 1);
  for (int i = 1; i <= 100000; i++) {
    s.u = tf_scene_input(scene, &s.k, (uint64_t)i);
    CHECK(sim_step(&s, scheme) >= 0);
    mix_real(&d, s.x.r);
    mix_real(&d, s.x.v);
    mix_real(&d, s.x.w);
    mix_real(&d, s.x.phi);
    mix_small(&d, s.report.mode);
    mix_small(&d, s.report.set);
  }
  return d.hash;
}

static const struct {
  const char *scene;
  tf_rule_t rule;
  scheme_t scheme;
  uint64_t f64, f32;
} golden[] = {
#include "golden.inc"
};

TEST(golden_trajectories) {
  const int count = (int)(sizeof golden / sizeof *golden);
  for (int n = 0; n < TF_SCENES; n++) {
    int rows = 0;
    for (int i = 0; i < count; i++)
      rows += !strcmp(golden[i].scene, tf_scenes[n]->name);
    if (!CHECK(rows > 0)) printf("#   no hash of %s\n", tf_scenes[n]->name);
  }
  for (int i = 0; i < count; i++) {
    const uint64_t want = IS_DOUBLE ? golden[i].f64 : golden[i].f32;
    const uint64_t got = trajectory_hash(scene_named(golden[i].scene),
                                         golden[i].rule, golden[i].scheme);
    if (!CHECK(got == want))
      printf("#   %s, rule %d, scheme %d: 0x%016" PRIX64 "\n", golden[i].scene,
             (int)golden[i].rule, (int)golden[i].scheme, got);
  }
}
