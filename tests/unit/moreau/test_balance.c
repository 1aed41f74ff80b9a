/* The energy that a step creates, what is done about it, and what is said where
 * a step is too long for the motion; over the whole ranges of parameters. */
#include "../../../src/moreau/balance.h"
#include "../../../src/moreau/scheme.h"
#include "codim2_field.h"
#include "scheme.h"
#include "sim.h"

static real energy_of(const ref_machine_t *q, end_state_t x) {
  const real r = wide(x.r), w = wide(x.w);
  return ref_energy(q, r, wide(x.v) - q->d * w, w, r - q->r0);
}

/* No contact, no damping, nothing that drives: energy is kept. */
static tf_params_t conservative(void) {
  tf_params_t p = tf_scenes[0]->params;
  p.law = TF_TYRE_NONE;
  p.c1 = p.c2 = 0;
  p.m = log_uniform(0.1, 10);
  p.d = uniform(-2, 2);
  p.beta = log_uniform(0.01, 1);
  p.k2 = log_uniform(1e-2, 1e8);
  p.r0 = uniform(-1, 1);
  p.theta = tap_bits() % 2 ? TF_R(0.5) : uniform(0.5, 1);
  p.dt = log_uniform(1e-5, 1e-1);
  return p;
}

static tf_state_t moving(void) {
  return (tf_state_t){
      .r = uniform(-1, 1), .v = uniform(-5, 5), .w = uniform(-20, 20)};
}

static end_state_t place(const tf_state_t *x) {
  return (end_state_t){x->r, x->v, x->w};
}

/* Rounding of an energy that is read from a state. */
static real noise(const ref_machine_t *q, end_state_t x) {
  const real r = fabsl(wide(x.r)), w = fabsl(wide(x.w));
  const real p = fabsl(wide(x.v)) + fabsl(q->d) * w;
  const real energy = ref_energy(q, r, p, w, r + fabsl(q->r0));
  return 64 * EPSILON * (2 * energy + wide(TF_REAL_MIN));
}

/* (17): what the linear step creates is the difference of the energies; and a
 * step that is beyond doubt neither creates energy nor is too long. */
TEST(created_energy_in_closed_form) {
  int sure = 0;
  for (int i = 0; i < samples(20000); i++) {
    const tf_params_t p = conservative();
    const tf_machine_t k = prepared(&p);
    const ref_machine_t q = {PARAMETERS_OF(real, &p)};
    const tf_input_t u = tf_input_default(&k);
    const tf_state_t x = moving();
    const linear_t l = linearise(&k, &x, &u, velocities(&k, &x, u.omega0));
    if (!l.definite) continue;
    const end_state_t from = place(&x);
    const end_state_t to = end_after(&k, &l, (change_t){0, 0});
    const balance_t b = balance_of(&k, is_midpoint(&k), &u, from, to, 0);
    const tf_real_t energy = mean_energy(&k, &u, from, to);
    const real made = energy_of(&q, to) - energy_of(&q, from);
    const real room = noise(&q, from) + noise(&q, to);
    const real terms =
        wide(k.m) * (wide(to.v) * wide(to.v) + wide(to.w) * wide(to.w) +
                     wide(from.w) * wide(from.w));
    CHECK_NEAR(wide(b.created), made, 64 * (room + EPSILON * terms));
    CHECK(b.friction == 0);
    const real both = energy_of(&q, from) + energy_of(&q, to);
    CHECK(fabsl(wide(b.product)) <= both * (1 + 64 * EPSILON) + room);
    CHECK_NEAR(wide(energy), both / 2, room);
    if (!is_balanced(&b)) continue;
    CHECK(!creates_energy(&b, energy));
    CHECK(!is_too_coarse(&k, &b, energy, from, to));
    sure++;
  }
  CHECK(sure > samples(2000));
}

static long accepted, coarse;

/* Steps on; the energy rises by no more than a share of what there is. With
 * `all` it does so whatever the status, else those steps are asked that say
 * nothing was wrong. */
static void follow(sim_t *s, scheme_t scheme, int steps, bool all, real share) {
  const ref_machine_t q = {PARAMETERS_OF(real, &s->params)};
  for (int n = 0; n < steps; n++) {
    const end_state_t from = place(&s->x);
    const tf_status_t status = sim_step(s, scheme);
    if (status < TF_OK || (!all && status != TF_OK)) break;
    const end_state_t to = place(&s->x);
    const real before = energy_of(&q, from), after = energy_of(&q, to);
    CHECK(after - before <= share * (before + after) / 2 +
                                32 * (noise(&q, from) + noise(&q, to)));
    accepted++;
    coarse += status == TF_COARSE;
  }
}

