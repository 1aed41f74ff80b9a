// One run of one problem for tools/bench/compensated.py: prints the end state
// r v w phi, the largest |h| in stick, changes of mode.
//
//   compensated PROBLEM DOUBLINGS STEPS plain|carried [REFINEMENT]
//
// The step is 2^DOUBLINGS us / REFINEMENT, the run STEPS us long. In both real
// types the parameters and 1 us are rounded to float first, and the start is
// the same to all digits, so that nothing but the step differs.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rounded.h"
#include "twofold.h"

// A scene or a variant of it.
typedef struct {
  const char *name, *scene;
  tf_real_t mu, omega0, r, omega, v; // where mu > 0
} problem_t;

static const problem_t problems[] = {
    {.name = "rolling", .scene = "rolling"},
    {.name = "chaos", .scene = "chaos"},
    {.name = "frictionless", .scene = "frictionless"},
    {"slip", "chaos", TF_R(0.2), 5, TF_R(0.3), TF_R(0.5), 2},
    {"coulomb-slip", "coulomb", TF_R(0.2), 5, TF_R(0.3), TF_R(0.5), 2}};

static const problem_t *problem_of(const char *name) {
  for (size_t i = 0; i < sizeof problems / sizeof *problems; i++)
    if (strcmp(problems[i].name, name) == 0) return &problems[i];
  return NULL;
}

static const tf_scene_t *scene_of(const problem_t *problem) {
  const tf_scene_t *scene = NULL;
  for (int i = 0; i < TF_SCENES; i++)
    if (strcmp(tf_scenes[i]->name, problem->scene) == 0) scene = tf_scenes[i];
  return scene;
}

typedef struct {
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t carry;
  tf_input_t input;
} run_t;

static tf_status_t begin(run_t *run, const problem_t *problem, tf_real_t dt) {
  const tf_scene_t *scene = scene_of(problem);
  tf_params_t params = scene->params;
  tf_report_t report;
  memset(run, 0, sizeof *run);
  run->state.r = TO_FLOAT(scene->r);
  run->state.w = TO_FLOAT(scene->omega);
  if (problem->mu > 0) {
    params.mu = problem->mu;
    params.omega0 = problem->omega0;
    run->state.r = TO_FLOAT(problem->r);
    run->state.w = TO_FLOAT(problem->omega);
  }
  round_params(&params);
  params.dt = dt;
  params.with_angle = true;
  tf_status_t status = tf_prepare_compensated(&run->machine, &params, NULL);
  if (status != TF_OK) return status;
  run->input = tf_input_default(&run->machine.machine);
  run->state.mode = scene->h > 0 ? TF_SLIP_PLUS : TF_NO_MODE;
  run->state.v = problem->v;
  if (!(problem->mu > 0))
    status =
        tf_speed_for_slip_compensated(&run->machine, &run->state, &run->carry,
                                      run->input.omega0, TO_FLOAT(scene->h));
  if (status != TF_OK) return status;
  return tf_begin(&run->machine.machine, &run->state, &run->input, &report);
}

static int go(run_t *run, long steps, int carried) {
  tf_report_t report;
  long changes = 0;
  double worst = 0;
  for (long i = 0; i < steps; i++) {
    const uint8_t before = run->state.mode;
    const tf_status_t status =
        carried
            ? tf_step_compensated(&run->machine, &run->state, &run->carry,
                                  &run->input, &report)
            : tf_step(&run->machine.machine, &run->state, &run->input, &report);
    if (status < 0) {
      fprintf(stderr, "step %ld: %s\n", i, tf_status_name(status));
      return 1;
    }
    changes += run->state.mode != before;
    if (run->state.mode > TF_SLIP_MINUS)
      worst = fmax(worst, fabs((double)report.slip.h));
  }
  const tf_state_t *x = &run->state;
  const tf_compensation_t *c = &run->carry;
  printf("%.17g %.17g %.17g %.17g %.2g %ld\n", (double)x->r + (double)c->r,
         (double)x->v + (double)c->v, (double)x->w + (double)c->w,
         (double)x->phi + (double)c->phi, worst, changes);
  return 0;
}

int main(int argc, char **argv) {
  const problem_t *problem = argc > 4 ? problem_of(argv[1]) : NULL;
  if (!problem || argc > 6) {
    fputs("usage: compensated PROBLEM DOUBLINGS STEPS plain|carried [N]\n",
          stderr);
    return 2;
  }
  const int doublings = atoi(argv[2]), carried = !strcmp(argv[4], "carried");
  const long refinement = argc > 5 ? atol(argv[5]) : 1;
  const double dt = ldexp((double)1e-6f, doublings) / (double)refinement;
  run_t run;
  const tf_status_t status = begin(&run, problem, (tf_real_t)dt);
  if (status != TF_OK) {
    fprintf(stderr, "%s: %s\n", problem->name, tf_status_name(status));
    return 1;
  }
  // Plain runs start from the rounded state.
  return go(&run, (atol(argv[3]) >> doublings) * refinement, carried);
}
