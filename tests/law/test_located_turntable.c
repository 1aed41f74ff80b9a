/* The located step on a turntable that changes its speed: what it makes of rest
 * does not depend on where its steps end. */
#include "sample.h"
#include "sim.h"

/* Steps to t_end. to_stick, to_slip: how often a rest has become one. */
typedef struct {
  tf_state_t x;
  int to_stick, to_slip, not_ok;
} course_t;

static course_t follow(const motion_t *ramp, double t_end, int n) {
  course_t c = {.not_ok = 0};
  sim_t s = sim_under(ramp, t_end / n);
  for (int i = 1; i <= n; i++) {
    const unsigned before = s.x.mode;
    sim_turn(&s, ramp);
    c.not_ok += !ok_to_resolution(sim_step(&s, LOCATED));
    /* A stick that passed a two-fold is left by the rule, in the next step. */
    c.not_ok += tf_mode_is_slip(s.x.mode) && s.report.choices > 1 &&
                before > TF_SLIP_MINUS && before < TF_PINNED;
    if (before != TF_PINNED || s.x.mode == TF_PINNED) continue;
    c.to_stick += s.x.mode > TF_SLIP_MINUS;
    c.to_slip += s.x.mode <= TF_SLIP_MINUS;
  }
  c.x = s.x;
  return c;
}

/* A machine at rest under loads by which friction has these shares of mu and
 * kappa mu. */
static motion_t resting(int i) {
  motion_t ramp = {.params = random_params()};
  tf_params_t *p = &ramp.params;
  p->tolerance = TF_R(1e-10);
  p->rest = (tf_rest_law_t)(i % TF_REST_LAWS);
  p->rule = (tf_rule_t)(i / TF_REST_LAWS % TF_RULE_RANDOM);
  ramp.r = tap_uniform(-0.5, 0.5);
  ramp.w = (double)p->omega0;
  ramp.alpha = tap_uniform(-3, 3);
  tf_input_t u = {.r0 = p->r0, .omega0 = p->omega0};
  u.alpha = (tf_real_t)ramp.alpha;
  const double F = tap_uniform(-1, 1) * (double)p->mu;
  load_for(p, &u, (tf_real_t)ramp.r, p->omega0, F,
           tap_uniform(-1, 1) * (double)(p->mu * p->kappa));
  ramp.force = (double)u.force;
  ramp.torque = (double)u.torque;
  return ramp;
}

/* Rest of every law, and every rule that does not draw; ends that both say they
 * know. */
TEST(rest_does_not_depend_on_the_step) {
  if (!IS_DOUBLE) SKIP("rounding of float hides the error of the series");
  int to_stick = 0, to_slip = 0, by_rule = 0;
  for (int i = 0; i < samples(4000); i++) {
    const motion_t ramp = resting(i);
    const course_t a = follow(&ramp, 0.1, 10), b = follow(&ramp, 0.1, 400);
    if (a.not_ok || b.not_ok || a.to_stick + b.to_stick + b.to_slip == 0)
      continue;
    CHECK(sim_apart(&a.x, &b.x) < 1e-6);
    to_stick += b.to_stick;
    to_slip += b.to_slip;
    by_rule += b.to_slip && ramp.params.rule != TF_RULE_PERSIST;
  }
  CHECK_ABOVE(to_stick, 50);
  CHECK_ABOVE(to_slip, 50);
  CHECK_ABOVE(by_rule, 20);
}

/* A wheel that may rest rests, whatever sign omega0 has, and where it has none:
 * v = 0 and w = omega0. */
TEST(rest_goes_on_while_the_turntable_passes_0) {
  int steps = 0;
  for (int i = 0; i < samples(400); i++) {
    motion_t m = {.params = tf_scenes[0]->params};
    m.params.mu = 5;
    m.params.rest = (tf_rest_law_t)(i % TF_REST_LAWS);
    const double dt = (double)log_uniform(1e-5, 1e-2);
    const double zero = i % 4 ? tap_uniform(0.3, 0.7) * 50 * dt : 25 * dt;
    const tf_real_t r = uniform(0.08, 0.12);
    m.alpha = tap_uniform(-0.05, 0.05);
    m.params.omega0 = (tf_real_t)(-m.alpha * zero);
    m.r = (double)r;
    m.w = (double)m.params.omega0;
    sim_t s = sim_under(&m, dt);
    for (int n = 1; n <= 50 && s.x.mode == TF_PINNED; n++) {
      const tf_real_t before = s.u.omega0;
      s.u.omega0 = (tf_real_t)(m.alpha * (n * dt - zero));
      /* By the ramp, or by what the speeds of both ends say. */
      if (i % 2) s.u.alpha = (s.u.omega0 - before) / s.params.dt;
      CHECK(ok_to_resolution(sim_step(&s, LOCATED)));
      if (s.x.mode != TF_PINNED) break;
      CHECK(s.report.status == TF_OK);
      CHECK(s.x.r == r && s.x.v == 0 && s.x.w == s.u.omega0);
      steps++;
    }
  }
  CHECK_ABOVE(steps, samples(400) * 10);
}

/* A jump of omega0 is no rounding: the wheel slips. In float the terms of a
 * slip shorter than 1e-7 s overflow. */
TEST(rest_ends_where_the_turntable_jumps) {
  sim_t s = sim_of(&tf_scenes[0]->params);
  s.params.mu = 5;
  s.params.dt = TF_R(1e-3);
  CHECK(sim_prepare(&s) == TF_OK);
  s.x = (tf_state_t){.r = TF_R(0.1), .mode = TF_PINNED};
  s.u.omega0 = (tf_real_t)(IS_DOUBLE ? 1e-5 : 1e-4);
  for (int i = 0; i < 2; i++) {
    sim_t jump = s;
    jump.u.alpha = i ? jump.u.omega0 / jump.params.dt : 0;
    CHECK(sim_step(&jump, LOCATED) >= TF_OK);
    CHECK(jump.report.status == TF_OK);
    if (i) CHECK(jump.x.mode == TF_PINNED && jump.x.w == jump.u.omega0);
    if (!i) CHECK(jump.x.r != s.x.r);
  }
}