/* Whatever its status, an accepted step of a machine without friction creates
 * at most TF_CREATED_SHARE of its energy; of the located step, which keeps a
 * tolerance, those are asked that say it was kept. */
TEST(no_step_creates_energy) {
  accepted = coarse = 0;
  for (int i = 0; i < samples(6000); i++) {
    const scheme_t scheme = (scheme_t)(i % SCHEMES);
    const bool located = scheme == LOCATED;
    tf_params_t p = conservative();
    if (located) p.tolerance = IS_DOUBLE ? TF_R(1e-10) : TF_R(1e-6);
    sim_t s = sim_of(&p);
    s.x = moving();
    follow(&s, scheme, 20, !located,
           located ? 1e-2L : 2.01L * TF_CREATED_SHARE);
  }
  CHECK_ABOVE(accepted, samples(30000));
  CHECK_ABOVE(coarse, samples(1000));
}

/* A spring that swings by phi a step, beside a disc that stands still. */
static tf_status_t swinging(double phi, double theta, double stretch) {
  tf_params_t p = tf_scenes[0]->params;
  p.law = TF_TYRE_NONE;
  p.c1 = p.c2 = p.d = p.r0 = 0;
  p.m = p.beta = 1;
  p.dt = TF_R(0x1p-7);
  p.k2 = (tf_real_t)(phi * phi * 0x1p14);
  p.theta = (tf_real_t)theta;
  sim_t s = sim_of(&p);
  s.x = (tf_state_t){.r = (tf_real_t)stretch};
  return sim_step(&s, MOREAU);
}

TEST(a_turn_beyond_a_right_angle_is_coarse) {
  CHECK(swinging(0.5, 0.5, 1) == TF_OK);
  CHECK(swinging(1.9, 0.5, 1) == TF_OK);
  CHECK(swinging(2.1, 0.5, 1) == TF_COARSE); /* tan(45 degrees) = phi/2 */
  CHECK(swinging(100, 0.5, 1) == TF_COARSE);
  CHECK(swinging(100, 0.5, 0) == TF_OK); /* at rest it is right */
  CHECK(swinging(0.3, 1, 1) == TF_OK);
  CHECK(swinging(2, 1, 1) == TF_COARSE); /* damped away by theta */
}

/* Outer forces may turn a motion that has next to no energy. */
TEST(a_reversal_is_not_coarse) {
  tf_params_t p = tf_scenes[0]->params;
  p.law = TF_TYRE_NONE;
  p.k2 = p.r0 = 0;
  p.dt = TF_R(1e-3);
  sim_t s = sim_of(&p);
  s.u.force = -1;
  s.x = (tf_state_t){.v = TF_R(1e-5)};
  CHECK(sim_step(&s, MOREAU) == TF_OK);
  CHECK(s.x.v < 0);
}

/* The end of a slip of size R that has h = g = 0 within reach, and its course,
 * in the field over the step. */
static int end_near_codim2(const tf_machine_t *k, const tf_state_t *x,
                           tf_slip_t *now, codim2_course_t *course,
                           tf_contact_modes_t *s, step_end_t *to) {
  const tf_input_t u = tf_input_default(k);
  const start_t start = start_of(k, x, &u);
  free_motion_t c = free_motion(k, x, &u, start);
  inclusion_t in;
  if (!c.linear.definite) return 0;
  const unsigned signs = solve_inclusion(&c, &in, s);
  if (!is_near_codim2(&c, &in, signs, s->set)) return 0;
  add_pinned_point(&c, &in);
  tf_codim2_end(&c, &in, to);
  *now = c.start.slip;
  const codim2_field_t field = {{in.h.c0 - now->h, in.h.cx, in.h.cy},
                                {in.g.c0 - now->g, in.g.cx, in.g.cy},
                                {2, 2}};
  *course =
      tf_codim2_course(&k->contact, &field, *now, now->h > 0 ? PLUS : MINUS);
  return 1;
}

/* A slip that follows its course past h = g = 0, with several futures, and
 * turns by more than 29 degrees, may have missed one: where it loses its mode
 * and where it comes nearer by 29 %. Else it is TF_OK. */
