/* What the tolerance of the located step is a share of: the velocities of the
 * slip, neither those of a heavy disc nor the change that a force would make in
 * a step which it ends in no time. And a wheel along the slot. */
#include "sim.h"

/* A light slider on a disc that nothing moves is a damped oscillator, whatever
 * the friction: it passes h = 0 and g = 0 next to each other twice in each
 * period, and the disc has 1e5 times its speed. */
static void check_oscillator(tf_params_t params, double z, double dt) {
  const double w = (double)params.omega0 + z;
  params.dt = (tf_real_t)dt;
  params.r0 = TF_R(-0.25);
  sim_t s = sim_of(&params);
  s.x.r = TF_R(0.25);
  s.x.v = 1;
  s.x.w = (tf_real_t)w;
  CHECK(sim_begin(&s) == TF_OK);
  const double m = (double)s.k.m, decay = (double)s.k.c2 / m / 2;
  const double rate2 = (double)s.k.k2 / m - w * w;
  const double rate = sqrt(rate2 - decay * decay);
  const double middle = (double)s.k.k2 * (double)s.k.r0 / m / rate2;
  const double x = (double)s.x.r - middle, y = (1 + decay * x) / rate;
  for (int n = 1; n <= 500; n++) {
    CHECK(sim_step(&s, LOCATED) == TF_OK);
    const double t = n * dt;
    const double r =
        middle + exp(-decay * t) * (x * cos(rate * t) + y * sin(rate * t));
    CHECK_NEAR(s.x.r, r, IS_DOUBLE ? 5e-6 : 2e-3);
  }
}

TEST(located_slider_has_its_own_scale_on_a_heavy_disc) {
  tf_params_t params = tf_scenes[0]->params;
  params.beta = TF_R(1e6);
  params.k2 = TF_R(2e4);
  params.mu = TF_R(3e-6);
  params.kappa = TF_R(3e-7);
  params.gamma = TF_R(0.4);
  params.omega0 = TF_R(0.27);
  params.c1 = params.c2 = TF_R(1e-3);
  check_oscillator(params, 0.1, 1e-3);
  check_oscillator(params, 0.1, 1e-2);
  /* The same without friction, on a disc at rest that nothing turns. */
  params.law = TF_TYRE_NONE;
  params.d = params.c1 = params.omega0 = 0;
  check_oscillator(params, 0, 1e-3);
}

/* Friction of 1e9 N ends a slip of 0.08 m/s in 4e-10 s. In a step of 10 ms it
 * would change that to 4e6 m/s, which is no measure of an error. */
TEST(located_impulse_does_not_depend_on_the_step) {
  const double machine[MACHINE] = {
      2.522, 0.25, 0.116, 0, 0, 1e-3, -0.1, 0.256, IS_DOUBLE ? 1e9 : 1e3,
      0.798, 0.985};
  const motion_t wheel = {
      .params = params_from(machine), .r = 0.0415, .v = -0.0587, .w = 0.2767};
  double r[2], w[2];
  for (int j = 0; j < 2; j++) {
    sim_t s = sim_under(&wheel, j ? 1e-2 : 1e-6);
    CHECK(sim_step(&s, LOCATED) == TF_OK);
    s.params.dt = TF_R(1e-2);
    if (!j) s.params.dt -= TF_R(1e-6);
    CHECK(sim_prepare(&s) == TF_OK);
    if (!j) CHECK(sim_step(&s, LOCATED) == TF_OK);
    CHECK(s.x.mode == TF_STICK_PLUS);
    r[j] = (double)s.x.r;
    w[j] = (double)s.x.w;
  }
  CHECK_NEAR(r[1], r[0], IS_DOUBLE ? 1e-9 : 1e-5);
  CHECK_NEAR(w[1], w[0], IS_DOUBLE ? 1e-7 : 1e-3);
}

/* With the wheel along the slot, h = 0 is r z = 0, and A and N vanish with r: a
 * stick passes the axis into the escaping region and goes on, whether gamma is
 * 0 or the number next to pi, in steps of any length. */
TEST(stick_along_the_slot_passes_the_axis) {
  const double pi = 3.14159265358979323846, gammas[3] = {0, pi, -pi};
  int passed = 0;
  for (int i = 0; i < 60; i++) {
    motion_t wheel = {.params = moderate_params()};
    tf_params_t *p = &wheel.params;
    p->gamma = i % 3 ? (tf_real_t)gammas[i % 3] : 0;
    p->mu = 900;
    p->omega0 = uniform(-1, 1);
    const double side = i % 2 ? 1 : -1;
    wheel.r = -side * 0.01;
    wheel.v = side * 0.5;
    wheel.w = (double)p->omega0;
    const tf_machine_t k = sim_of(p).k;
    CHECK(k.sin_gamma == 0 && fabs((double)k.cos_gamma) == 1);
    for (int j = 0; j < 3; j++) {
      sim_t s = sim_under(&wheel, (double[]){1e-2, 1e-3, 1.7e-4}[j]);
      if (s.x.mode != TF_STICK_PLUS && s.x.mode != TF_STICK_MINUS) break;
      const unsigned mode = s.x.mode;
      while (side * (double)s.x.r < 0.005) {
        CHECK(sim_step(&s, LOCATED) == TF_OK);
        if (!CHECK(s.x.mode == mode)) break;
        CHECK_NEAR(s.x.w, p->omega0, 1e-6);
      }
      passed++;
    }
  }
  CHECK(passed > 60);
}
