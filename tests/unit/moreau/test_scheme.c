/* A step against the equations of the scheme, solved once more in long double
 * (support/scheme.h). */
#include "moreau/balance.h"
#include "scheme.h"
#include "sim.h"

typedef struct {
  sim_t s;
  scheme_step_t scheme;
} case_t;

static case_t random_case(tf_tyre_law_t law, double longest) {
  tf_params_t params = wide_params(), *p = &params;
  p->law = law;
  p->d = uniform(-1, 1);
  p->kappa = uniform(0.05, 1);
  draw_law_constants(p);
  p->theta = uniform(0.5, 1);
  p->dt = log_uniform(1e-4, longest);
  p->with_angle = true;
  case_t c = {.s = sim_of(p)};
  c.s.u = (tf_input_t){.omega0 = uniform(-2, 2),
                       .r0 = uniform(-1, 1),
                       .force = uniform(-2, 2),
                       .torque = uniform(-2, 2),
                       .alpha = uniform(-2, 2)};
  c.s.x = (tf_state_t){.r = uniform(0.3, 1.5),
                       .v = uniform(-1, 1),
                       .w = uniform(-3, 3),
                       .phi = uniform(-1, 1),
                       .mode = TF_NO_MODE,
                       .seed = 1};
  CHECK(sim_begin(&c.s) == TF_OK);
  const real x[3] = {wide(c.s.x.r), wide(c.s.x.v), wide(c.s.x.w)};
  c.scheme = scheme_step(p, &c.s.u, x);
  return c;
}

/* Whether a step of the scheme creates energy: then another one takes its
 * place, see test_balance. */
static bool creates_much(const case_t *c, const real x[3]) {
  const end_state_t from = {c->s.x.r, c->s.x.v, c->s.x.w};
  const end_state_t to = {(tf_real_t)x[0], (tf_real_t)x[1], (tf_real_t)x[2]};
  const balance_t b =
      balance_of(&c->s.k, is_midpoint(&c->s.k), &c->s.u, from, to, 0);
  return b.created > TF_GROWTH_SHARE / 3 * b.product;
}

/* (12), by the speed at the end. */
static real angle(const case_t *c, tf_real_t w) {
  const scheme_step_t *s = &c->scheme;
  return wide(c->s.x.phi) +
         s->dt * ((1 - s->theta) * s->x[2] + s->theta * wide(w));
}

/* (1)-(7) and (12) under the force that the step reports, for every law and
 * every theta; the angle of the plain step and of the compensated one. */
TEST(a_step_ends_where_the_scheme_says) {
  real worst = 0;
  int judged = 0;
  for (int i = 0; i < samples(20000); i++) {
    const case_t c = random_case((tf_tyre_law_t)(i % TF_TYRE_LAWS), 0.1);
    sim_t plain = c.s, pairs = c.s;
    real end[3];
    if (sim_step(&plain, MOREAU) != TF_OK) continue;
    const tf_force_t f = plain.report.force;
    scheme_end(&c.scheme, wide(f.F), wide(f.M), end);
    if (creates_much(&c, end)) continue;
    const real size = 1 + fabsl(end[0]) + fabsl(end[1]) + fabsl(end[2]);
    const real got[3] = {wide(plain.x.r), wide(plain.x.v), wide(plain.x.w)};
    for (int n = 0; n < 3; n++)
      worst = fmaxl(worst, fabsl(got[n] - end[n]) / size);
    CHECK_NEAR(plain.x.phi, angle(&c, plain.x.w), 4 * EPSILON * size);
    CHECK(sim_step(&pairs, COMPENSATED) == TF_OK);
    CHECK_NEAR(wide(pairs.x.phi) + wide(pairs.low.phi), angle(&c, pairs.x.w),
               4 * EPSILON * size);
    judged++;
  }
  CHECK_ABOVE(judged, samples(10000));
  CHECK_BELOW(worst, 20 * EPSILON);
}

/* The compensated step solves (6) with the parameters as they were given and
 * with M = s kappa F to twice the digits: what is left out of the inertia or of
 * that product would be an epsilon of the change of velocity. Slow machines
 * under a torque: theta dt v and e, which are rounded, are small there. */