TEST(a_slip_that_may_miss_its_future_is_coarse) {
  int lost = 0, nearer = 0, neither = 0;
  for (int n = 0; n < samples(40000); n++) {
    tf_params_t p = any_params(n);
    p.dt = TF_R(1e-3);
    const tf_machine_t k = prepared(&p);
    const tf_real_t z = uniform(-0.01, 0.01);
    tf_state_t x = {.r = uniform(-0.6, 0.6), .w = p.omega0 + z};
    x.v = k.d * z + uniform(-0.003, 0.003);
    x.mode = tf_slip(&k, x.r, x.v, x.w, p.omega0).h > 0 ? TF_SLIP_PLUS
                                                        : TF_SLIP_MINUS;
    tf_slip_t now;
    codim2_course_t course;
    tf_contact_modes_t s;
    step_end_t to;
    if (!end_near_codim2(&k, &x, &now, &course, &s, &to) ||
        !to.outcome.is_mean || course.mode >= TF_PINNED || size_of(s.set) < 2)
      continue;
    const real before = hypotl(wide(now.h), wide(now.g));
    const real after = hypotl(wide(course.slip.h), wide(course.slip.g));
    const real cosine = (wide(now.h) * wide(course.slip.h) +
                         wide(now.g) * wide(course.slip.g)) /
                        (before * after);
    const bool loses = course.mode != x.mode, nears = after < 0.71L * before;
    const bool misses = cosine <= 0.875L && (loses || nears);
    if (!misses && 5 * before < after) continue; /* it sets out from there */
    CHECK(to.outcome.status == (misses ? TF_COARSE : TF_OK));
    lost += misses && !nears;
    nearer += misses && nears;
    neither += !misses;
  }
  CHECK_ABOVE(lost, samples(200));
  CHECK_ABOVE(nearer, samples(200));
  CHECK_ABOVE(neither, samples(200));
}

/* A spring that turns by 1/45 rad a step or more gains 2^-20 of the energy a
 * step at most: what linearisation makes in a period does not add up. */
TEST(a_stiff_spring_gains_no_energy_in_time) {
  enum { STEPS = 50000 };
  for (int i = 0; i < 8; i++) {
    tf_params_t p = conservative();
    p.m = p.r0 = 1;
    p.k2 = log_uniform(100, 1e5);
    p.beta = TF_R(0.5);
    p.theta = TF_R(0.5);
    p.dt = uniform(0.04, 0.3) / (tf_real_t)sqrt((double)p.k2);
    sim_t s = sim_of(&p);
    s.x = (tf_state_t){
        .r = uniform(0.8, 1.2), .v = uniform(-1, 1), .w = uniform(-3, 3)};
    const real most = wide(tf_energy(&s.k, &s.x, s.u.r0)) *
                      (expl(STEPS * 0x1p-20L) + 2048 * EPSILON);
    for (int n = 0; n < STEPS; n++) {
      CHECK(sim_step(&s, MOREAU) >= TF_OK);
      CHECK(wide(tf_energy(&s.k, &s.x, s.u.r0)) <= most);
    }
  }
}

/* The end of a step in long double, of (6) or (18). */
typedef struct {
  real r, v, w;
} wide_end_t;

/* One step: its machine, how it starts and the force that it reports. */
typedef struct {
  scheme_step_t at;
  ref_machine_t q;
  real k, force, torque; /* k: theta dt */
  ref_force_t by;
} step_of_t;

static step_of_t step_of(const sim_t *s, const tf_state_t *x) {
  const real from[3] = {wide(x->r), wide(x->v), wide(x->w)};
  step_of_t a = {.at = scheme_step(&s->params, &s->u, from),
                 .q = reference_of(&s->params, &s->u),
                 .force = wide(s->u.force),
                 .torque = wide(s->u.torque),
                 .by = {wide(s->report.force.F), wide(s->report.force.M)}};
  a.k = a.at.theta * a.at.dt;
  return a;
}

static wide_end_t by_6(const step_of_t *a) {
  real end[3];
  scheme_end(&a->at, a->by.F, a->by.M, end);
  return (wide_end_t){end[0], end[1], end[2]};
}

/* (18) with its matrix held at (r, w, R), solved for (s, P, u) at the theta
 * point as three equations. */
static wide_end_t by_18_about(const step_of_t *a, real r, real w, real R) {
  const ref_machine_t *q = &a->q;
  const real *x = a->at.x, F = a->by.F;
  const real k = a->k, km = k / q->m, j = q->d / R;
  const real G = q->m * r * w / R, b = a->force + F * q->sine;
  const real c = a->torque + F * (r * q->cosine - q->d * q->sine) + a->by.M;
  const real from[3] = {x[0] - q->r0, x[1] - q->d * x[2],
                        hypotl(q->beta, x[0]) * x[2]};
  real A[3][4] = {
      {1, -k, -k * j, from[0]},
      {km * q->k2, 1 + km * q->c2, km * (q->c2 * j - G), from[1] + km * b},
      {km * q->k2 * j, km * (q->c2 * j + G),
       1 + km * (q->c2 * j * j + q->c1 / (R * R)),
       from[2] + km * (j * b + c / R)}};
  real to[3];
  for (int i = 0; i < 3; i++)
    for (int n = i + 1; n < 3; n++)
      for (int m = 3; m >= i; m--) A[n][m] -= A[n][i] / A[i][i] * A[i][m];
  for (int i = 2; i >= 0; i--) {
    to[i] = A[i][3];
    for (int m = i + 1; m < 3; m++) to[i] -= A[i][m] * to[m];
    to[i] /= A[i][i];
  }
  for (int i = 0; i < 3; i++) to[i] = from[i] + (to[i] - from[i]) / a->at.theta;
  const real end_r = to[0] + q->r0, end_w = to[2] / hypotl(q->beta, end_r);
  return (wide_end_t){end_r, to[1] + q->d * end_w, end_w};
}

