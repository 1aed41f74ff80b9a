/* The solution set of one step: its forms against the same discrete step in
 * long double, from the mass matrix in (v, w) and a plain 2 x 2 inverse; its
 * modes against those of a contact with these forms, which test_joint.c judges
 * by brute force. */
#include "extremes.h"
#include "friction/inclusion.h"
#include "moreau/balance.h"
#include "moreau/stages.h"
#include "scheme.h"

typedef struct {
  tf_params_t p;
  tf_state_t x;
  tf_input_t u;
  scheme_step_t c;
  real noise; /* rounding of h and g [m/s] */
} step_t;

/* How large the terms are whose rounding a step has in h and g. One below the
 * smallest normal number is rounded as much as that, whatever it is. */
static void discretise(step_t *k) {
  const real at[3] = {wide(k->x.r), wide(k->x.v), wide(k->x.w)};
  k->c = scheme_step(&k->p, &k->u, at);
  const paper_t *p = &k->c.p;
  const real r = at[0], v = at[1], w = at[2], rt = k->c.r_t, m = p->m;
  const real least = TF_REAL_MIN;
  const real mu = p->mu, arm = fabsl(rt) + p->kappa;
  const real b = p->k2 * (fabsl((real)k->u.r0) + fabsl(rt)) + fabsl(p->c2 * v) +
                 fabsl(m * rt * w * w) + fabsl((real)k->u.force) + mu + least;
  const real c = fabsl((real)k->u.torque) + fabsl(p->c1 * w) +
                 fabsl(2 * m * rt * v * w) + mu * arm + fabsl(p->d) * b + least;
  const real J = paper_clock_rate(p, rt), dt = k->c.dt;
  const real turntable = fabsl((real)k->u.omega0) + dt * fabsl(k->c.alpha);
  const real z = fabsl(w) + turntable + dt * c / J + least;
  k->noise = 64 * EPSILON *
             (fabsl(v) + least + dt * b / m +
              (fabsl(p->d) + fabsl(r) + dt * fabsl(v)) * z);
}

/* An ordinary machine; with `extreme` of any size, three of its parameters from
 * anywhere in their ranges. */
static tf_params_t draw_params(int extreme) {
  tf_params_t p = tf_scenes[0]->params;
  p.dt = log_uniform(1e-4, 5e-3);
  p.theta = uniform(0.5, 1);
  p.beta = uniform(0.05, 0.5);
  p.gamma = uniform(-3.1, 3.1);
  p.mu = log_uniform(0.1, 10);
  p.kappa = log_uniform(0.03, 1);
  if (!extreme) return p;
  p.m = log_uniform(0.03, 30);
  p.d = of_any_sign(log_uniform(0.1, 3));
  p.beta = log_uniform(0.005, 5);
  p.k2 = log_uniform(0.1, 300);
  p.mu = log_uniform(0.01, 100);
  for (int n = 0; n < 3; n++) draw_member(&p, (int)(tap_bits() % 10));
  return p;
}

/* A random machine and a state whose h and g are of the size that one step
 * can change, so that every combination of modes occurs; some exactly at
 * h = g = 0, some at a zero of the Delassus scalar. */
static int draw(step_t *k, tf_machine_t *machine, int i) {
  const int extreme = i % 2;
  k->p = draw_params(extreme);
  const double r = (double)of_any_sign(log_uniform(extreme ? 1e-4 : 0.03, 1));
  const double b = k->p.beta, s = sin((double)k->p.gamma),
               c = cos((double)k->p.gamma);
  const double zero = fabs((r * r + b * b * s * s) / (r * c)); /* A = 0 */
  if (i % 10 == 0 && zero > 1e-2 && zero < 3) k->p.kappa = (tf_real_t)zero;
  if (fabs(s) < 0.1 || tf_prepare(machine, &k->p, NULL)) return 0;
  memset(&k->x, 0, sizeof k->x);
  const double step = (double)(k->p.dt * k->p.mu) / (double)k->p.m;
  const double z =
      i % 7 == 0 ? 0 : (double)of_any_sign(log_uniform(0.01, 100)) * step;
  const double h =
      i % 7 == 0 ? 0 : (double)of_any_sign(log_uniform(0.01, 10)) * step;
  k->x.r = (tf_real_t)r;
  k->x.w = (tf_real_t)((double)k->p.omega0 + z);
  k->u = tf_input_default(machine);
  k->u.force = (tf_real_t)(tap_uniform(-2, 2) * (double)k->p.mu);
  k->u.torque = (tf_real_t)(tap_uniform(-1, 1) * (double)k->p.mu);
  tf_speed_for_slip(machine, k->x.r, k->x.w, k->u.omega0, (tf_real_t)h,
                    &k->x.v);
  if (i % 3 == 0) k->u.alpha = uniform(-2, 2);
  k->u.omega0 += k->u.alpha * k->p.dt;
  k->x.mode = (uint8_t)(tap_bits() % TF_MODES);
  discretise(k);
  return 1;
}

