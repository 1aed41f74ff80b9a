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
