// The program that measures, one for each real type: the project's own schemes,
// as a program would call them, and what the files of its other commands say.
#include "own.h"

#include <stdio.h>
#include <string.h>

motion_scheme_t scheme_named(const char *name) {
  unsigned i = 0;
  while (i < MOTION_SCHEMES && strcmp(name, motion_scheme_name(i)) != 0) i++;
  return (motion_scheme_t)i;
}

// A member of the state, and what rounding it leaves over.
static void split(long double x, tf_real_t *high, tf_real_t *low) {
  *high = (tf_real_t)x;
  *low = (tf_real_t)(x - (long double)*high);
}

tf_status_t run_begin(run_t *run, const problem_t *problem,
                      motion_scheme_t scheme, long n, double tolerance,
                      int segments) {
  tf_params_t params = problem->params;
  tf_machine_t *machine = &run->motion.machine.machine;
  motion_start_t start = {.state = {.mode = problem->mode}};
  tf_compensation_t low = {0};
  *run = (run_t){.scheme = scheme};
  if (scheme == MOTION_SCHEMES) return TF_BAD_PARAMETER;
  params.dt = (tf_real_t)(problem->length / (double)n);
  params.segments = (tf_real_t)segments;
  if (tolerance <= 1e-2) params.tolerance = (tf_real_t)tolerance;
  tf_status_t status = motion_prepare(&run->motion, scheme, &params, NULL);
  if (status != TF_OK) return status;
  if (tolerance > 1e-2) machine->tolerance = (tf_real_t)tolerance;
  run->input = tf_input_default(machine);
  split(problem->start[0], &start.state.r, &low.r);
  split(problem->start[1], &start.state.v, &low.v);
  split(problem->start[2], &start.state.w, &low.w);
  status = motion_begin(&run->motion, scheme, &start, &run->input);
  if (scheme == MOTION_COMPENSATED) run->motion.low = low;
  return status;
}

// The numbers: dt, and of located tolerance and segments; behind them theta.
static void solve(const problem_t *problem, const char *solver,
                  const double number[NUMBERS], answer_t *answer) {
  const motion_scheme_t scheme = scheme_named(solver);
  const long steps = harness_steps(problem, number[0]);
  problem_t q = *problem;
  run_t run;
  q.params.theta = (tf_real_t)number[3];
  tf_status_t status =
      run_begin(&run, &q, scheme, steps, number[1], (int)number[2]);
  const double omega0 = (double)q.params.omega0;
  run.input.alpha = (tf_real_t)q.alpha;
  answer->flagged = 0;
  for (long i = 0; i < steps && status >= 0; i++) {
    if (q.alpha > 0)
      run.input.omega0 =
          (tf_real_t)(omega0 +
                      q.alpha * q.length * (double)(i + 1) / (double)steps);
    status = run_step(&run);
    answer->flagged += status > 0;
  }
  const tf_state_t *x = &run.motion.state;
  const tf_compensation_t *c = &run.motion.low;
  answer->x[0] = (double)x->r + (double)c->r;
  answer->x[1] = (double)x->v + (double)c->v;
  answer->x[2] = (double)x->w + (double)c->w;
  answer->lost = status < 0;
  answer->mode = x->mode;
}

int main(int argc, char **argv) {
  const char *command = argc > 1 ? argv[1] : "";
  const int code =
      strcmp(command, "single") == 0     ? single_main(argc - 1, argv + 1)
      : strcmp(command, "ensemble") == 0 ? ensemble_main()
                                         : harness_main(argc, argv, solve);
  if (code == 2)
    fputs("bench: time|count|problems, single, ensemble; see tools/bench/*.c\n",
          stderr);
  return code;
}
