// The program that measures, one for each real type: the project's own schemes,
// as a program would call them, and what the files of its other commands say.
#include "own.h"

#include <stdio.h>
#include <string.h>

const char *const scheme_names[SCHEMES] = {"moreau", "compensated", "located"};

scheme_t scheme_named(const char *name) {
  int i = 0;
  while (i < SCHEMES && strcmp(name, scheme_names[i]) != 0) i++;
  return (scheme_t)i;
}

// A member of the state, and what rounding it leaves over.
static void split(long double x, tf_real_t *high, tf_real_t *low) {
  *high = (tf_real_t)x;
  *low = (tf_real_t)(x - (long double)*high);
}

tf_status_t run_begin(run_t *run, const problem_t *problem, scheme_t scheme,
                      long n, double tolerance, int segments) {
  tf_params_t params = problem->params;
  *run = (run_t){.scheme = scheme};
  if (scheme == SCHEMES) return TF_BAD_PARAMETER;
  params.dt = (tf_real_t)(problem->length / (double)n);
  params.segments = (tf_real_t)segments;
  if (tolerance <= 1e-2) params.tolerance = (tf_real_t)tolerance;
  const tf_status_t status =
      scheme == COMPENSATED
          ? tf_prepare_compensated(&run->machine, &params, NULL)
          : tf_prepare(&run->machine.machine, &params, NULL);
  if (status != TF_OK) return status;
  if (tolerance > 1e-2) run->machine.machine.tolerance = (tf_real_t)tolerance;
  run->input = tf_input_default(&run->machine.machine);
  split(problem->start[0], &run->state.r, &run->compensation.r);
  split(problem->start[1], &run->state.v, &run->compensation.v);
  split(problem->start[2], &run->state.w, &run->compensation.w);
  run->state.mode = problem->mode;
  return tf_begin(&run->machine.machine, &run->state, &run->input,
                  &run->report);
}

// The numbers: dt, and of LOCATED tolerance and segments; behind them theta.
static void solve(const problem_t *problem, const char *solver,
                  const double number[NUMBERS], answer_t *answer) {
  const scheme_t scheme = scheme_named(solver);
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
  const tf_state_t *x = &run.state;
  const tf_compensation_t *c = &run.compensation;
  const int carries = scheme == COMPENSATED;
  answer->x[0] = (double)x->r + (carries ? (double)c->r : 0);
  answer->x[1] = (double)x->v + (carries ? (double)c->v : 0);
  answer->x[2] = (double)x->w + (carries ? (double)c->w : 0);
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
