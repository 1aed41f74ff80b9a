// The program that measures, one for each real type: the project's own schemes,
// as a program would call them; and what every single step of a run costs, for
// callgrind, which dumps its counter after every call of `sample`.
//
//   single SCHEME PROBLEM STEPS EVERY
//     every EVERYth step, every change of mode and, because they are rare and
//     dear, the first steps of slip
//   single SCHEME machines MACHINES STEPS DT
//     every step of random machines: those of the golden hashes where DT is 0,
//     else ordinary ones, about the size of the paper's, with its law
// They print a line a step: the modes before and after.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tests/golden/population.h"
#include "harness.h"
#include "motion.h"

typedef struct {
  motion_scheme_t scheme;
  motion_t motion;
  tf_input_t input;
} run_t;

static tf_status_t run_step(run_t *run) {
  return motion_step(&run->motion, run->scheme, &run->input);
}

// MOTION_SCHEMES where there is none of that name.
static motion_scheme_t scheme_named(const char *name) {
  unsigned i = 0;
  while (i < MOTION_SCHEMES && strcmp(name, motion_scheme_name(i)) != 0) i++;
  return (motion_scheme_t)i;
}

// A member of the state, and what rounding it leaves over.
static void split(long double x, tf_real_t *high, tf_real_t *low) {
  *high = (tf_real_t)x;
  *low = (tf_real_t)(x - (long double)*high);
}

// Begins a problem in n steps. A tolerance above the range of the parameter is
// put into the prepared machine, so that the step alone sets the error.
static tf_status_t run_begin(run_t *run, const problem_t *problem,
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

#define SLIPS 400

// Not static, or the compiler may make a form of it with another name.
tf_status_t sample(run_t *run);

__attribute__((noinline)) tf_status_t sample(run_t *run) {
  const tf_status_t status = run_step(run);
  __asm__ volatile("" ::: "memory"); // a tail call would leave the frame
  return status;
}

// The step from a state once more, with a line of its own.
static void look_at(run_t before, const run_t *after) {
  const char *const name = tf_mode_name(before.motion.state.mode);
  sample(&before);
  printf("%s,%s\n", name, tf_mode_name(after->motion.state.mode));
}

static int follow(run_t *run, long steps, long every) {
  int slips = 0;
  for (long i = 0; i < steps; i++) {
    const run_t before = *run;
    if (run_step(run) < 0) return 1;
    const uint8_t mode = before.motion.state.mode;
    const int slip = tf_mode_is_slip(mode) && slips < SLIPS;
    slips += slip;
    if (i % every != 0 && mode == run->motion.state.mode && !slip) continue;
    look_at(before, run);
  }
  return 0;
}

static tf_params_t ordinary_params(draw_t *d, tf_real_t dt) {
  tf_params_t p = usual_params(d);
  p.law = TF_TYRE_JUMP;
  p.theta = TF_R(0.5);
  p.dt = dt;
  return p;
}

// As hash_of_steps() of population.h does.
static int follow_machines(motion_scheme_t scheme, long machines, long steps,
                           tf_real_t dt) {
  draw_t d = population(1);
  for (long n = 0; n < machines; n++) {
    run_t run = {.scheme = scheme};
    tf_machine_t *k = &run.motion.machine.machine;
    tf_state_t *x = &run.motion.state;
    const tf_params_t p =
        dt > 0 ? ordinary_params(&d, dt) : any_params(&d, (unsigned)n);
    if (tf_prepare(k, &p, NULL) != TF_OK) continue;
    run.input = any_input(&d, k);
    *x = any_state(&d, k, &run.input);
    if ((n % 4 != 0 || x->mode == TF_NO_MODE) &&
        tf_begin(k, x, &run.input, &run.motion.report) != TF_OK)
      continue;
    for (long i = 0; i < steps; i++) {
      if (i == steps / 2) run.input.torque += between(&d, -1, 1);
      run.input.omega0 += run.input.alpha * k->dt;
      const run_t before = run;
      if (run_step(&run) < 0) break;
      look_at(before, &run);
    }
  }
  return 0;
}

static int single_main(int argc, char **argv) {
  problem_t problem;
  run_t run;
  if (argc < 5) return 2;
  const motion_scheme_t scheme = scheme_named(argv[1]);
  if (argc == 6 && scheme != MOTION_COMPENSATED &&
      strcmp(argv[2], "machines") == 0)
    return follow_machines(scheme, strtol(argv[3], NULL, 10),
                           strtol(argv[4], NULL, 10),
                           (tf_real_t)strtod(argv[5], NULL));
  const long steps = strtol(argv[3], NULL, 10);
  const long every = strtol(argv[4], NULL, 10);
  if (argc != 5 || !problem_named(argv[2], &problem) || steps < 1 ||
      every < 1 || run_begin(&run, &problem, scheme, steps, 1e-8, 0) != TF_OK)
    return 2;
  return follow(&run, steps, every);
}

int main(int argc, char **argv) {
  const char *command = argc > 1 ? argv[1] : "";
  const int code =
      strcmp(command, "single") == 0 ? single_main(argc - 1, argv + 1)
      : strcmp(command, "ensemble") == 0
          ? ensemble_main(argc > 2 ? strtoul(argv[2], NULL, 10) : 0)
          : harness_main(argc, argv, solve);
  if (code == 2)
    fputs("bench: time|count|problems, single, ensemble; see tools/bench/*.c\n",
          stderr);
  return code;
}
