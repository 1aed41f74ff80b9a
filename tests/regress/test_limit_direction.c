/* A slip that comes to h = g = 0 along a limit direction next to h = 0. The
 * force at h -> 0, which keeps h on its side, used to throw it off that way: it
 * came to the point as a stick, which rests there, and not as the slip that
 * goes on. */
#include "sim.h"

TEST(a_slip_keeps_to_its_limit_direction) {
  if (!IS_DOUBLE) SKIP("h is below the rounding of float");
  tf_params_t p = params_from((const double[MACHINE]){
      0.3088456690311432, 1.8215008974075317, 0.48602965474128723,
      4.453408241271973, 0.0010000000474974513, 0.24436789751052856,
      0.392892986536026, -0.24714221060276031, 0.601233720779419,
      0.7191415429115295, -3.0847599506378174});
  p.dt = TF_R(1e-5);
  for (scheme_t scheme = MOREAU; scheme <= COMPENSATED; scheme++) {
    sim_t s = sim_of(&p);
    s.x.r = TF_R(0.3923709437937026);
    s.x.v = TF_R(1.2657301771384585e-05);
    s.x.w = TF_R(-0.24713962665320158);
    s.x.mode = TF_SLIP_PLUS;
    for (int n = 0; n < 20; n++) {
      CHECK(sim_step(&s, scheme) == TF_OK);
      if (s.x.mode == TF_SLIP_PLUS) CHECK(s.report.slip.h < s.report.slip.g);
    }
    CHECK(s.x.mode == TF_SLIP_MINUS);
  }
}

/* A slip that sticks for 1 us before h = g = 0, and rests there: as a slip it
 * would go on. Where the error of the located step is larger than that stick,
 * it says so. */
TEST(a_stick_too_short_to_locate_is_told) {
  tf_params_t p = params_from((const double[MACHINE]){
      1.6741051720577702, 0.897036930044119, 0.065979097133071984,
      21.653450858096122, 0.34992912682302868, 0.56301621699299287,
      0.20758841628559055, 1.6790561858864832, 2.5902964020275858,
      0.72357494601498307, -2.2994118004242732});
  for (int n = 60; n <= 6000; n *= 10) {
    p.dt = TF_R(0.6) / (tf_real_t)n;
    sim_t s = sim_of(&p);
    s.x.r = TF_R(0.38247407906991515);
    s.x.v = TF_R(0.053725697729499866);
    s.x.w = TF_R(1.7177447683734479);
    CHECK(sim_begin(&s) == TF_OK);
    int coarse = 0;
    for (int i = 0; i < n; i++) coarse += sim_step(&s, LOCATED) == TF_COARSE;
    const bool rests = s.x.mode == TF_PINNED;
    CHECK(rests ? fabs((double)s.x.r - 0.211494) < 1e-5 : coarse > 0);
    CHECK(!IS_DOUBLE || (rests && coarse == 0));
  }
}

/* Slips of a strong friction that come to h = g = 0 at once, crossing h = 0
 * before or not: a step that takes another future than several located ones, or
 * ends in another mode, is coarse. Its mean forces would hold the first one.
 * values: machine, force, alpha, r, v, w. */
TEST(a_slip_of_strong_friction_takes_its_future_or_is_coarse) {
  static const double values[MACHINE + 5] = {
      0.5816, -0.3461, 0.1541, 17.82, 0.44,  0.3342,  -0.0089,  -0.1936,
      294.3,  80.92,   1.6816, 2.835, 0.737, 0.02708, 0.004333, -0.1622};
  long right = 0, wrong = 0;
  for (int n = 0; n < samples(20000); n++) {
    double near[MACHINE + 5], *at = &near[MACHINE];
    for (int i = 0; i < MACHINE + 5; i++)
      near[i] = values[i] * tap_uniform(n ? 0.9 : 1, n ? 1.1 : 1);
    tf_params_t p = params_from(near);
    const int parts = n % 8 ? 8 : 1000;
    p.dt = n % 8 ? log_uniform(1e-5, 1e-2) : uniform(0.02, 0.03);
    if (n == 0) p.dt = TF_R(0.02198);
    p.tolerance = TF_R(1e-11);
    sim_t s = sim_of(&p);
    s.u.force = (tf_real_t)at[0], s.u.alpha = (tf_real_t)at[1];
    s.x.r = (tf_real_t)at[2], s.x.v = (tf_real_t)at[3];
    s.x.w = (tf_real_t)at[4];
    CHECK(sim_begin(&s) == TF_OK);
    p.dt /= (tf_real_t)parts;
    sim_t exact = sim_of(&p);
    exact.u = s.u, exact.x = s.x;
    s.u.omega0 += s.u.alpha * s.k.dt;
    bool known = sim_step(&s, MOREAU) == TF_OK &&
                 (s.report.choices > 1 || s.x.mode == TF_PINNED);
    for (int i = 0; i < parts && known; i++) {
      exact.u.omega0 += exact.u.alpha * exact.k.dt;
      known = sim_step(&exact, LOCATED) == TF_OK;
    }
    right += known && s.x.mode == exact.x.mode;
    wrong += known && s.x.mode != exact.x.mode;
  }
  printf("# %ld of %ld end in another mode\n", wrong, right + wrong);
  CHECK_ABOVE(right, samples(IS_DOUBLE ? 6000 : 1000));
  CHECK(1000 * wrong <= right);
}