TEST(compensated_changes_have_twice_the_digits) {
  real worst[2] = {0, 0};
  int sticks = 0, slips = 0;
  for (int i = 0; i < samples(20000); i++) {
    tf_params_t q = tf_scenes[0]->params;
    q.m = uniform(0.3, 3);
    q.beta = uniform(0.05, 1);
    q.d = uniform(-1, 1);
    q.c1 = q.c2 = q.k2 = 0;
    q.mu = 10;
    q.kappa = uniform(0.1, 1);
    q.gamma = uniform(0.5, 2.5);
    q.theta = 1;
    q.dt = TF_R(0.01);
    q.omega0 = 0;
    sim_t s = sim_of(&q);
    real at[4], to[4], end[3];
    s.u.torque = uniform(-9, 9);
    s.u.force = uniform(-9, 9);
    s.x.r = uniform(0.3, 1);
    s.x.w = uniform(-1e-3, 1e-3);
    const tf_real_t h = i % 2 ? 0 : TF_R(1e-3);
    CHECK(tf_speed_for_slip_compensated(&s.pairs, &s.x, &s.low, 0, h) == TF_OK);
    CHECK(sim_begin(&s) == TF_OK);
    sim_whole(&s, at);
    const scheme_step_t scheme = scheme_step(&q, &s.u, at);
    if (sim_step(&s, COMPENSATED) != TF_OK || s.x.mode == TF_PINNED) continue;
    const bool stick = !tf_mode_is_slip(s.x.mode);
    const real side = s.x.mode == TF_STICK_MINUS ? -1 : 1;
    const real F = wide(s.report.force.F), M = wide(s.report.force.M);
    /* Through h = g = 0 the force of a step is a mean, not that of a stick. */
    if (stick && (side * at[2] < 0 ||
                  fabsl(M - side * wide(q.kappa) * F) > 4 * EPSILON * fabsl(M)))
      continue;
    scheme_end(&scheme, F, stick ? side * wide(q.kappa) * F : M, end);
    sim_whole(&s, to);
    const real size = fabsl(end[1] - at[1]) + fabsl(end[2] - at[2]);
    const real off = fabsl(to[1] - end[1]) + fabsl(to[2] - end[2]);
    if (size < 0.02L) continue; /* below what long double resolves of it */
    worst[stick] = fmaxl(worst[stick], off / size);
    sticks += stick;
    slips += !stick;
  }
  CHECK_ABOVE(sticks, samples(3000));
  CHECK_ABOVE(slips, samples(500));
  for (int i = 0; i < 2; i++) CHECK_BELOW(worst[i], EPSILON / 16);
}

/* Where det S is not a number of the real type the response is not known:
 * the step is refused and not taken as if nothing acted. */
TEST(a_determinant_that_overflows_is_refused) {
  int overflows = 0;
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    tf_params_t p = params_of_law((tf_tyre_law_t)law);
    p.m = TF_R(1e12);
    p.k2 = TF_R(1e15);
    p.dt = p.theta = 1;
    p.d = 0;
    sim_t s = sim_of(&p);
    s.u = (tf_input_t){.omega0 = 1};
    for (int i = 0; i < 400; i++) {
      s.x = (tf_state_t){.r = log_uniform(1, 1e8), .w = log_uniform(1e-3, 10)};
      sim_t pairs = s;
      const real at[3] = {wide(s.x.r), 0, wide(s.x.w)};
      const scheme_step_t scheme = scheme_step(&p, &s.u, at);
      const bool over = !(scheme.det <= (real)TF_REAL_MAX);
      if (fabsl(scheme.det / (real)TF_REAL_MAX - 1) < 1e-3L) continue;
      const tf_status_t status = sim_step(&s, MOREAU);
      CHECK((status == TF_STEP_TOO_LONG) == over);
      CHECK(sim_step(&pairs, COMPENSATED) == status || !over);
      overflows += over;
    }
  }
  CHECK(IS_DOUBLE ? overflows == 0 : overflows > 100);
}
