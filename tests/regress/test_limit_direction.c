/* A slip that comes to h = g = 0 along a limit direction next to h = 0. The
 * force at h -> 0, which keeps h on its side, used to throw it off that way: it
 * came to the point as a stick, which rests there, and not as the slip that
 * goes on. */
#include "sim.h"

TEST(a_slip_keeps_to_its_limit_direction) {
  if (!IS_DOUBLE) SKIP("h is below the rounding of float");
  tf_params_t p = tf_scenes[0]->params;
  p.m = TF_R(0.3088456690311432), p.d = TF_R(1.8215008974075317);
  p.beta = TF_R(0.48602965474128723), p.k2 = TF_R(4.453408241271973);
  p.c1 = TF_R(0.0010000000474974513), p.c2 = TF_R(0.24436789751052856);
  p.r0 = TF_R(0.392892986536026), p.omega0 = TF_R(-0.24714221060276031);
  p.mu = TF_R(0.601233720779419), p.kappa = TF_R(0.7191415429115295);
  p.gamma = TF_R(-3.0847599506378174), p.dt = TF_R(1e-5);
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
  tf_params_t p = tf_scenes[0]->params;
  p.m = TF_R(1.6741051720577702), p.d = TF_R(0.897036930044119);
  p.beta = TF_R(0.065979097133071984), p.k2 = TF_R(21.653450858096122);
  p.c1 = TF_R(0.34992912682302868), p.c2 = TF_R(0.56301621699299287);
  p.r0 = TF_R(0.20758841628559055), p.omega0 = TF_R(1.6790561858864832);
  p.mu = TF_R(2.5902964020275858), p.kappa = TF_R(0.72357494601498307);
  p.gamma = TF_R(-2.2994118004242732);
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

/* A slip of a strong friction that crosses h = 0 at once and comes to h = g = 0
 * in another mode: as a slip it rests there, as a stick it leaves. One step
 * said OK and rested. */
TEST(a_slip_that_changes_its_mode_before_it_rests_is_coarse) {
  static const double machine[MACHINE] = {
      0.58160943304187795,    -0.34613037640057165, 0.15409174879271767,
      17.823370038120061,     0.43999552575648515,  0.33423498459060819,
      -0.0089075588271165795, -0.19355613820413264, 294.3363021653978,
      80.91839336830229,      1.6816018771946535};
  tf_params_t p = params_from(machine);
  p.dt = TF_R(0.045139678149174578);
  sim_t s = sim_of(&p);
  s.u.force = TF_R(2.8347072917434337);
  s.u.alpha = TF_R(0.73702565613945126);
  s.x.r = TF_R(0.027078657464076894);
  s.x.v = TF_R(0.0043332683141609103);
  s.x.w = TF_R(-0.16224668083442412);
  CHECK(sim_begin(&s) == TF_OK && s.x.mode == TF_SLIP_MINUS);
  CHECK(sim_step(&s, MOREAU) == TF_COARSE);
}
