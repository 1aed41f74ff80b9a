// Makes the numbers of solutions.h anew, in long double and at two steps, and
// fails where they have moved: solutions.h is data, this is where it is from.
// With an argument it writes the problems there for peers that are not written
// in C: a line of names, then a line of numbers for each.
#define PEER_LONG
#include <stdio.h>

#include "events.h"

enum { STEPS = 16384 };

static int write_problems(const char *name) {
  FILE *file = fopen(name, "w");
  if (!file) return 1;
  fputc('%', file);
  for (int i = 0; i < PROBLEMS; i++) {
    const problem_t problem = problem_number(i);
    fprintf(file, " %s", problem.name);
  }
  fputc('\n', file);
  for (int i = 0; i < PROBLEMS; i++) {
    const problem_t q = problem_number(i);
    const tf_params_t *p = &q.params;
    const double row[] = {q.r,           q.omega, q.h,       q.side,   q.t_end,
                          p->m,          p->d,    p->beta,   p->k2,    p->c1,
                          p->c2,         p->r0,   p->omega0, p->mu,    p->kappa,
                          p->gamma,      q.alpha, q.end[0],  q.end[1], q.end[2],
                          q.branch_error};
    for (size_t j = 0; j < sizeof row / sizeof *row; j++)
      fprintf(file, "%.17g ", row[j]);
    fputs("\n", file);
  }
  return fclose(file) != 0;
}

int main(int argc, char **argv) {
  int wrong = argc > 1 && write_problems(argv[1]);
  for (int i = 0; i < PROBLEMS; i++) {
    const problem_t problem = problem_number(i);
    const model_t k = model_of(&problem);
    double x[3] = {0}, error[2] = {0};
    for (int half = 0; half < 2; half++) {
      const real_t dt = (real_t)problem.t_end / (STEPS << half);
      const events_t by = {dt, 0, (real_t)0.05, dt * dt / 10};
      const motion_t end = events_run(&k, dp5, &problem, &by);
      model_end(&k, end.y, x);
      error[half] = problem_error(&problem, x);
    }
    printf(
        "reference %s: %.16g %.16g %.16g, off by %.1e, at half the step "
        "%.1e\n",
        problem.name, x[0], x[1], x[2], error[0], error[1]);
    wrong += !(error[1] < 2e-12);
  }
  return wrong != 0;
}
