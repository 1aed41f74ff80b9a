// On the target: hashes that tests/golden computes with the library. Prints
// "trajectory SCENE REAL STEPS HASH" of the scene, and ends with what
// tf_arithmetic finds: 0. A generic firmware prints "population REAL HASH" of
// the steps of random machines; where OTHERS is given, first the trajectory of
// its scene, then of those whose bits OTHERS has.
#include "../../port/core.h"
// After the core, whose functions are local.
#include "../golden/population.h"
#include "say.h"

static void say_hash(const char *what, const char *name, uint32_t steps,
                     uint64_t hash) {
  uint8_t line[96];
  text_t text = {line};
  text_string(&text, what);
  text_string(&text, name);
  text_string(&text, sizeof(tf_real_t) == 8 ? " double " : " float ");
  if (steps > 0) {
    text_whole(&text, steps, 1);
    text_byte(&text, ' ');
  }
  text_hex(&text, hash);
  say(line, &text);
}

static bool begin(const tf_scene_t *scene, tf_state_t *x, tf_report_t *report) {
#ifdef SCENE_HEADER
  (void)scene;
  return scene_begin(x, report) && scheme_begin();
#else
  return begin_given_scene(scene, x, report) && scheme_begin();
#endif
}

static uint64_t trajectory_hash(const tf_scene_t *scene, uint32_t steps) {
  static tf_state_t x;
  static tf_report_t report;
  draw_t hash = population(0);
  if (!begin(scene, &x, &report)) return 0;
  for (uint32_t i = 1; i <= steps; i++) {
    const tf_input_t input = tf_scene_input(scene, SCENE_MACHINE, i);
    if (scheme_step(SCENE_MACHINE, &x, &input, &report) < 0) return 0;
    mix_real(&hash, x.r);
    mix_real(&hash, x.v);
    mix_real(&hash, x.w);
    mix_real(&hash, x.phi);
    mix_small(&hash, report.mode);
    mix_small(&hash, report.set);
  }
  return hash.hash;
}

static void say_trajectory(const tf_scene_t *scene) {
  say_hash("trajectory ", scene->name, STEPS, trajectory_hash(scene, STEPS));
}

#ifdef SCENE_HEADER
static void say_all(void) { say_trajectory(SCENE); }
#else

#ifdef SCHEME_LOCATED
#define MACHINES 100
#define STEPS_OF_EACH 2
#else
#define MACHINES 300
#define STEPS_OF_EACH 6
#endif

static void say_all(void) {
#ifdef OTHERS
  say_trajectory(SCENE);
  for (unsigned i = 0; i < TF_SCENES; i++)
    if (OTHERS >> i & 1u) say_trajectory(tf_scenes[i]);
#endif
  say_hash("population", "", 0,
           hash_of_steps(scheme_step, MACHINES, STEPS_OF_EACH));
}
#endif

int main(void) {
  port_init();
  say_all();
  port_halt(tf_arithmetic());
}
