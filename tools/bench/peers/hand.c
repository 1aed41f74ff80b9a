// Peers written by hand: event-driven Runge-Kutta, and what is written without
// events: Runge-Kutta on a smoothed law. A law without a jump has no events.
#ifndef PEER_JUMPS
#define PEER_JUMPS 1
#endif
#include "events.h"

// `advance` is a constant at every call, so that all of a run is one loop.
static inline void run(advance_t *advance, const problem_t *problem,
                       events_t by, answer_t *answer) {
  const model_t k = model_of(problem);
  const motion_t x = events_run(&k, advance, problem, &by);
  model_end(&k, x.y, answer->x);
  answer->lost = x.lost;
}

// The share shrinks as dt^(1/5), so that the way into h = g = 0 keeps up with
// the order of the rest.
static void events_rk4(const problem_t *problem, const solver_t *solver,
                       double longest, answer_t *answer) {
  const long steps = harness_steps(problem, longest);
  const real_t dt = problem->length / (double)steps;
  (void)solver;
  run(rk4, problem, (events_t){dt, 0, pow(dt, 0.2) / 2, dt * dt / 10}, answer);
}

static void events_dp5(const problem_t *problem, const solver_t *solver,
                       double tol, answer_t *answer) {
  (void)solver;
  run(dp5, problem, (events_t){0.25, tol, 0.5, sqrt(tol) / 10}, answer);
}

// The explicit rule grows where dt is longer than about 3 epsilon m / mu.
#define SMOOTH(epsilon)                                                     \
  {                                                                         \
    "rk4-smooth eps=" #epsilon, "dt", 30 * (epsilon), 0.3 * (epsilon), 1.6, \
        epsilon, JUMPING, 0, smooth_rk4                                     \
  }

int main(int argc, char **argv) {
  const solver_t solvers[] = {
#if PEER_JUMPS
    {"events-rk4", "dt", 0.1, 3e-5, 1.3, 0, JUMPING, 0, events_rk4},
    {"events-dp5", "tol", 1e-4, 4e-13, 1.8, 0, JUMPING, 0, events_dp5},
    SMOOTH(1e-3),
    SMOOTH(1e-4),
    SMOOTH(1e-5),
    {"rk4-smooth eps=1e-6", "dt", 1e-5, 5e-7, 1.6, 1e-6, JUMPING, 0,
     smooth_rk4},
#else
    {"rk4", "dt", 3e-5, 1e-6, 1.3, 0, FROM(ONE_FIELD), 0, events_rk4},
    {"dp5", "tol", 1e-3, 1e-12, 6, 0, FROM(ONE_FIELD), 0, events_dp5},
#endif
  };
  return harness_main(argc, argv, solvers,
                      (int)(sizeof solvers / sizeof *solvers));
}
