// What is left of a step's accuracy in float over many small steps.
//
//   rounded STEPS NAME...   for each scene or problem lines
//                           `run,dt,real,scheme,r,v,w`, in double of the
//                           reference, too; dt = 1e-6 s, or with STEPS = 0 on
//                           problems dt = 2^-8 to 2^-20 s to their end
//
// Parameters, start, step and inputs are rounded to float first in both real
// types, so that nothing but the step differs. The reference is the located
// step in double, which is exact to rounding; of a law that it does not take,
// the compensated step at an eighth of the step. A turntable that is driven has
// its speed rounded to float in every step but the reference's.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "own.h"

#define TO_FLOAT(x) ((tf_real_t)(float)(x))
#define COARSE 244 // small steps in one of the reference: 4096 a second
#define FINE 8     // steps of the reference in a small one
#define FINEST 20

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

static void round_params(tf_params_t *params) {
  for (int i = 0; i < TF_PARAMETERS; i++) {
    char *member = (char *)params + tf_parameter_ranges[i].offset;
    tf_real_t value;
    memcpy(&value, member, sizeof value);
    value = TO_FLOAT(value);
    memcpy(member, &value, sizeof value);
  }
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

// One run of n steps of dt, the end of which is printed as that of steps of
// `of`. A run that carries its rounding ends at the sum.
static int print_end(const tf_scene_t *scene, double of, scheme_t scheme,
                     long n, double dt, const char *name) {
  run_t run = {.scheme = scheme};
  const int rounded = strcmp(name, "reference") != 0;
  if (!begin(&run, scene, dt)) return 0;
  for (long i = 0; i < n; i++) {
    if (scene->knots > 0)
      run.input = input_at(&run, scene, (double)(i + 1) * dt, dt, rounded);
    if (run_step(&run) < 0) return 0;
  }
  const tf_state_t *s = &run.state;
  const tf_compensation_t *c = &run.compensation;
  const tf_real_t high[3] = {s->r, s->v, s->w}, low[3] = {c->r, c->v, c->w};
  printf("%s,%.3e,%s,%s", scene->name, of, REAL, name);
  for (int i = 0; i < 3; i++)
    printf(",%.17g",
           (double)high[i] + (scheme == COMPENSATED ? (double)low[i] : 0));
  printf("\n");
  return 1;
}

static int print_both(const tf_scene_t *scene, double of, long n, double dt) {
  return print_end(scene, of, COMPENSATED, n, dt, "compensated") &&
         print_end(scene, of, MOREAU, n, dt, "plain");
}

static int print_scene(const tf_scene_t *scene, long steps) {
  const double dt = (double)1e-6f, length = (double)steps * dt;
  const tf_tyre_law_t law = scene->params.law;
  const int located =
      law == TF_TYRE_JUMP || law == TF_TYRE_COULOMB || law == TF_TYRE_NONE;
  const long n = located ? (steps + COARSE - 1) / COARSE : steps * FINE;
  char name[64];
  tf_scene_t named = *scene;
  snprintf(name, sizeof name, "%s/%.0e", scene->name, (double)steps);
  named.name = name;
  if (sizeof(tf_real_t) == 8 &&
      !print_end(&named, dt, located ? LOCATED : COMPENSATED, n,
                 length / (double)n, "reference"))
    return 0;
  return print_both(&named, dt, steps, dt);
}

static int print_problem(const problem_t *problem) {
  const tf_scene_t scene = {.name = problem->name,
                            .params = problem->params,
                            .r = (tf_real_t)problem->start[0],
                            .omega = (tf_real_t)problem->start[2],
                            .h = (tf_real_t)problem->h};
  int done =
      sizeof(tf_real_t) != 8 ||
      print_end(&scene, ldexp(1, -12), LOCATED,
                lrint(ldexp(problem->length, 12)), ldexp(1, -12), "reference");
  for (int k = 8; k <= FINEST && done; k += 2)
    done = print_both(&scene, ldexp(1, -k), lrint(ldexp(problem->length, k)),
                      ldexp(1, -k));
  return done;
}

int rounded_main(int argc, char **argv) {
  if (argc < 3) return 2;
  const long steps = strtol(argv[1], NULL, 10);
  for (int i = 2; i < argc; i++) {
    problem_t problem;
    int j = 0, done = 0;
    while (j < TF_SCENES && strcmp(tf_scenes[j]->name, argv[i]) != 0) j++;
    if (steps == 0 && problem_named(argv[i], &problem))
      done = print_problem(&problem);
    else if (steps > 0 && j < TF_SCENES)
      done = print_scene(tf_scenes[j], steps);
    if (done) continue;
    fprintf(stderr, "%s: no such scene or problem, or it was refused\n",
            argv[i]);
    return 1;
  }
  return 0;
}
