/* The budget of the located step: so many segments, then the fixed step. */
#include "same_state.h"
#include "sim.h"

/* The same start, after a step within so many segments. */
static sim_t step_within(const sim_t *start, int segments) {
  sim_t end = *start;
  end.k.segments = (uint16_t)segments;
  sim_step(&end, LOCATED);
  return end;
}

/* A step needs so many segments: with those or more of them it ends in the same
 * bits, with fewer it says that it is coarse. Machines at random, in steps that
 * are long for them. */
TEST(located_budget_is_kept) {
  int needed[4] = {0, 0, 0, 0};
  for (int i = 0; i < samples(2000); i++) {
    sim_t s = {.params = moderate_params()};
    s.params.gamma = uniform(0.3, 2.8); /* h depends on v */
    s.params.dt = uniform(0.01, 0.2);
    CHECK(sim_place(&s, tap_uniform(0.1, 0.8), tap_uniform(-1.5, 1.5),
                    tap_uniform(-0.2, 0.2), TF_NO_MODE) == TF_OK);
    const sim_t want = step_within(&s, TF_LOCATED_MAX_SEGMENTS);
    if (want.report.status != TF_OK) continue;
    int least = 1;
    for (; step_within(&s, least).report.status != TF_OK; least++) {
      const sim_t end = step_within(&s, least);
      if (end.report.status <
          TF_OK) { /* what is left is too long for tf_step */
        CHECK(same_state(&end.x, &s.x));
      } else {
        CHECK(end.report.status >= TF_COARSE ||
              end.report.status == TF_DEGRADED);
        CHECK(end.report.set & TF_MODE_BIT(end.report.mode));
        CHECK(end.x.tick == s.x.tick + 1);
      }
      if (!CHECK(least < TF_LOCATED_MAX_SEGMENTS)) return;
    }
    for (int n = least; n < least + 8; n++) {
      const sim_t end = step_within(&s, n);
      CHECK(end.report.status == TF_OK);
      CHECK(same_state(&end.x, &want.x));
    }
    needed[least == 1 ? 0 : least == 2 ? 1 : least < 8 ? 2 : 3]++;
  }
  for (int i = 0; i < 4; i++) CHECK_ABOVE(needed[i], samples(20));
}

/* The angle of a disc that turns evenly is speed times time, although most of
 * the step is left to the fixed step: what the segments have turned counts. */
TEST(angle_is_kept_where_the_budget_ends) {
  for (int i = 0; i < samples(200); i++) {
    tf_params_t p = tf_scenes[0]->params;
    p.law = TF_TYRE_NONE;
    p.d = p.r0 = p.c1 = p.c2 = 0;
    p.beta = 1;
    p.k2 = uniform(50, 200);
    p.dt = uniform(0.2, 0.4);
    p.with_angle = true;
    sim_t s = sim_of(&p);
    s.x.r = TF_R(1e-3);
    s.x.w = uniform(-3, 3);
    CHECK(sim_begin(&s) == TF_OK);
    const sim_t end = step_within(&s, 1);
    CHECK(end.report.status == TF_COARSE);
    CHECK_NEAR(wide(end.x.phi), wide(s.x.w) * wide(p.dt), 5e-5L);
  }
}

/* A budget of 0 is that of the build, what is behind the point is dropped, so
 * what is below 1 is 0. */
TEST(located_budget_is_a_parameter) {
  const struct {
    double given;
    int want;
  } cases[] = {{0, TF_LOCATED_SEGMENTS},
               {0.5, TF_LOCATED_SEGMENTS},
               {0.999, TF_LOCATED_SEGMENTS},
               {1, 1},
               {7.9, 7},
               {1000, 1000}};
  tf_params_t p = tf_scenes[0]->params;
  tf_machine_t k;
  for (int i = 0; i < 6; i++) {
    p.segments = (tf_real_t)cases[i].given;
    CHECK(tf_prepare(&k, &p, NULL) == TF_OK && k.segments == cases[i].want);
  }
}
