// What is left of a step's accuracy in float where its rounding is compensated
// for.
//
//   digits   prints lines `part dt real scheme r v w`: end states of runs whose
//            step is dt [s], and in double the reference, the finest
//
// Parameters, start and step are rounded to float first in both real types, so
// that nothing but the step differs.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/steps/rounded.h"
#include "part.h"

#define FINEST 20

static int print_end(const part_t *part, scheme_t scheme, int k,
                     const char *name) {
  truth_state_t start;
  tf_params_t params;
  run_t run = {.scheme = scheme};
  const int exact = k == 0;
  const double dt = ldexp(1, exact ? -12 : -k);
  const long steps = lrint((double)(part->to - part->from) / dt);
  if (!truth_state(part->problem, part->from, &start) ||
      !truth_params(part->problem, &params))
    return 0;
  round_params(&params);
  params.dt = (tf_real_t)dt;
  params.tolerance = 0;
  if (tf_prepare_compensated(&run.machine, &params, NULL) != TF_OK) return 0;
  run.input = tf_input_default(&run.machine.machine);
  run.state.r = TO_FLOAT(start.x[0]);
  run.state.w = TO_FLOAT(start.x[2]);
  run.state.mode = truth_mode(part->problem, part->from);
  // The start has its slip to all digits: rounding v would turn its sign.
  const tf_real_t h = TO_FLOAT(truth_start_slip(part->problem));
  if (tf_speed_for_slip_compensated(&run.machine, &run.state, &run.compensation,
                                    run.input.omega0, h) != TF_OK)
    return 0;
  if (tf_begin(&run.machine.machine, &run.state, &run.input, &run.report) < 0)
    return 0;
  for (long i = 0; i < steps; i++)
    if (part_step(&run) < 0) return 0;
  printf("%s ", part->name);
  part_print_end(&run, dt, name);
  return 1;
}

int main(void) {
  const int wide = sizeof(tf_real_t) == 8;
  int done = 1;
  for (int i = 0; i < PARTS && done; i++) {
    if (parts[i].from > 0 || strcmp(parts[i].name, "cycle") == 0) continue;
    if (wide) done = print_end(&parts[i], LOCATED, 0, "reference");
    for (int k = 8; k <= FINEST && done; k += 2) {
      done = print_end(&parts[i], COMPENSATED, k, "compensated") &&
             print_end(&parts[i], MOREAU, k, "plain");
    }
  }
  return !done;
}
