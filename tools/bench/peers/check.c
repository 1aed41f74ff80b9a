// Holds the peers' own equations, in long double, to the reference: the rates
// at random states, and the ends of the problems at two steps, those of
// tests/data and the two that problem.c has from here.
//
//   check [PROBLEMS STATES]
//
// writes the problems for peers that are not written in C, a line of names and
// a line of numbers for each; and lines "problem r h z t side roll dr dh dz",
// by which octave.m checks its equations.
#define PEER_LONG
#include <stdio.h>

#include "../../../tests/reference/reference.h"
#include "bench/harness.h"
#include "events.h"

enum { STEPS = 16384, DRAWS = 400 };

static int write_problems(const char *name) {
  FILE *file = fopen(name, "w");
  if (!file) return 1;
  fputc('%', file);
  for (int i = 0; i < PEER_PROBLEMS; i++)
    fprintf(file, " %s", problem_number(i).name);
  fputc('\n', file);
  for (int i = 0; i < PEER_PROBLEMS; i++) {
    const problem_t q = problem_number(i);
    const tf_params_t *p = &q.params;
    // In the order of `fields` in octave.m.
    fprintf(file, "%.17g %.17g %.17g %d %.17g ", (double)q.start[0],
            (double)q.start[2], q.h, problem_side(&q), q.length);
    const double row[] = {p->m,  p->d,  p->beta,   p->k2, p->c1,
                          p->c2, p->r0, p->omega0, p->mu, p->kappa};
    for (size_t j = 0; j < sizeof row / sizeof *row; j++)
      fprintf(file, "%.17g ", row[j]);
    fprintf(file, "%.17g %.17g %.17g %.17g %.17g %.17g \n", p->gamma, q.alpha,
            q.end[0], q.end[1], q.end[2], q.branch_error);
  }
  return fclose(file) != 0;
}

static int moved(problem_t problem) {
  const model_t k = model_of(&problem);
  double x[3] = {0}, error[2] = {0};
  for (int half = 0; half < 2; half++) {
    const real_t dt = (real_t)problem.length / (STEPS << half);
    const events_t by = {dt, 0, (real_t)0.05, dt * dt / 10};
    const motion_t end = events_run(&k, dp5, &problem, &by);
    model_end(&k, end.y, x);
    error[half] = problem_error(&problem, x);
  }
  printf("%s: %.16g %.16g %.16g, off by %.1e, at half the step %.1e\n",
         problem.name, x[0], x[1], x[2], error[0], error[1]);
  return !(error[1] < 2e-12);
}

static ref_real_t wide(double x) { return (ref_real_t)x; }

static ref_rate_t reference_rate(const problem_t *problem, point_t y,
                                 contact_t c, real_t g) {
  const tf_params_t *p = &problem->params;
  const ref_real_t omega0 = wide(p->omega0), far = 1000;
  ref_machine_t k = {
      PARAMETERS_OF(ref_real_t, p), .knots = 2,
      .knot = {{.omega0 = omega0},
               {far, omega0 + far * wide(problem->alpha), 0, 0}}};
  ref_prepare(&k);
  const ref_slip_t slip = {y.h, g};
  const ref_state_t x =
      ref_from_slip(&k, (ref_state_t){.r = y.r, .t = y.t, .piece = 1}, slip);
  if (c.side)
    return ref_rate(&k, x,
                    ref_slip_force(&k, slip, ref_piece_at(&k, slip, c.side)));
  const ref_edge_t edge = ref_edge(&k, x, c.roll);
  return ref_rate(&k, x, ref_stick_force(&k, c.roll, edge.N / edge.A));
}

static real_t draw_of(unsigned i) { return (real_t)harness_random(7, i); }

// The largest difference of the rates at random states; NaN counts.
static int rates_differ(FILE *states) {
  real_t worst = 0;
  for (int i = 0; i < DRAWS; i++) {
    const unsigned draw = 4 * (unsigned)i;
    const problem_t problem = problem_number(i % PEER_PROBLEMS);
    const model_t k = model_of(&problem);
    const int side = i / PEER_PROBLEMS % 3 - 1;
    const point_t y = {draw_of(draw) + (real_t)0.05, side * draw_of(draw + 1),
                       4 * draw_of(draw + 2) - 2, 2 * draw_of(draw + 3)};
    const real_t g = rolling(&k, y);
    const contact_t c = {side, g < 0 ? -1 : 1};
    const point_t dy = contact_rates(&k, c, y);
    const ref_rate_t want = reference_rate(&problem, y, c, g);
    const real_t off =
        fabs(dy.r - want.r) + fabs(dy.h - want.h) + fabs(dy.z - want.z);
    if (!(off <= worst)) worst = off;
    if (states)
      fprintf(states,
              "%d %.17Lg %.17Lg %.17Lg %.17Lg %d %d %.17Lg %.17Lg "
              "%.17Lg\n",
              i % PEER_PROBLEMS + 1, y.r, y.h, y.z, y.t, side, c.roll, want.r,
              want.h, want.z);
  }
  printf("rates at %d random states, off by %.1Le\n", DRAWS, worst);
  return !(worst < 1e-13L);
}

int main(int argc, char **argv) {
  int wrong = argc > 1 && write_problems(argv[1]);
  FILE *states = argc > 2 ? fopen(argv[2], "w") : NULL;
  wrong += rates_differ(states) || (states && fclose(states) != 0);
  for (int i = 0; i < PEER_PROBLEMS; i++) wrong += moved(problem_number(i));
  problem_t approach;
  wrong += !problem_named("approach", &approach) || moved(approach);
  return wrong != 0;
}
