/* Machines with a two-fold at a given place, against the paper in long
 * double, and why there may be none. */
#include "sample.h"

TEST(designed_two_folds_are_found_again) {
  for (int i = 0; i < samples(5000); i++) {
    const sample_t c = random_two_fold();
    const tf_surface_point_t *wanted = &c.design.two_fold.point;
    tf_surface_point_t at[TF_TWO_FOLDS];
    int count = 0, hits = 0;
    /* A double root is found to the root of the rounding. */
    const real close = 64 * sqrtl(EPSILON);
    CHECK(tf_two_folds(&c.machine, &c.input, at, &count, NULL) == TF_OK);
    for (int j = 0; j < count; j++)
      hits += fabsl(wide(at[j].r) - wide(wanted->r)) < close &&
              fabsl(wide(at[j].w) - wide(wanted->w)) < close &&
              (at[j].g > 0) == (wanted->g > 0);
    const real edge = c.x[0] * c.x[0] - c.paper.beta * c.paper.beta *
                                            sinl(c.paper.gamma) *
                                            sinl(c.paper.gamma);
    if (fabsl(edge) > 0.01L * c.x[0] * c.x[0] && fabsl(wide(wanted->g)) > 0.01L)
      CHECK(hits >= 1);
    CHECK_NEAR(paper_lie(&c.paper, c.x, c.paper.mu, c.s), 0, 1e4L * EPSILON);
    CHECK_NEAR(paper_lie(&c.paper, c.x, -c.paper.mu, c.s), 0, 1e4L * EPSILON);
  }
}

static unsigned obstacle(const tf_params_t *params, double r, double w) {
  const tf_machine_t machine = prepared(params);
  const tf_input_t input = tf_input_default(&machine);
  tf_design_t design;
  const tf_status_t status =
      tf_design_two_fold(&machine, &input, (tf_real_t)r, (tf_real_t)w, &design);
  CHECK((status == TF_OK) == (design.obstacle == TF_DESIGN_FOUND));
  CHECK(status == TF_OK || status == TF_BAD_PARAMETER);
  CHECK((design.two_fold.time_scale > 0) ==
        (design.obstacle == TF_DESIGN_FOUND ||
         design.obstacle >= TF_DESIGN_KAPPA));
  return design.obstacle;
}

/* Near the axis a two-fold takes a longer arm than the real type can name, or
 * forces whose products it cannot hold. */
TEST(designs_near_the_axis_are_refused) {
  const tf_real_t least = 4 * TF_REAL_MIN;
  tf_params_t params = tf_scenes[0]->params;
  params.beta = TF_R(1e6);
  /* kappa = beta^2 sin^2 / (r cos) is finite, times w it is not. */
  const double near_axis = 1e15 / (double)TF_REAL_MAX;
  CHECK(obstacle(&params, (double)(least * 1000), -1.037) == TF_DESIGN_R);
  CHECK(obstacle(&params, near_axis, -1e8) == TF_DESIGN_R);
  params.beta = TF_R(1e-9);
  const tf_machine_t machine = prepared(&params);
  tf_input_t input = tf_input_default(&machine);
  input.r0 = 2 * least;
  input.force = TF_R(1e8);
  tf_design_t design;
  CHECK(tf_design_two_fold(&machine, &input, least, TF_R(-1.037), &design) ==
        TF_BAD_PARAMETER);
  CHECK(design.obstacle == TF_DESIGN_SPRING && design.k2 == 0);
}

TEST(impossible_designs_say_why) {
  tf_params_t params = tf_scenes[0]->params;
  CHECK(obstacle(&params, 0.1859, -1.037) == TF_DESIGN_FOUND);
  CHECK(obstacle(&params, 0, -1.037) == TF_DESIGN_R);
  CHECK(obstacle(&params, 1, -1.037) != TF_DESIGN_R);
  params.r0 = 0; /* though the spring is unstretched there */
  CHECK(obstacle(&params, 0, -1.037) == TF_DESIGN_R);
  params.r0 = tf_scenes[0]->params.r0;
  CHECK(obstacle(&params, NAN, -1.037) == TF_DESIGN_R);
  CHECK(obstacle(&params, 2e9, -1.037) == TF_DESIGN_R);
  CHECK(obstacle(&params, 0.1859, -1) == TF_DESIGN_OMEGA);
  CHECK(obstacle(&params, 0.1859, NAN) == TF_DESIGN_OMEGA);
  CHECK(obstacle(&params, (double)params.r0, -1.037) == TF_DESIGN_SPRING);
  CHECK(obstacle(&params, 0.1859, 1) == TF_DESIGN_KAPPA); /* g < 0 there */
  CHECK(obstacle(&params, 0.05, -2.5) == TF_DESIGN_K2);
  params.gamma = 0;
  CHECK(obstacle(&params, 0.1859, -1.037) == TF_DESIGN_GAMMA);
  params.gamma = (tf_real_t)(PAPER_PI / 2);
  CHECK(obstacle(&params, 0.1859, -1.037) == TF_DESIGN_GAMMA);
  params = tf_scenes[0]->params;
  CHECK(obstacle(&params, 1e8, -1.037) == TF_DESIGN_KAPPA); /* too long */
  params.mu = 0;
  CHECK(obstacle(&params, 0.1859, -1.037) == TF_DESIGN_LAW);
  params = tf_scenes[0]->params;
  params.law = TF_TYRE_COULOMB;
  CHECK(obstacle(&params, 0.1859, -1.037) == TF_DESIGN_LAW);
  const tf_machine_t machine = prepared(&params);
  const tf_input_t input = tf_input_default(&machine);
  tf_two_fold_t n, before;
  memset(&n, 77, sizeof n);
  before = n;
  tf_surface_point_t place = {TF_R(0.2), 0, 0, 0};
  CHECK(tf_normal_form(&machine, &input, &place, &n) == TF_BAD_STATE);
  place.g = 1;
  place.r = 0;
  CHECK(tf_normal_form(&machine, &input, &place, &n) == TF_BAD_STATE);
  place.r = (tf_real_t)NAN;
  CHECK(tf_normal_form(&machine, &input, &place, &n) == TF_BAD_STATE);
  params.law = TF_TYRE_SMOOTH;
  params.epsilon = 1;
  const tf_machine_t smooth = prepared(&params);
  place.r = 1;
  CHECK(tf_normal_form(&smooth, &input, &place, &n) == TF_BAD_PARAMETER);
  CHECK(!memcmp(&n, &before, sizeof n));
}

/* A spring that holds h as much as its stretch is long, to the last bit. */
TEST(design_with_unit_effect_of_the_spring) {
  tf_params_t params = tf_scenes[0]->params;
  params.d = 0;
  params.gamma = 1;
  const tf_machine_t first = prepared(&params);
  params.m = first.sin_gamma; /* hold = sin(gamma) / m (r0 - r) */
  params.r0 = 2;
  const tf_machine_t machine = prepared(&params);
  const tf_input_t input = tf_input_default(&machine);
  tf_design_t design;
  CHECK(machine.sin_gamma / machine.m == 1);
  const tf_status_t status = tf_design_two_fold(
      &machine, &input, 1, machine.omega0 - TF_R(0.25), &design);
  CHECK(status == TF_OK || design.obstacle == TF_DESIGN_K2);
  CHECK_NEAR(wide(design.two_fold.residual), 0,
             64 * EPSILON * fabsl(wide(design.k2)));
}
