/* A mode is a statement about the signs of h and g, and a step that returns
 * TF_OK ends with them: slip+ with h > 0, slip- with h < 0, stick+ with h = 0
 * and g >= 0, stick- with h = 0 and g <= 0, pinned with both 0, but for the
 * rounding of the state. A stick that comes to rest at h = g = 0
 * for ever does so too: rounding does not end its rest. And the mode is one of
 * the set that the step reports. */
#include "extremes.h"
#include "sim.h"

/* By the paper's h and g. The bound is twice that of slip_rounding(); a located
 * step begins what follows an event with what its tolerance leaves of h. */
static int has_its_signs(const sim_t *run, real tolerance) {
  const tf_state_t *x = &run->x;
  const paper_t paper = paper_of(&run->params);
  real at[4];
  sim_whole(run, at);
  const real h = paper_h(&paper, at), g = paper_g(&paper, at);
  const real tiny =
      wide(TF_REAL_MIN) +
      (64 * EPSILON + 2 * tolerance) *
          (fabsl(at[1]) + (fabsl(paper.d) + fabsl(at[0])) *
                              (fabsl(at[2]) + fabsl(paper.omega0)));
  if (x->mode == TF_SLIP_PLUS) return h > -tiny;
  if (x->mode == TF_SLIP_MINUS) return h < tiny;
  if (fabsl(h) > tiny) return 0;
  if (x->mode == TF_STICK_PLUS) return g > -tiny;
  if (x->mode == TF_STICK_MINUS) return g < tiny;
  return fabsl(g) <= tiny;
}

/* A machine of ordinary size, half of them with three members from anywhere in
 * their ranges, and a start near h = g = 0, mostly on h = 0; the slider is near
 * the axis in one start of three. */
static int draw_run(sim_t *run) {
  tf_params_t p = tf_scenes[0]->params;
  p.m = log_uniform(0.03, 30);
  p.d = uniform(0.2, 2);
  p.beta = log_uniform(0.005, 5);
  p.k2 = one_in(8) ? 0 : log_uniform(0.1, 300);
  p.c1 = one_in(2) ? 0 : uniform(0, 1);
  p.c2 = one_in(2) ? 0 : uniform(0, 1);
  p.r0 = uniform(-0.5, 0.5);
  p.omega0 = of_any_sign(log_uniform(0.1, 10));
  p.mu = log_uniform(0.01, 30);
  p.kappa = log_uniform(1e-3, 1);
  p.dt = log_uniform(1e-5, 1e-2);
  p.theta = one_in(2) ? TF_R(0.5) : 1;
  if (one_in(2))
    for (int n = 0; n < 3; n++) draw_member(&p, (int)(tap_bits() % 10));
  p.gamma = draw_gamma();
  if (one_in(20)) p.law = TF_TYRE_COULOMB;
  p.rest = (tf_rest_law_t)(tap_bits() % TF_REST_LAWS);
  p.rule = (tf_rule_t)(tap_bits() % TF_RULES);
  p.rate = 1000;
  if (p.omega0 == 0) return 0;
  const tf_real_t near = log_uniform(1e-4, 1);
  *run = sim_of(&p);
  run->x.r = uniform(-0.5, 0.5) * (one_in(3) ? log_uniform(1e-4, 1) : 1);
  run->x.w = p.omega0 * (1 + near * uniform(-1, 1));
  run->x.v = near * uniform(-1, 1);
  if (!one_in(4))
    tf_speed_for_slip(&run->k, run->x.r, run->x.w, p.omega0, 0, &run->x.v);
  return sim_begin(run) == TF_OK;
}

TEST(signs_are_those_of_the_mode) {
  for (int scheme = 0; scheme < SCHEMES; scheme++) {
    long good = 0, degraded = 0, wrong = 0;
    for (int i = 0; i < samples(20000); i++) {
      sim_t run;
      if (!draw_run(&run)) continue;
      for (int n = 0; n < 8; n++) {
        const tf_status_t status = sim_step(&run, (scheme_t)scheme);
        const real tolerance = scheme == LOCATED ? wide(run.k.tolerance) : 0;
        if (status < TF_OK) break;
        const int right =
            (run.report.set & TF_MODE_BIT(run.report.mode)) != 0 &&
            run.report.mode == run.x.mode && has_its_signs(&run, tolerance);
        good += status == TF_OK && right;
        wrong += status == TF_OK && !right;
        degraded += status == TF_DEGRADED;
      }
    }
    printf("# %-11s %ld steps as they say, %ld degraded, %ld wrong\n",
           scheme_name((scheme_t)scheme), good, degraded, wrong);
    CHECK(wrong == 0);
    CHECK(good > samples(50000) && degraded < good / 50);
  }
}

