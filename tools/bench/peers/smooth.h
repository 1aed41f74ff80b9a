/// @file
/// The usual way to simulate this machine, for comparison: friction smoothed
/// over epsilon, libm's tangents, classical Runge-Kutta of order four, no
/// branches.
#ifndef TWOFOLD_PEERS_SMOOTH_H
#define TWOFOLD_PEERS_SMOOTH_H

#include "bench/harness.h"
#include "runge_kutta.h"

// cppcheck-suppress passedByValue  ; four reals, inlined
static inline point_t smooth_field(const model_t *k, contact_t c, point_t y) {
  (void)c;
  return smooth_rates(k, y);
}

static inline void smooth_rk4(const problem_t *problem, const solver_t *solver,
                              double dt, answer_t *answer) {
  const long steps = harness_steps(problem, dt);
  const real_t t = (real_t)(problem->length / (double)steps);
  const contact_t none = {0, 0};
  model_t k = model_of(problem);
  k.epsilon2 = (real_t)(solver->second * solver->second);
  point_t y = model_start(&k, problem);
  for (long i = 0; i < steps; i++)
    y = rk4_of(smooth_field, &k, none, y, smooth_field(&k, none, y), t);
  model_end(&k, y, answer->x);
  answer->steps = steps;
}

#endif
