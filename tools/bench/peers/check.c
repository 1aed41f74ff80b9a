// Holds the peers' own equations, in long double, to the reference: the rates
// at random states, and the ends of the problems at two steps, those of
// tests/data and those that problem.c has beside them.
#define PEER_LONG
#include <stdio.h>

#include "../../../tests/reference/reference.h"
#include "bench/harness.h"
#include "events.h"

enum { STEPS = 16384, DRAWS = 700 };

// Explicit steps: those of the stiff problems are as long as they may be.
static int moved(problem_t problem, long steps, double most) {
  const model_t k = model_of(&problem);
  double x[3] = {0}, error[2] = {0};
  for (int half = 0; half < 2; half++) {
    const real_t dt = (real_t)problem.length / (real_t)(steps << half);
    const events_t by = {dt, 0, (real_t)0.05, dt * dt / 10};
    const motion_t end = events_run(&k, dp5, &problem, &by);
    model_end(&k, end.y, x);
    error[half] = problem_error(&problem, x);
  }
  printf("%s: %.16g %.16g %.16g, off by %.1e, at half the step %.1e\n",
         problem.name, x[0], x[1], x[2], error[0], error[1]);
  return !(error[1] < most);
}

static ref_real_t wide(double x) { return (ref_real_t)x; }

static ref_rate_t reference_rate(const problem_t *problem, point_t y,
                                 contact_t c, real_t g) {
  const tf_params_t *p = &problem->params;
  const ref_real_t omega0 = wide(p->omega0), far = 1000;
  ref_machine_t k = {
      PARAMETERS_OF(ref_real_t, p),
      .law = p->law == TF_TYRE_SMOOTH   ? REF_SMOOTH
             : p->law == TF_TYRE_STRING ? REF_STRING
                                        : REF_JUMP,
      .epsilon = wide(p->epsilon),
      .k = wide(p->k),
      .delta = wide(p->delta),
      .sigma = wide(p->sigma),
      .rho = wide(p->rho),
      .a = wide(p->a),
      .knots = 2,
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
static int rates_differ(void) {
  real_t worst = 0;
  for (int i = 0; i < DRAWS; i++) {
    const unsigned draw = 4 * (unsigned)i;
    const problem_t problem = problem_number(i % PEER_PROBLEMS);
    const model_t k = model_of(&problem);
    const int third = i / PEER_PROBLEMS % 3 - 1;
    const int side = third || k.jumps ? third : 1;
    const point_t y = {draw_of(draw) + (real_t)0.05, side * draw_of(draw + 1),
                       4 * draw_of(draw + 2) - 2, 2 * draw_of(draw + 3)};
    const real_t g = rolling(&k, y);
    const contact_t c = {side, g < 0 ? -1 : 1};
    const point_t dy = contact_rates(&k, c, y);
    const ref_rate_t want = reference_rate(&problem, y, c, g);
    const real_t off =
        fabs(dy.r - want.r) + fabs(dy.h - want.h) + fabs(dy.z - want.z);
    const real_t size = 1 + fabs(want.h) + fabs(want.z);
    if (!(off / size <= worst)) worst = off / size;
  }
  printf("rates at %d random states, off by %.1Le\n", DRAWS, worst);
  return !(worst < 1e-13L);
}

int main(void) {
  int wrong = rates_differ();
  for (int i = 0; i < STIFF; i++)
    wrong += moved(problem_number(i), STEPS, 2e-12);
  for (int i = STIFF; i < PEER_PROBLEMS; i++)
    wrong +=
        moved(problem_number(i), (i < ONE_FIELD ? 2L : 16L) * STEPS, 1e-11);
  problem_t approach;
  wrong +=
      !problem_named("approach", &approach) || moved(approach, STEPS, 2e-12);
  return wrong != 0;
}