/* Stick with sign s of g at (r, g) on h = 0. */
static ref_rate_t stick_rate(const ref_machine_t *q, int s, real r, real g) {
  const ref_state_t x =
      ref_from_slip(q, (ref_state_t){.r = r, .piece = 1}, (ref_slip_t){0, g});
  const ref_edge_t edge = ref_edge(q, x, s);
  return ref_rate(q, x, ref_stick_force(q, s, edge.N / edge.A));
}

/* A machine whose stick tends to h = g = 0 for ever: at r it is at rest under
 * M = s kappa F exactly, and near it r and g decay without a turn. Starts on
 * the slower of the two directions. */
static int draw_rest(sim_t *run, int i, real *rest) {
  tf_params_t p = wide_params();
  p.k2 = uniform(0.5, 30);
  p.omega0 = i % 4 ? of_any_sign(log_uniform(0.1, 3)) : 0;
  p.dt = TF_R(1e-3);
  const int s = one_in(2) ? 1 : -1;
  const real r = of_any_sign(log_uniform(0.03, 0.5)), S = sinl(wide(p.gamma));
  const real Q_r = p.c1 * p.omega0 /
                   (p.d - (r * cosl(wide(p.gamma)) + s * wide(p.kappa)) / S);
  p.r0 = (tf_real_t)(r + (Q_r - p.m * r * p.omega0 * p.omega0) / p.k2);
  if (fabsl(S) < 0.1L || fabsl(Q_r / S) > 0.9L * p.mu) return 0;
  *run = sim_of(&p);
  const ref_machine_t q = reference_of(&p, &run->u);
  const real e = 1e-6L, nu = stick_rate(&q, s, r, 1).r;
  const real by_r =
      (stick_rate(&q, s, r + e, 0).g - stick_rate(&q, s, r - e, 0).g) / (2 * e);
  const real by_g =
      (stick_rate(&q, s, r, e).g - stick_rate(&q, s, r, -e).g) / (2 * e);
  const real root = by_g * by_g + 4 * by_r * nu;
  const real slow = (by_g + sqrtl(root > 0 ? root : 0)) / 2;
  if (!(root > 0 && by_g < 0 && by_r * nu < 0 && slow < -1.5L) ||
      ref_edge(&q, (ref_state_t){.r = r}, s).A <= 0)
    return 0;
  run->x.r = (tf_real_t)(r + nu * s * 1e-3L / slow);
  run->x.w = (tf_real_t)(p.omega0 + s * 1e-3L * S / run->x.r);
  tf_speed_for_slip(&run->k, run->x.r, run->x.w, p.omega0, 0, &run->x.v);
  *rest = r;
  return fabsl(run->x.r - r) < 0.01L * fabsl(r) && sim_begin(run) == TF_OK &&
         run->x.mode == (s > 0 ? TF_STICK_PLUS : TF_STICK_MINUS);
}

TEST(rounding_does_not_end_a_rest) {
  for (int scheme = 0; scheme < SCHEMES; scheme++) {
    int machines = 0, left = 0, degraded = 0;
    for (int i = 0; machines < 200; i++) {
      sim_t run;
      real rest;
      if (!draw_rest(&run, i, &rest)) continue;
      machines++;
      /* In float it decays to its rounding sooner. */
      const int steps = scheme == LOCATED ? 3000 : IS_DOUBLE ? 10000 : 6000;
      for (int n = 0; n < steps; n++)
        degraded += sim_step(&run, (scheme_t)scheme) == TF_DEGRADED;
      left += fabsl(run.x.r - rest) > 1e-3L * fabsl(rest) ||
              fabsl(wide(run.report.slip.g)) > 1e-4L;
    }
    printf("# %-11s %d of %d machines leave; %d steps degraded\n",
           scheme_name((scheme_t)scheme), left, machines, degraded);
    CHECK(left <= machines / 50);
    CHECK(degraded <= (scheme == COMPENSATED ? machines / 20 : 0));
  }
}
