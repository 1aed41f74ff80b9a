// The project's own schemes over all problems, as a program would call them.
// The located step takes part with its tolerance as the dial at
// several lengths of the step, with its step as the dial at the tolerance 1e-8
// and, `order`, at one that never splits it; and within budgets of segments.
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

static void solve(const problem_t *problem, scheme_t scheme, long steps,
                  double tolerance, int segments, answer_t *answer) {
  run_t run;
  tf_status_t status =
      run_begin(&run, problem, scheme, steps, tolerance, segments);
  const double omega0 = (double)problem->params.omega0;
  run.input.alpha = (tf_real_t)problem->alpha;
  answer->flagged = 0;
  for (long i = 0; i < steps && status >= 0; i++) {
    if (problem->alpha > 0)
      run.input.omega0 =
          (tf_real_t)(omega0 + problem->alpha * problem->length *
                                   (double)(i + 1) / (double)steps);
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

// second: of the located step its tolerance.
static void by_step(const problem_t *problem, const solver_t *solver, double dt,
                    answer_t *answer) {
  solve(problem, (scheme_t)solver->method, harness_steps(problem, dt),
        solver->second, 0, answer);
}

// With theta = 1, which damps what the step does not resolve.
static void damped(const problem_t *problem, const solver_t *solver, double dt,
                   answer_t *answer) {
  problem_t q = *problem;
  q.params.theta = 1;
  by_step(&q, solver, dt, answer);
}

static void tolerant(const problem_t *problem, const solver_t *solver,
                     double tolerance, answer_t *answer) {
  solve(problem, LOCATED, harness_steps(problem, solver->second), tolerance, 0,
        answer);
}

// At the tolerance 1e-9; second: thousandths of the budget.
static void budget(const problem_t *problem, const solver_t *solver, double dt,
                   answer_t *answer) {
  solve(problem, LOCATED, harness_steps(problem, dt), 1e-9,
        (int)(1e3 * solver->second), answer);
}

// What the located step takes.
#define HOLDS (EVERY - FROM(ONE_FIELD))
// Dials; a single setting is no grid.
#define DT(coarse, fine, factor) "dt", coarse, fine, factor
#define ONLY(dt) "dt", dt, dt, 1
#define STEP(step)                                                             \
  {                                                                            \
    "located step=" #step, "tol", 1e-3, sizeof(tf_real_t) == 8 ? 2e-14 : 1e-5, \
        1.8, step, HOLDS, LOCATED, tolerant                                    \
  }
#define MOST(name, segments) \
  { "located " name, ONLY(1e-3), segments, HOLDS, LOCATED, budget }

int sweep_main(int argc, char **argv) {
  // Long steps run out of segments at the finest tolerances.
  const solver_t solvers[] = {
      {"moreau", DT(0.1, 1e-6, 1.3), 0, EVERY, MOREAU, by_step},
      {"compensated", DT(0.1, 3e-6, 1.8), 0, EVERY, COMPENSATED, by_step},
      {"moreau-1", DT(0.1, 1e-6, 1.3), 0, FROM(STIFF), MOREAU, damped},
      {"located", DT(0.5, 1e-4, 1.25), 1e-8, HOLDS, LOCATED, by_step},
      {"located order", DT(0.1, 3e-4, 1.25), 0.1, HOLDS, LOCATED, by_step},
      STEP(1),
      STEP(0.2),
      STEP(0.1),
      STEP(0.05),
      STEP(0.02),
      STEP(0.005),
      {"moreau", ONLY(1e-3), 0, EVERY, MOREAU, by_step},
      {"moreau", ONLY(1e-3 / 3), 0, EVERY, MOREAU, by_step},
      MOST("segments=1", 1e-3),
      MOST("segments=2", 2e-3),
      MOST("segments=8", 8e-3),
      MOST("1 kHz", 0),
      {"moreau", ONLY(1e-4), 0, EVERY, MOREAU, by_step}};
  return harness_main(argc, argv, solvers,
                      (int)(sizeof solvers / sizeof *solvers));
}

// The program that measures, one for each real type: `bench COMMAND ...`, as
// the file of each command says.
#define COMMAND(name) {#name, name##_main},

int main(int argc, char **argv) {
  static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
  } commands[] = {BENCH_COMMANDS(COMMAND)};
  int code = 2;
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
    if (argc > 1 && strcmp(argv[1], commands[i].name) == 0)
      code = commands[i].run(argc - 1, argv + 1);
  if (code == 2)
    fputs(
        "bench: sweep time|count|problems, single, ensemble; see "
        "tools/bench/*.c\n",
        stderr);
  return code;
}
