// Peers written by hand for the law that jumps: event-driven Runge-Kutta.
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
  const double dt = problem->length / (double)steps;
  (void)solver;
  run(rk4, problem, (events_t){dt, 0, pow(dt, 0.2) / 2, dt * dt / 10}, answer);
}

static void events_dp5(const problem_t *problem, const solver_t *solver,
                       double tol, answer_t *answer) {
  (void)solver;
  run(dp5, problem, (events_t){0.25, tol, 0.5, sqrt(tol) / 10}, answer);
}

int main(int argc, char **argv) {
  const solver_t solvers[] = {
      {"events-rk4", "dt", 0.1, 3e-5, 1.3, 0, JUMPING, 0, events_rk4},
      {"events-dp5", "tol", 1e-4, 4e-13, 1.8, 0, JUMPING, 0, events_dp5}};
  return harness_main(argc, argv, solvers, 2);
}
