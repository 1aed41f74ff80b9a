/* Trajectory hashes: one number per scene and scheme over 1e5 steps, the same
 * for every compiler, optimisation level and target of a real type. A hash
 * changes only in a commit that says which arithmetic changed and why. */
#include "tap.h"
#include "twofold.h"

/* FNV-1a over the bits of r, v, w and phi (-0 counted as 0: no two targets
 * differ in it, but a printed trajectory cannot show it), mode and set. */
static uint64_t mix(uint64_t hash, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++) hash = (hash ^ byte[i]) * 0x100000001B3u;
  return hash;
}

typedef enum { MOREAU, LOCATED, COMPENSATED } scheme_t;

typedef struct {
  tf_compensated_t machine;
  tf_compensation_t compensation;
} build_t;

static tf_status_t step(scheme_t scheme, build_t *b, tf_state_t *x,
                        const tf_input_t *u, tf_report_t *report) {
  if (scheme == LOCATED)
    return tf_step_located(&b->machine.machine, x, u, report);
  if (scheme == COMPENSATED)
    return tf_step_compensated(&b->machine, x, &b->compensation, u, report);
  return tf_step(&b->machine.machine, x, u, report);
}

static uint64_t trajectory_hash(const tf_scene_t *scene, tf_rule_t rule,
                                scheme_t scheme) {
  tf_params_t p = scene->params;
  build_t b;
  tf_state_t x;
  tf_report_t report;
  uint64_t hash = 0xCBF29CE484222325u;
  memset(&x, 0, sizeof x);
  memset(&b, 0, sizeof b);
  p.rule = rule;
  CHECK(tf_prepare_compensated(&b.machine, &p, NULL) == TF_OK);
  const tf_machine_t *machine = &b.machine.machine;
  CHECK(tf_scene_start(scene, machine, 1, &x, &report) == TF_OK);
  for (int i = 1; i <= 100000; i++) {
    const tf_input_t u =
        tf_scene_input(scene, machine, (tf_real_t)i * machine->dt);
    CHECK(step(scheme, &b, &x, &u, &report) >= 0);
    const tf_real_t bits[4] = {x.r + 0, x.v + 0, x.w + 0, x.phi + 0};
    const unsigned char modes[2] = {report.mode, report.set};
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
  CHECK(count >= TF_SCENES);
  for (int i = 0; i < count; i++) {
    const uint64_t want =
        sizeof(tf_real_t) == 8 ? golden[i].f64 : golden[i].f32;
    const tf_scene_t *scene = NULL;
    for (int j = 0; j < TF_SCENES; j++)
      if (!strcmp(tf_scenes[j]->name, golden[i].scene)) scene = tf_scenes[j];
    if (!CHECK(scene != NULL)) return;
    const uint64_t got =
        trajectory_hash(scene, golden[i].rule, golden[i].scheme);
    if (!CHECK(got == want))
      printf("#   %s, rule %d, scheme %d: 0x%016" PRIX64 "\n", golden[i].scene,
             (int)golden[i].rule, (int)golden[i].scheme, got);
  }
}
