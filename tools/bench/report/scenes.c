// What is left of a step's accuracy in float over many small steps, scene by
// scene.
//
//   scenes STEPS SCENE...   prints lines `run dt real scheme r v w` for each
//                           scene, in double the reference, too; dt = 1e-6 s
//
// As in digits.c parameters, start, step and here inputs are rounded to float
// first in both real types. The reference is the located step in double, which
// is exact to rounding; of a law that it does not take, the compensated step at
// an eighth of the step. A turntable that is driven has its speed rounded to
// float in every step but the reference's.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/steps/rounded.h"
#include "part.h"

#define COARSE 244 // small steps in one of the reference: 4096 a second
#define FINE 8     // steps of the reference in a small one

// Turntable's speed in double, whatever the real type.
static double speed_at(const tf_scene_t *scene, double t) {
  const tf_knot_t *knot = scene->profile;
  int i = 0;
  if (scene->knots == 0) return (double)scene->params.omega0;
  while (i + 1 < scene->knots && (double)knot[i + 1].t <= t) i++;
  const double speed = (double)knot[i].omega0;
  if (i + 1 == scene->knots) return speed;
  return speed + ((double)knot[i + 1].omega0 - speed) *
                     (t - (double)knot[i].t) /
                     ((double)knot[i + 1].t - (double)knot[i].t);
}

static tf_input_t input_at(const run_t *run, const tf_scene_t *scene, double t,
                           double dt, int rounded) {
  tf_input_t input = run->input;
  if (scene->knots == 0) return input;
  const double now = speed_at(scene, t);
  input.omega0 = rounded ? TO_FLOAT(now) : (tf_real_t)now;
  input.alpha = TO_FLOAT((now - speed_at(scene, t - dt)) / dt);
  return input;
}

static int begin(run_t *run, const tf_scene_t *scene, double dt) {
  tf_params_t params = scene->params;
  round_params(&params);
  params.dt = (tf_real_t)dt;
  params.tolerance = 0;
  params.with_angle = false;
  if (tf_prepare_compensated(&run->machine, &params, NULL) != TF_OK) return 0;
  run->input = tf_input_default(&run->machine.machine);
  run->state.r = TO_FLOAT(scene->r);
  run->state.v = TO_FLOAT(scene->v);
  run->state.w = TO_FLOAT(scene->omega);
  run->state.mode = TF_NO_MODE;
  const tf_machine_t *machine = &run->machine.machine;
  const tf_real_t h = TO_FLOAT(scene->h);
  // The mode goes by the sign of h; then v gets the digits that h needs.
  if (!scene->v_is_given &&
      (tf_begin_with_slip(machine, &run->state, &run->input, h, &run->report) !=
           TF_OK ||
       tf_speed_for_slip_compensated(&run->machine, &run->state,
                                     &run->compensation, run->input.omega0,
                                     h) != TF_OK))
    return 0;
  return tf_begin(machine, &run->state, &run->input, &run->report) >= 0;
}

// One run of n steps of dt; `of` steps are in the name of the row.
static int print_end(const tf_scene_t *scene, long of, scheme_t scheme, long n,
                     double dt, const char *name) {
  run_t run = {.scheme = scheme};
  const int rounded = strcmp(name, "reference") != 0;
  if (!begin(&run, scene, dt)) return 0;
  for (long i = 0; i < n; i++) {
    if (scene->knots > 0)
      run.input = input_at(&run, scene, (double)(i + 1) * dt, dt, rounded);
    if (part_step(&run) < 0) return 0;
  }
  printf("%s/%.0e ", scene->name, (double)of);
  part_print_end(&run, dt, name);
  return 1;
}

static int print_scene(const tf_scene_t *scene, long steps) {
  const double dt = (double)1e-6f, length = (double)steps * dt;
  const tf_tyre_law_t law = scene->params.law;
  const int located =
      law == TF_TYRE_JUMP || law == TF_TYRE_COULOMB || law == TF_TYRE_NONE;
  const long n = located ? (steps + COARSE - 1) / COARSE : steps * FINE;
  const int wide = sizeof(tf_real_t) == 8;
  if (wide && !print_end(scene, steps, located ? LOCATED : COMPENSATED, n,
                         length / (double)n, "reference"))
    return 0;
  return print_end(scene, steps, COMPENSATED, steps, dt, "compensated") &&
         print_end(scene, steps, MOREAU, steps, dt, "plain");
}

int main(int argc, char **argv) {
  const long steps = argc > 2 ? strtol(argv[1], NULL, 10) : 0;
  if (steps <= 0) {
    fputs("usage: scenes STEPS SCENE...\n", stderr);
    return 2;
  }
  for (int i = 2; i < argc; i++) {
    int j = 0;
    while (j < TF_SCENES && strcmp(tf_scenes[j]->name, argv[i]) != 0) j++;
    if (j == TF_SCENES || !print_scene(tf_scenes[j], steps)) {
      fprintf(stderr, "%s: no such scene, or it was refused\n", argv[i]);
      return 1;
    }
  }
  return 0;
}
