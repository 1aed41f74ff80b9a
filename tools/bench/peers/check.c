// Holds the peers' own equations to the reference: the rates at random states
// of every problem.
#include <stdio.h>

#include "../../../tests/reference/reference.h"
#include "bench/harness.h"
#include "model.h"

enum { DRAWS = 700 };

static ref_real_t wide(double x) { return (ref_real_t)x; }

static ref_rate_t reference_rate(const problem_t *problem, point_t y,
                                 contact_t c, double g) {
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
  const ref_slip_t slip = {wide(y.h), wide(g)};
  const ref_state_t x = ref_from_slip(
      &k, (ref_state_t){.r = wide(y.r), .t = wide(y.t), .piece = 1}, slip);
  if (c.side)
    return ref_rate(&k, x,
                    ref_slip_force(&k, slip, ref_piece_at(&k, slip, c.side)));
  const ref_edge_t edge = ref_edge(&k, x, c.roll);
  return ref_rate(&k, x, ref_stick_force(&k, c.roll, edge.N / edge.A));
}

static double draw_of(unsigned i) { return harness_random(7, i); }

// The largest difference of the rates at random states; NaN counts.
static int rates_differ(void) {
  double worst = 0;
  for (int i = 0; i < DRAWS; i++) {
    const unsigned draw = 4 * (unsigned)i;
    const problem_t problem = problem_number(i % PEER_PROBLEMS);
    const model_t k = model_of(&problem);
    const int third = i / PEER_PROBLEMS % 3 - 1;
    const int side = third || k.jumps ? third : 1;
    const point_t y = {draw_of(draw) + 0.05, side * draw_of(draw + 1),
                       4 * draw_of(draw + 2) - 2, 2 * draw_of(draw + 3)};
    const double g = rolling(&k, y);
    const contact_t c = {side, g < 0 ? -1 : 1};
    const point_t dy = contact_rates(&k, c, y);
    const ref_rate_t want = reference_rate(&problem, y, c, g);
    const double off = fabs(dy.r - (double)want.r) +
                       fabs(dy.h - (double)want.h) +
                       fabs(dy.z - (double)want.z);
    const double size = 1 + fabs((double)want.h) + fabs((double)want.z);
    if (!(off / size <= worst)) worst = off / size;
  }
  printf("rates at %d random states, off by %.1e\n", DRAWS, worst);
  return !(worst < 1e-12);
}

int main(void) { return rates_differ(); }
