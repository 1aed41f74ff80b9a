/* Trajectory hashes: one number per scene and scheme over 1e5 steps, the same
 * for every compiler, optimisation level and target of a real type. A hash
 * changes only in a commit that says which arithmetic changed and why. */
#include "scene_named.h"
#include "sim.h"

/* FNV-1a over the bits of r, v, w and phi (-0 counted as 0: no two targets
 * differ in it, but a printed trajectory cannot show it), mode and set. */
static uint64_t mix(uint64_t hash, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++) hash = (hash ^ byte[i]) * 0x100000001B3u;
  return hash;
}

static uint64_t trajectory_hash(const tf_scene_t *scene, tf_rule_t rule,
                                scheme_t scheme) {
  tf_params_t p = scene->params;
  uint64_t hash = 0xCBF29CE484222325u;
  p.rule = rule;
  sim_t s = sim_at_start(scene, &p, 1);
  for (int i = 1; i <= 100000; i++) {
    s.u = tf_scene_input(scene, &s.k, (uint64_t)i);
    CHECK(sim_step(&s, scheme) >= 0);
    const tf_real_t bits[4] = {s.x.r + 0, s.x.v + 0, s.x.w + 0, s.x.phi + 0};
    const unsigned char modes[2] = {s.report.mode, s.report.set};
    hash = mix(hash, bits, sizeof bits);
    hash = mix(hash, modes, sizeof modes);
  }
  return hash;
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
