/* How the simulated motion converges to the true one. */
#include "problems.h"
#include "sim.h"

/* The whole cycle of `chaos` up to the two-fold, event by event: entry of
 * stick- at codimension two, its end at the turning point of the spring, entry
 * of the lower sliding region, arrival at the two-fold (A changes sign). Times
 * converge with the step; stick- ends at h = g = 0, where a step ends early; at
 * the two-fold the sliding field is 0/0 and the constant is larger. */
TEST(cycle_converges_up_to_the_two_fold) {
  const reference_event_t *want = reference_course(0)->event; /* its four */
  static const double bound[4] = {2, 2, 3, 20};
  static const double dts[] = {1e-3, 3.7e-4, 1e-4, 2.3e-5, 1e-5};
  const int sizes = IS_DOUBLE ? 5 : 3;
  const double rounding = IS_DOUBLE ? 1e-6 : 5e-3;
  for (int i = 0; i < sizes; i++) {
    tf_params_t p = tf_scenes[0]->params;
    p.dt = (tf_real_t)dts[i];
    sim_t s = sim_at_start(tf_scenes[0], &p, 0);
    int event = 0;
    for (long n = 1; (double)n * dts[i] < 2.1 && event < 4; n++) {
      const uint8_t before = s.x.mode;
      CHECK(ok_to_resolution(sim_step(&s, MOREAU)));
      const int now =
          event == 0   ? s.x.mode == TF_STICK_MINUS
          : event == 1 ? before == TF_STICK_MINUS && s.x.mode != before
          : event == 2 ? before == TF_SLIP_MINUS && s.x.mode == TF_STICK_PLUS
                       : s.report.delassus <= 0;
      if (!now) continue;
      CHECK_NEAR((double)n * dts[i], want[event].t,
                 bound[event] * dts[i] + rounding);
      event++;
    }
    CHECK(event == 4);
  }
}

/* From a stick a random machine comes to h = g = 0 at the same time and takes
 * the same mode at every step size; 1 in 100 may pass over a shorter one. */
TEST(branch_does_not_depend_on_the_step_size) {
  int ends = 0, several = 0, other = 0;
  for (int i = 0; i < samples(24000); i++) {
    sim_t first = {.params = wide_params()};
    tf_params_t p = first.params;
    p.rule = (tf_rule_t)(i % TF_RULE_RANDOM);
    const double r = tap_uniform(-0.6, 0.6), z = tap_uniform(-1, 1);
    const unsigned stick = tap_bits() & 1 ? TF_STICK_PLUS : TF_STICK_MINUS;
    for (int n = 0; n < 3 * SCHEMES; n++) {
      const double finer = 1u << 2 * (n % 3);
      p.dt = TF_R(1e-3) / (tf_real_t)finer;
      sim_t s = {.params = p};
      if (sim_place(&s, r, (double)p.omega0 + z, 0, stick) != TF_OK ||
          s.x.mode != stick || s.report.choices > 1)
        break;
      while (s.x.mode == stick && (double)s.x.tick < 1000 * finer)
        if (!CHECK(sim_step(&s, (scheme_t)(n / 3)) >= TF_OK)) return;
      if (n % 3 == 0) first = s;
      ends += s.x.mode != stick;
      several += s.x.mode != stick && s.report.choices > 1;
      other += s.x.mode != first.x.mode ||
               fabs((double)s.x.tick / finer - (double)first.x.tick) > 3;
    }
  }
  CHECK_ABOVE(several, samples(1200));
  CHECK_BELOW(100 * other, ends);
}

/* A slip that comes to h = g = 0 within a step of dt goes on as in the located
 * step. */
static void goes_on_as_located(motion_t m, double mu, double dt, double end) {
  m.params.mu = (tf_real_t)mu;
  sim_t s = sim_under(&m, dt), exact = sim_under(&m, end);
  CHECK(sim_step(&exact, LOCATED) >= TF_OK);
  while ((double)s.x.tick * dt < end - dt / 2)
    CHECK(sim_step(&s, MOREAU) >= TF_OK);
  const double v = (double)exact.x.v;
  CHECK(s.x.mode == exact.x.mode);
  CHECK_NEAR((double)s.x.v, v, 1e-4 + 0.02 * fabs(v));
}

/* Under a large friction: nothing is left there of the speeds of the slip. With
 * their share in the free motion the step took slip-, and v reached -70 m/s in
 * 0.2 ms. */
TEST(slip_stopped_within_a_step_goes_on_as_located) {
  const motion_t m = {
      .params = tf_scenes[0]->params, .r = 0.18, .v = -0.030339, .w = -1.037};
  for (int i = 0; i < 12; i++) {
    const int longer = i % 3, larger = i / 3;
    goes_on_as_located(m, pow(10, 3 + larger), pow(10, -6 + longer), 3e-3);
  }
}

/* On the axis, where r vanishes: the disc goes on turning against the
 * turntable. */
