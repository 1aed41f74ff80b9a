// One scheme on one problem of the peers, or in scene `rolling`, for callgrind
// and for its error.
//
//   profile PROBLEM plain|located DT TOLERANCE SEGMENTS
//
// prints the number of steps and the largest error of (r, v, w) at the end. A
// tolerance or a budget of segments of 0 is the default. `rolling` sticks
// throughout and has no reference; what the others are, tools/bench/peers/problem.c
// says.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/peers/problem.h"

typedef struct {
  tf_machine_t machine;
  tf_input_t input;
  tf_state_t state;
  tf_report_t report;
} run_t;

static int find_problem(const char *name, problem_t *problem) {
  for (int i = 0; i < PROBLEMS; i++) {
    *problem = problem_number(i);
    if (strcmp(problem->name, name) == 0) return 1;
  }
  for (int i = 0; i < TF_SCENES; i++) {
    const tf_scene_t *scene = tf_scenes[i];
    if (strcmp(scene->name, name) != 0 || strcmp(name, "rolling") != 0)
      continue;
    *problem = (problem_t){.name = scene->name,
                           .params = scene->params,
                           .r = scene->r,
                           .omega = scene->omega,
                           .h = scene->h,
                           .t_end = 2};
    return 1;
  }
  return 0;
}

static int begin(run_t *run, const problem_t *problem, double dt,
                 double tolerance, double segments) {
  tf_params_t params = problem->params;
  params.dt = dt;
  if (tolerance > 0) params.tolerance = tolerance;
  params.segments = segments;
  *run = (run_t){.state = {.r = problem->r, .w = problem->omega}};
  if (tf_prepare(&run->machine, &params, NULL) != TF_OK) return 0;
  run->input = tf_input_default(&run->machine);
  const tf_status_t status = tf_begin_with_slip(
      &run->machine, &run->state, &run->input, problem->h, &run->report);
  run->input.alpha = problem->alpha;
  return status == TF_OK;
}

static int follow(run_t *run, const problem_t *problem, int located,
                  long steps) {
  const double dt = run->machine.dt;
  for (long i = 1; i <= steps; i++) {
    run->input.omega0 =
        problem->params.omega0 + problem->alpha * (double)i * dt;
    const tf_status_t status =
        located
            ? tf_step_located(&run->machine, &run->state, &run->input,
                              &run->report)
            : tf_step(&run->machine, &run->state, &run->input, &run->report);
    if (status < 0) return 0;
  }
  return 1;
}

int main(int argc, char **argv) {
  problem_t problem;
  run_t run;
  const int located = argc == 6 && strcmp(argv[2], "located") == 0;
  if (argc != 6 || !(located || strcmp(argv[2], "plain") == 0) ||
      !find_problem(argv[1], &problem) || !(strtod(argv[3], NULL) > 0)) {
    fputs("usage: profile PROBLEM plain|located DT TOLERANCE SEGMENTS\n",
          stderr);
    return 2;
  }
  const long steps = (long)(problem.t_end / strtod(argv[3], NULL) + 0.5);
  if (!begin(&run, &problem, problem.t_end / (double)steps,
             strtod(argv[4], NULL), strtod(argv[5], NULL)) ||
      !follow(&run, &problem, located, steps))
    return 1;
  const double end[3] = {run.state.r, run.state.v, run.state.w};
  printf("%ld ", steps);
  if (problem.branch_error > 0)
    printf("%.1e\n", problem_error(&problem, end));
  else
    puts("-");
  return 0;
}