/* (8): h and g at the end of a step, under any force. With a long d the matrix
 * in (v, w) loses digits even in long double. */
static void compare_forms(const step_t *k, const inclusion_t *in) {
  const paper_t *p = &k->c.p;
  const real gyration2 = p->beta * p->beta + k->c.r_t * k->c.r_t;
  const real lost = LDBL_EPSILON * p->d * p->d / gyration2;
  for (int n = 0; n < 4; n++) {
    const tf_real_t x = uniform(-1.4, 1.4), y = uniform(-1, 1);
    real end[3];
    scheme_end(&k->c, p->mu * x, p->kappa * p->mu * y, end);
    const scheme_slip_t want = scheme_slip(&k->c, 1, end);
    const real z = fabsl(end[2]) + fabsl(k->c.omega0);
    const real size = fabsl(end[1]) + (fabsl(p->d) + fabsl(end[0])) * z;
    const real close = k->noise + 256 * (EPSILON + lost) * size;
    if (size > 1e4L) break; /* rounding is amplified there by more than this */
    CHECK_NEAR(form_value(&in->h, x, y), want.h, close);
    CHECK_NEAR(form_value(&in->g, x, y), want.g, close);
  }
}

/* What was compared: all steps, those beside h = g = 0, those whose report has
 * another set, those pinned by one of both alone, sticks that go on, by size of
 * the set. */
typedef struct {
  int compared, near, other, pins, sticks, count[6];
} tally_t;

static void compare_step(const step_t *k, const tf_machine_t *machine,
                         tally_t *tally) {
  tf_report_t report;
  tf_state_t x = k->x;
  if (tf_step(machine, &x, &k->u, &report) < 0) return;
  tally->compared++;
  free_motion_t c =
      free_motion(machine, &k->x, &k->u, start_of(machine, &k->x, &k->u));
  inclusion_t in;
  tf_contact_modes_t solutions, is;
  bool reaches = false;
  const unsigned signs = solve_inclusion(&c, &in, &solutions);
  const unsigned got = solutions.set;
  compare_forms(k, &in);
  /* Beside h = g = 0 the report has what follows that point instead, and where
   * a slip is lost what follows at that instant. */
  const bool near =
      k->x.mode == TF_PINNED || is_near_codim2(&c, &in, signs, got);
  if (near)
    tally->near++;
  else if (report.status != TF_DEGRADED && !loses_slip(k->x.mode, report.mode))
    tally->other += report.set != got;
  tally->count[size_of(got)]++;
  /* The same by the forms alone, pinned to third order in what bends them. */
  CHECK(tf_contact_modes(&machine->contact, &in.h, &in.g, start_slip(&c),
                         k->x.mode, &is, &reaches) == TF_OK);
  const unsigned apart = is.set ^ got;
  CHECK((apart & ~(unsigned)TF_MODE_BIT(TF_PINNED)) == 0);
  tally->pins += apart != 0;
  CHECK(reaches == (near && machine->contact.stick_kappa > 0));
  const bool lost = loses_slip(k->x.mode, report.mode);
  if (near || lost || report.status != TF_OK || report.set != is.set) return;
  const unsigned mode = tf_contact_choose(&machine->contact, &is, k->x.mode,
                                          k->x.tick, k->x.seed);
  tf_force_t f;
  CHECK(report.mode == mode);
  if (tf_mode_is_slip(mode) || mode != k->x.mode) return;
  CHECK(tf_contact_force(&machine->contact, &in.h, &in.g, &is, mode,
                         start_slip(&c), &f) == TF_OK);
  CHECK(f.F == report.force.F && f.M == report.force.M);
  tally->sticks++;
}

TEST(step_has_the_modes_of_its_forms) {
  tally_t tallies[2]; /* ordinary machines, wide ones */
  memset(tallies, 0, sizeof tallies);
  for (int i = 0; i < samples(200000); i++) {
    step_t k;
    tf_machine_t machine;
    if (draw(&k, &machine, i)) compare_step(&k, &machine, &tallies[i % 2]);
  }
  for (int extreme = 0; extreme < 2; extreme++) {
    const tally_t *t = &tallies[extreme];
    CHECK(t->near > 0 && t->near < t->compared);
    CHECK(extreme || t->pins <= t->compared / 10000);
    CHECK(t->other <= (IS_DOUBLE ? 0 : t->compared / 10000));
    CHECK_ABOVE(t->compared, samples(60000));
    CHECK_ABOVE(t->sticks, samples(1000));
    CHECK_ABOVE(t->count[1], samples(1000));
    CHECK_ABOVE(t->count[3], samples(extreme ? 500 : 1000));
  }
}