TEST(slip_that_comes_to_the_axis_goes_on_as_located) {
  if (!IS_DOUBLE) SKIP("rounding of float moves it away from there");
  motion_t m = {.params = tf_scenes[0]->params};
  for (int i = 0; i < 9; i++) {
    const double z = i % 3 == 0 ? 0.2 : i % 3 == 1 ? -0.4 : 1;
    const int larger = 2 * (i / 3);
    m.w = (double)m.params.omega0 + z;
    m.v = (double)m.params.d * z + 1e-5;
    m.r = -0.5e-4 * m.v;
    goes_on_as_located(m, pow(10, larger), 1e-4, 4e-4);
  }
}

/* How far a step is from 64 steps of its time, in p and R z as a share of them
 * and of their change; < 0 where these are not all OK. */
static double error_of_step(const sim_t *from, const sim_t *to) {
  sim_t s = *from;
  s.params.dt /= 64;
  CHECK(sim_prepare(&s) == TF_OK);
  for (int n = 0; n < 64; n++)
    if (sim_step(&s, MOREAU) != TF_OK) return -1;
  const double R = hypot((double)to->x.r, (double)s.params.beta);
  const double d = (double)s.params.d, omega0 = (double)s.u.omega0;
  const double v = (double)from->x.v, w = (double)from->x.w;
  const double dv = (double)s.x.v - v, dw = (double)s.x.w - w;
  const double off = (double)to->x.w - (double)s.x.w;
  return (fabs((double)to->x.v - (double)s.x.v - d * off) + R * fabs(off)) /
         (fabs(v - d * (w - omega0)) + R * fabs(w - omega0) +
          fabs(dv - d * dw) + R * fabs(dw));
}

/* By how many radii of gyration the slider would move in the next step. */
static double reach(const sim_t *s) {
  return (double)s->k.dt * fabs((double)s->x.v) /
         hypot((double)s->x.r, (double)s->params.beta);
}

/* A small disc beside the axis, whose inertia changes by much in a step. */
static motion_t towards_the_axis(void) {
  motion_t m = {.params = wide_params()};
  m.params.beta = log_uniform(1e-4, 1e-2);
  m.params.c1 = 0;
  m.params.mu = log_uniform(0.1, 10);
  m.r = tap_uniform(0.01, 0.15);
  m.v = tap_uniform(-2, 0);
  m.w = (double)m.params.omega0 + tap_uniform(-2, 2);
  return m;
}

/* Of the OK steps that move it by a radius of gyration few are a quarter off:
 * 1 in 120, where it was 1 in 50 when only the sign of r was looked at. */
TEST(fast_passes_of_the_axis_are_right_or_coarse) {
  static const double dts[] = {1e-3, 1e-4, 1e-5};
  long right = 0, wrong = 0;
  for (int trial = 0; trial < samples(12000); trial++) {
    const motion_t m = towards_the_axis();
    const double dt = dts[trial % 3];
    sim_t s = sim_under(&m, dt);
    for (int n = 0; n * dt < 0.1 && s.report.status >= TF_OK; n++) {
      const sim_t from = s;
      const tf_status_t status = sim_step(&s, MOREAU);
      if (status != TF_OK || (reach(&s) < 1 && reach(&from) < 1)) continue;
      const double error = error_of_step(&from, &s);
      right += error >= 0 && error < 0.25;
      wrong += error >= 0.25;
    }
  }
  CHECK_ABOVE(right, samples(400));
  CHECK_BELOW(80 * wrong, right);
}

/* A constant rate of exit means the same mean time in an escaping stick at
 * every step size: exponential, so mean = deviation = 1/rate. */
TEST(random_exit_rate_is_independent_of_dt) {
  const double rate = 2000;
  const int count = samples(4000);
  for (int i = 0; i < 3; i++) {
    sim_t s = {.params = tf_scenes[0]->params};
    double sum = 0;
    int plus = 0;
    s.params.rule = TF_RULE_RANDOM;
    s.params.rate = (tf_real_t)rate;
    s.params.dt = (tf_real_t)(1e-4 / (1 << 2 * i));
    for (int n = 0; n < count; n++) {
      CHECK(sim_place(&s, 0.18, -1.015, 0, TF_STICK_PLUS) == TF_OK);
      s.x.seed = (uint32_t)n;
      if (!CHECK(s.x.mode == TF_STICK_PLUS && s.report.choices == 3)) return;
      while (s.x.mode == TF_STICK_PLUS && s.x.tick < 1000000)
        CHECK(ok_to_resolution(sim_step(&s, MOREAU)));
      sum += ((double)s.x.tick - 0.5) * (double)s.params.dt;
      plus += s.x.mode == TF_SLIP_PLUS;
    }
    /* four standard errors; the stay is known to half a step */
    CHECK_NEAR(sum / count * rate, 1, 4 / sqrt(count) + 0.004);
    CHECK_NEAR((double)plus / count, 0.5, 2 / sqrt(count));
  }
}
