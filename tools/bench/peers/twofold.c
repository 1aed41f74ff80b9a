// The project's own schemes, as a program would call them, beside the peers.
// The located step takes part twice: with its tolerance as the knob, at several
// lengths of the step (in the place of a width), and with the step as the knob.
#include <stdio.h>

#include "sweep.h"

typedef tf_status_t scheme_t(const tf_machine_t *machine, tf_state_t *state,
                             const tf_input_t *input, tf_report_t *report);

static inline void run(scheme_t *scheme, const problem_t *problem, double dt,
                       double tolerance, answer_t *answer) {
  tf_params_t params = problem->params;
  tf_machine_t machine;
  tf_report_t report;
  tf_state_t x = {.r = problem->r, .w = problem->omega};
  const long steps = sweep_steps(problem, dt);
  params.dt = problem->t_end / (double)steps;
  params.tolerance = tolerance;
  x.mode = problem->side > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS;
  tf_status_t status = tf_prepare(&machine, &params, NULL);
  if (status != TF_OK) {
    answer->lost = 1;
    return;
  }
  tf_input_t input = tf_input_default(&machine);
  status =
      tf_speed_for_slip(&machine, x.r, x.w, input.omega0, problem->h, &x.v);
  if (status == TF_OK) status = tf_begin(&machine, &x, &input, &report);
  input.alpha = problem->alpha;
  for (long i = 0; i < steps && status >= 0; i++) {
    input.omega0 = params.omega0 + problem->alpha * (double)(i + 1) * params.dt;
    status = scheme(&machine, &x, &input, &report);
  }
  *answer = (answer_t){{x.r, x.v, x.w}, (long)x.tick, status < 0};
}

static void moreau(const problem_t *problem, double dt, double width,
                   answer_t *answer) {
  (void)width;
  run(tf_step, problem, dt, 0, answer);
}

static void located(const problem_t *problem, double dt, double width,
                    answer_t *answer) {
  (void)width;
  run(tf_step_located, problem, dt, 1e-8, answer);
}

static void tolerant(const problem_t *problem, double tolerance, double step,
                     answer_t *answer) {
  run(tf_step_located, problem, step, tolerance, answer);
}

int main(void) {
  // Long steps run out of segments at the finest tolerances.
  const peer_t peers[] = {
      {"twofold-located", "tol", 1e-3, 1e-10, 1.7, 1, tolerant},
      {"twofold-located", "tol", 1e-3, 1e-10, 1.7, 0.2, tolerant},
      {"twofold-located", "tol", 1e-3, 1e-10, 1.7, 0.05, tolerant},
      {"twofold-located", "tol", 1e-3, 1e-12, 1.7, 0.02, tolerant},
      {"twofold-located", "tol", 1e-3, 1e-12, 1.7, 0.005, tolerant},
      {"twofold-loc-dt", "dt", 0.5, 3e-5, 1.3, 0, located},
      {"twofold-moreau", "dt", 0.2, 4e-7, 1.4, 0, moreau}};
  sweep_round(peers, (int)(sizeof peers / sizeof *peers));
  return 0;
}