/* Away from g = 0 theory counts: A > 0 one, A < 0 three within |A| dt mu. */
TEST(one_or_three_solutions) {
  for (int i = 0; i < samples(100000); i++) {
    const int s = (int)(tap_bits() & 1), kind = i % 3; /* A > 0, < 0, = 0 */
    const double A = kind == 2 ? 0 : tap_uniform(1e-3, 2);
    const double h1 = kind == 1 ? A : -A, share = tap_uniform(-1, 1);
    const inclusion_t in = {.h = {.c0 = i % 30 == 2 ? 0 : uniform(-1, 1),
                                  .cx = (tf_real_t)(h1 * (1 - share)),
                                  .cy = (tf_real_t)((s ? -1 : 1) * h1 * share)},
                            .g = {.c0 = s ? -100 : 100},
                            .g_now = s ? -100 : 100,
                            .has_moment = true};
    const double c1 =
        (double)(s ? in.h.cx - in.h.cy : in.h.cx + in.h.cy); /* as rounded */
    tf_contact_modes_t out = {0};
    CHECK(signs_of(&in.g) == (s ? 2u : 1u));
    enumerate(&in, signs_of(&in.g), &out);
    int n = 0;
    for (int mode = 0; mode < TF_MODES; mode++) n += out.set >> mode & 1;
    const int inside = fabs((double)in.h.c0) < fabs(c1);
    CHECK(n == (kind == 1 && inside ? 3 : 1));
    const unsigned stick = TF_MODE_BIT(TF_STICK_PLUS + s);
    CHECK(!(out.set & stick) == !(inside || (c1 == 0 && in.h.c0 == 0)));
    CHECK(!(out.attracting & stick) == !(c1 < 0));
    CHECK(!(out.attracting & ~stick));
    CHECK(out.near_stick == (unsigned)TF_STICK_PLUS + (unsigned)s);
    for (int slip = 0; slip < 2; slip++) {
      const double to = slip == 0 ? c1 : -c1;
      CHECK(out.tau[slip] == (s ? -1 : 1));
      CHECK_NEAR((double)out.departure[slip], (double)in.h.c0 + to,
                 4 * (double)TF_REAL_EPSILON);
    }
    if (out.set & stick)
      CHECK_NEAR((double)in.h.c0 + c1 * (double)out.x[s], 0,
                 4 * (double)TF_REAL_EPSILON);
  }
}

TEST(residual_vanishes_at_solutions_only) {
  const tf_real_t mu = 2, kappa = (tf_real_t)0.25;
  const tf_real_t eps = 8 * TF_REAL_EPSILON;
#define RESIDUAL(F, M, h, g)                                            \
  law_residual(mu, kappa, (tf_force_t){(tf_real_t)(F), (tf_real_t)(M)}, \
               (tf_real_t)(h), (tf_real_t)(g))
  CHECK(RESIDUAL(2, 0.5, 0.7, 1) == 0);    /* slip+, g > 0 */
  CHECK(RESIDUAL(-2, 0.5, -0.7, -1) == 0); /* slip-, g < 0 */
  CHECK(RESIDUAL(1, 0.25, 0, 1) == 0);     /* stick+ */
  CHECK(RESIDUAL(1, -0.25, 0, -1) == 0);   /* stick- */
  CHECK(RESIDUAL(1.5, 0.1, 0, 0) == 0);    /* pinned */
  CHECK(RESIDUAL(0, 0, 0, 0) == 0);
  CHECK_NEAR(RESIDUAL(1, 0.25, 0.1, 1), 0.1, eps);  /* drifts in stick */
  CHECK_NEAR(RESIDUAL(2, 0.5, -0.1, 1), 0.1, eps);  /* wrong side */
  CHECK_NEAR(RESIDUAL(2.5, 0.625, 0, 1), 0.5, eps); /* above mu */
  CHECK_NEAR(RESIDUAL(1, 0.25, 0, -1), 0.5, eps);   /* wrong sign of g */
  CHECK_NEAR(RESIDUAL(1, 0.5, 0, 0), 0.25, eps);    /* too much moment */
  CHECK(!(RESIDUAL(NAN, 0, 0, 1) <= 1));
#undef RESIDUAL
}