static wide_end_t by_18(const step_of_t *a) {
  const real *x = a->at.x, th = a->at.theta, first = a->at.r_t;
  const real R0 = (1 - th) * hypotl(a->q.beta, x[0]);
  wide_end_t end = by_18_about(a, first, x[2], hypotl(a->q.beta, first));
  for (int i = 0; i < 2; i++) {
    const real R1 = th * hypotl(a->q.beta, end.r);
    end = by_18_about(a, (1 - th) * x[0] + th * end.r,
                      (R0 * x[2] + R1 * end.w) / (R0 + R1), R0 + R1);
  }
  return end;
}

/* As a share of the velocities, but for what rounding does to r/dt. */
static bool leads_to(const step_of_t *a, wide_end_t end, const tf_state_t *to) {
  const real R = hypotl(a->q.beta, wide(to->r)), d = a->q.d, *x = a->at.x;
  const real v = wide(to->v), w = wide(to->w);
  const real size =
      fabsl(x[1] - d * x[2]) + fabsl(v - d * w) + R * (fabsl(x[2]) + fabsl(w));
  const real off = fabsl(v - end.v - d * (w - end.w)) + R * fabsl(w - end.w) +
                   fabsl(wide(to->r) - end.r) / a->at.dt;
  return off <= 1e-9L * size + 4 * EPSILON * fabsl(wide(to->r)) / a->at.dt;
}

/* Machines, springs, loads and turntables of all kinds; none is so light that
 * the rounding of F moves it. */
static sim_t loaded_machine(void) {
  tf_params_t p = moderate_params();
  p.law = (tf_tyre_law_t[]){TF_TYRE_JUMP, TF_TYRE_COULOMB,
                            TF_TYRE_NONE}[tap_bits() % 3];
  p.m = log_uniform(0.3, 3);
  p.k2 = log_uniform(1, 1e5);
  p.c1 = uniform(0, 0.1);
  p.c2 = uniform(0, 0.1);
  p.theta = tap_bits() % 3 ? TF_R(0.5) : uniform(0.5, 1);
  p.dt = log_uniform(1e-5, 0.3);
  sim_t s = sim_of(&p);
  s.u.force = uniform(-1, 1);
  s.u.torque = uniform(-1, 1);
  s.u.alpha = tap_bits() % 2 ? 0 : uniform(-1, 1);
  s.x.r = uniform(-0.5, 0.5);
  s.x.v = uniform(-1, 1);
  s.x.w = uniform(-3, 3);
  return s;
}

/* Where a step is TF_OK its force leads to its end: by (6); on a stiff spring,
 * of a slip that goes on or without friction, by (6) or (18). */
TEST(reported_force_leads_to_the_end) {
  if (!IS_DOUBLE)
    SKIP("a stiff spring rounds by more than (6) and (18) differ");
  long plain = 0, balanced = 0;
  for (int i = 0; i < samples(8000); i++) {
    sim_t s = loaded_machine();
    if (sim_begin(&s) != TF_OK) continue;
    for (int n = 0; n < 10; n++) {
      const tf_state_t x = s.x;
      s.u.omega0 += s.u.alpha * s.k.dt;
      if (sim_step(&s, MOREAU) != TF_OK) break;
      const step_of_t a = step_of(&s, &x);
      const bool linear = leads_to(&a, by_6(&a), &s.x);
      const bool is_stiff = 0x1p13L * wide(s.k.a) >= a.q.m;
      const bool goes_on =
          a.by.F == 0 || (x.mode == s.x.mode && x.mode <= TF_SLIP_MINUS);
      CHECK(linear || (is_stiff && goes_on && leads_to(&a, by_18(&a), &s.x)));
      plain += linear;
      balanced += !linear;
    }
  }
  CHECK_ABOVE(plain, samples(20000));
  CHECK_ABOVE(balanced, samples(1000));
}
