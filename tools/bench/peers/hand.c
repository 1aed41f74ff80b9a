// Peers written by hand: event-driven Runge-Kutta, and what is written without
// events: Runge-Kutta on a smoothed law, and Euler's rule with sign(h).
#include "events.h"

static void answer_events(const model_t *k, const motion_t *x,
                          answer_t *answer) {
  model_end(k, x->y, answer->x);
  answer->steps = x->steps;
  answer->lost = x->lost;
}

static void events_rk4(const problem_t *problem, const solver_t *solver,
                       double dt, answer_t *answer) {
  (void)solver;
  const model_t k = model_of(problem);
  const long steps = harness_steps(problem, dt);
  const events_t by = events_by_step(problem->length / (double)steps);
  const motion_t x = events_run(&k, rk4, problem, &by);
  answer_events(&k, &x, answer);
}

static void events_dp5(const problem_t *problem, const solver_t *solver,
                       double tol, answer_t *answer) {
  (void)solver;
  const model_t k = model_of(problem);
  const events_t by = events_by_tolerance(tol);
  const motion_t x = events_run(&k, dp5, problem, &by);
  answer_events(&k, &x, answer);
}

static void euler(const problem_t *problem, const solver_t *solver, double dt,
                  answer_t *answer) {
  (void)solver;
  const model_t k = model_of(problem);
  const long steps = harness_steps(problem, dt);
  dt = problem->length / (double)steps;
  point_t y = model_start(&k, problem);
  for (long i = 0; i < steps; i++) {
    const contact_t c = {y.h < 0 ? -1 : 1, rolling(&k, y) < 0 ? -1 : 1};
    y = ahead(y, dt, slip_rates(&k, c, y));
  }
  model_end(&k, y, answer->x);
  answer->steps = steps;
}

// The explicit rule grows where dt is longer than about 3 epsilon m / mu.
#define SMOOTH(epsilon)                                                     \
  {                                                                         \
    "rk4-smooth eps=" #epsilon, "dt", 30 * (epsilon), 0.3 * (epsilon), 1.6, \
        epsilon, PEER_PROBLEMS, 0, smooth_rk4                               \
  }

int main(int argc, char **argv) {
  const solver_t solvers[] = {
      {"events-rk4", "dt", 0.1, 3e-5, 1.3, 0, PEER_PROBLEMS, 0, events_rk4},
      {"events-dp5", "tol", 1e-4, 4e-13, 1.8, 0, PEER_PROBLEMS, 0, events_dp5},
      {"euler", "dt", 1e-2, 1e-6, 1.6, 0, PEER_PROBLEMS, 0, euler},
      SMOOTH(1e-3),
      SMOOTH(1e-4),
      SMOOTH(1e-5),
      {"rk4-smooth eps=1e-6", "dt", 1e-5, 5e-7, 1.6, 1e-6, PEER_PROBLEMS, 0,
       smooth_rk4}};
  return harness_main(argc, argv, solvers,
                      (int)(sizeof solvers / sizeof *solvers));
}
