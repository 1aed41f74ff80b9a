// After the two-fold the future is not unique, and under the rule `random` two
// schemes cannot follow the same path: they have to agree in distribution.
//
//   after SECONDS SCHEME STEPS TOLERANCE RUNS SEED
//
// prints r so many seconds after the two-fold of scene `chaos`, a line a run,
// and in the last line the nanoseconds of one run. Every run has a seed of its
// own, from SEED on.
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "own.h"
#include "timing.h"

// What randomises: a kick at the two-fold, h uniform within so many m/s, and
// the rule with its rate. Without a kick the rule alone decides nothing: a
// wheel on the escaping stick stands on a knife's edge and falls within a step
// or two, to the side that rounding takes.
#define KICK 1e-3

// The two-fold where the reference meets it (tests/data/reference.h).
static const double twofold_r = 0.1859, twofold_w = -1.037;

static bool begin(run_t *run, const problem_t *problem, scheme_t scheme,
                  long steps, double tolerance, uint32_t seed) {
  const double kick = KICK * (2 * harness_random(902, seed) - 1);
  if (run_begin(run, problem, scheme, steps, tolerance, 0) != TF_OK)
    return false;
  const tf_machine_t *machine = &run->machine.machine;
  run->state = (tf_state_t){.r = (tf_real_t)twofold_r,
                            .w = (tf_real_t)twofold_w,
                            .seed = seed,
                            .mode = kick > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS};
  return tf_speed_for_slip(machine, run->state.r, run->state.w,
                           run->input.omega0, (tf_real_t)kick,
                           &run->state.v) == TF_OK &&
         tf_begin(machine, &run->state, &run->input, &run->report) == TF_OK;
}

int after_main(int argc, char **argv) {
  if (argc != 7) return 2;
  problem_t problem = problem_number(0);
  problem.params.rule = TF_RULE_RANDOM;
  problem.length = strtod(argv[1], NULL);
  const scheme_t scheme = scheme_named(argv[2]);
  const long steps = strtol(argv[3], NULL, 10);
  const double tolerance = strtod(argv[4], NULL);
  const long runs = strtol(argv[5], NULL, 10);
  const uint32_t seed = (uint32_t)strtoul(argv[6], NULL, 10);
  if (scheme == SCHEMES || steps < 1 || !(problem.length > 0)) return 2;
  const double start = timing_wall();
  for (long i = 0; i < runs; i++) {
    run_t run;
    bool goes_on =
        begin(&run, &problem, scheme, steps, tolerance, seed + (uint32_t)i);
    for (long k = 0; k < steps && goes_on; k++) goes_on = run_step(&run) >= 0;
    printf("%.9g\n", goes_on ? (double)run.state.r : (double)NAN);
  }
  printf("%.0f\n", 1e9 * (timing_wall() - start) / (double)runs);
  return 0;
}
