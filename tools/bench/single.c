// What every single step of a run costs, for callgrind, which dumps its counter
// after every call of `sample`.
//
//   single SCHEME PROBLEM STEPS EVERY
//     every EVERYth step, every change of mode and, because they are rare and
//     dear, the first steps of slip
//   single SCHEME machines MACHINES STEPS DT
//     every step of random machines: those of the golden hashes where DT is 0,
//     else ordinary ones, about the size of the paper's, with its law
//
// A line a step: the modes before and after.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tests/golden/population.h"
#include "own.h"

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

int single_main(int argc, char **argv) {
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
