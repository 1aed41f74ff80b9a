/* The solution set of one step against brute force. The judge builds the same
 * discrete step in long double, from the mass matrix in (v, w) and a plain
 * 2 x 2 inverse, and searches the law's graph {(lambda, s kappa lambda)} on a
 * grid for points that lie on it at the end of the step. It shares neither
 * formulas nor variables with the enumeration. */
#include <limits.h>

#include "friction/inclusion.h"
#include "tap.h"
#include "twofold.h"

typedef long double real;

typedef struct {
  tf_params_t p;
  tf_state_t x;
  tf_input_t u;
  real S[2][2], Q[2], rt, sin, cos;
} step_t;

static void discretise(step_t *k) {
  const tf_params_t *p = &k->p;
  const real m = p->m, d = p->d, q = (real)p->theta * p->dt;
  const real r = k->x.r, v = k->x.v, w = k->x.w, rt = r + q * v;
  k->rt = rt;
  k->sin = sinl(p->gamma);
  k->cos = cosl(p->gamma);
  k->Q[0] = p->k2 * (k->u.r0 - rt) - p->c2 * v + m * rt * w * w + k->u.force;
  k->Q[1] = k->u.torque - p->c1 * w - 2 * m * rt * v * w;
  k->S[0][0] = m + q * (p->c2 + q * p->k2);
  k->S[0][1] = -m * d - 2 * q * m * rt * w;
  k->S[1][0] = -m * d + 2 * q * m * rt * w;
  k->S[1][1] = m * ((real)p->beta * p->beta + rt * rt + d * d) +
               q * (p->c1 + 2 * m * rt * v);
}

/* Slip (h, g) at the end of the step under F and M; returns r at the end. */
static real end_slip(const step_t *k, real F, real M, real *h, real *g) {
  const tf_params_t *p = &k->p;
  const real b = k->Q[0] + F * k->sin;
  const real c = k->Q[1] + F * (k->rt * k->cos - p->d * k->sin) + M;
  const real det = k->S[0][0] * k->S[1][1] - k->S[0][1] * k->S[1][0];
  const real dv = p->dt * (k->S[1][1] * b - k->S[0][1] * c) / det;
  const real dw = p->dt * (k->S[0][0] * c - k->S[1][0] * b) / det;
  const real r = k->x.r + p->dt * (k->x.v + p->theta * dv);
  const real z = k->x.w + dw - k->u.omega0, e = k->x.v + dv - p->d * z;
  *h = -e * k->sin - r * z * k->cos;
  *g = -e * k->cos + r * z * k->sin;
  return r;
}

static real closest; /* smallest decisive quantity seen: a tie is no verdict */
static int positive(real x, real scale) {
  if (fabsl(x) < closest * scale) closest = fabsl(x) / scale;
  return x > 0;
}

/* Slip at lambda = side mu: walk s over [-1, 1] for s in Sgn(g+). */
static int slip_by_grid(const step_t *k, int side, real scale) {
  const real F = (real)side * k->p.mu, kappa = k->p.kappa;
  const int N = 64;
  real h, g, h_old = 0, g_old = 0;
  int found = 0;
  for (int i = 0; i <= N; i++) {
    const real s = -1 + 2.0L * i / N;
    end_slip(k, F, s * kappa * F, &h, &g);
    const int plus = positive(g, scale);
    if (i == 0 && !plus) found |= positive(side * h, scale);
    if (i == N && plus) found |= positive(side * h, scale);
    if (i > 0 && plus != (g_old > 0) && plus) { /* g = 0 in between */
      const real t = g_old / (g_old - g);
      found |= positive(side * (h_old + t * (h - h_old)), scale);
    }
    if (i > 0 && plus != (g_old > 0) && !plus) {
      const real t = g_old / (g_old - g);
      found |= positive(side * (h_old + t * (h - h_old)), scale);
    }
    h_old = h;
    g_old = g;
  }
  return found;
}

/* Stick with s: walk lambda over [-mu, mu] for a zero of h+ with s g+ > 0. */
static int stick_by_grid(const step_t *k, int s, real scale) {
  const int N = 64;
  real h, g, h_old = 0, g_old = 0;
  int found = 0;
  for (int i = 0; i <= N; i++) {
    const real F = k->p.mu * (-1 + 2.0L * i / N);
    end_slip(k, F, (real)s * k->p.kappa * F, &h, &g);
    const int plus = positive(h, i == 0 || i == N ? scale : 1e-300L);
    if (i > 0 && plus != (h_old > 0)) {
      const real t = h_old / (h_old - h);
      found |= positive(s * (g_old + t * (g - g_old)), scale);
    }
    h_old = h;
    g_old = g;
  }
  return found;
}

/* Pinned: Newton for h+ = g+ = 0 in (F, M) with difference quotients. */
static int pinned_from(const step_t *k, real F, real M) {
  const real mu = k->p.mu, kappa = k->p.kappa;
  for (int i = 0; i < 30; i++) {
    real h, g, hF, gF, hM, gM;
    end_slip(k, F, M, &h, &g);
    end_slip(k, F + mu, M, &hF, &gF);
    end_slip(k, F, M + mu, &hM, &gM);
    hF -= h, gF -= g, hM -= h, gM -= g;
    const real det = hF * gM - hM * gF;
    F -= mu * (h * gM - hM * g) / det;
    M -= mu * (hF * g - h * gF) / det;
    if (!(fabsl(F) < 1e12L && fabsl(M) < 1e12L)) return 0;
  }
  const int inside = positive(mu - fabsl(F), mu);
  return positive(kappa * fabsl(F) - fabsl(M), mu * kappa) && inside;
}

static int pinned_by_newton(const step_t *k) {
  const real F = k->p.mu, M = k->p.kappa * F;
  return pinned_from(k, 0, 0) || pinned_from(k, F, M) ||
         pinned_from(k, F, -M) || pinned_from(k, -F, M) ||
         pinned_from(k, -F, -M);
}

static unsigned set_by_search(const step_t *k, real scale) {
  unsigned set = 0;
  if (slip_by_grid(k, 1, scale)) set |= TF_MODE_BIT(TF_SLIP_PLUS);
  if (slip_by_grid(k, -1, scale)) set |= TF_MODE_BIT(TF_SLIP_MINUS);
  if (stick_by_grid(k, 1, scale)) set |= TF_MODE_BIT(TF_STICK_PLUS);
  if (stick_by_grid(k, -1, scale)) set |= TF_MODE_BIT(TF_STICK_MINUS);
  if (pinned_by_newton(k)) set |= TF_MODE_BIT(TF_PINNED);
  return set;
}

static double signed_log(double lo, double hi) {
  const double x = exp(tap_uniform(log(lo), log(hi)));
  return tap_bits() & 1 ? x : -x;
}

/* A random machine and a state whose h and g are of the size that one step
 * can change, so that every combination of modes occurs; some exactly at
 * h = g = 0, some at a zero of the Delassus scalar. */
static int draw(step_t *k, tf_machine_t *machine, int i) {
  k->p = tf_scenes[0]->params;
  k->p.dt = (tf_real_t)exp(tap_uniform(log(1e-4), log(5e-3)));
  k->p.theta = (tf_real_t)tap_uniform(0.5, 1);
  k->p.beta = (tf_real_t)tap_uniform(0.05, 0.5);
  k->p.gamma = (tf_real_t)tap_uniform(-3.1, 3.1);
  k->p.mu = (tf_real_t)exp(tap_uniform(log(0.1), log(10)));
  const double r = signed_log(0.03, 1);
  const double b = k->p.beta, s = sin((double)k->p.gamma),
               c = cos((double)k->p.gamma);
  k->p.kappa = (tf_real_t)exp(tap_uniform(log(0.03), log(1)));
  const double zero = fabs((r * r + b * b * s * s) / (r * c)); /* A = 0 */
  if (i % 10 == 0 && zero > 1e-2 && zero < 3) k->p.kappa = (tf_real_t)zero;
  if (fabs(s) < 0.1 || tf_prepare(machine, &k->p, NULL)) return 0;
  memset(&k->x, 0, sizeof k->x);
  const double step = (double)(k->p.dt * k->p.mu) / (double)k->p.m;
  const double z = i % 7 == 0 ? 0 : signed_log(0.01, 100) * step;
  const double h = i % 7 == 0 ? 0 : signed_log(0.01, 10) * step;
  k->x.r = (tf_real_t)r;
  k->x.w = (tf_real_t)((double)k->p.omega0 + z);
  k->u = tf_input_default(machine);
  k->u.force = (tf_real_t)(tap_uniform(-2, 2) * (double)k->p.mu);
  k->u.torque = (tf_real_t)(tap_uniform(-1, 1) * (double)k->p.mu);
  tf_speed_for_slip(machine, k->x.r, k->x.w, k->u.omega0, (tf_real_t)h,
                    &k->x.v);
  k->x.mode = (uint8_t)(tap_bits() % TF_MODES);
  discretise(k);
  return 1;
}

TEST(enumeration_against_grid_search) {
  int compared = 0, ties = 0, different = 0, met = 0;
  int seen[32] = {0}, count[6] = {0};
  const real tie = sizeof(tf_real_t) == 8 ? 1e-9L : 3e-3L;
  for (int i = 0; compared < 100000 && i < 200000; i++) {
    step_t k;
    tf_machine_t machine;
    tf_report_t report;
    if (!draw(&k, &machine, i)) continue;
    const real scale = (real)k.p.dt * k.p.mu / k.p.m;
    closest = 1;
    const unsigned want = set_by_search(&k, scale);
    tf_state_t x = k.x;
    if (!CHECK(tf_step(&machine, &x, &k.u, &report) >= 0)) return;
    if (closest < tie) {
      ties++;
      continue;
    }
    compared++;
    seen[want]++;
    unsigned got = report.set;
    /* A step that meets h = g = 0 ends there by a mean force, not by the law:
     * no solution of it, and its residual says so. */
    if (report.mode == TF_PINNED && !(want & TF_MODE_BIT(TF_PINNED))) {
      met += report.residual > 0;
      got &= ~TF_MODE_BIT(TF_PINNED);
      report.choices--;
    }
    count[report.choices]++;
    different += got != want;
    if (got != want && different < 4)
      printf("# draw %d: set %02x, search finds %02x\n", i, got, want);
  }
  int kinds = 0;
  for (int i = 0; i < 32; i++) kinds += seen[i] > 0;
  printf(
      "# %d steps compared, %d ties left out, %d kinds of solution set; "
      "1: %d, 2: %d, 3: %d, none: %d\n",
      compared, ties, kinds, count[1], count[2], count[3], count[0]);
  printf("# %d of them end at h = g = 0, which they met\n", met);
  CHECK(different == 0);
  CHECK(met > 0 && met < compared / 100);
  CHECK(compared == 100000);
  CHECK(ties < compared / 5);
  CHECK(kinds >= 10);
  CHECK(count[1] > 1000 && count[3] > 1000);
}

/* Away from g = 0 theory counts: A > 0 one, A < 0 three within |A| dt mu. */
TEST(one_or_three_solutions) {
  for (int i = 0; i < 100000; i++) {
    const int s = (int)(tap_bits() & 1), kind = i % 3; /* A > 0, < 0, = 0 */
    const double A = kind == 2 ? 0 : tap_uniform(1e-3, 2);
    const double h1 = kind == 1 ? A : -A, share = tap_uniform(-1, 1);
    const inclusion_t in = {
        .h = {.c0 = i % 30 == 2 ? 0 : (tf_real_t)tap_uniform(-1, 1),
              .cx = (tf_real_t)(h1 * (1 - share)),
              .cy = (tf_real_t)((s ? -1 : 1) * h1 * share)},
        .g = {.c0 = s ? -100 : 100},
        .g_now = s ? -100 : 100,
        .has_moment = true};
    const double c1 =
        (double)(s ? in.h.cx - in.h.cy : in.h.cx + in.h.cy); /* as rounded */
    solutions_t out = {0};
    CHECK(signs_of(&in.g) == (s ? 2u : 1u));
    enumerate(&in, signs_of(&in.g), &out);
    int n = 0;
    for (int mode = 0; mode < TF_MODES; mode++) n += out.set >> mode & 1;
    const int inside = fabs((double)in.h.c0) < fabs(c1);
    CHECK(n == (kind == 1 && inside ? 3 : 1));
    const unsigned stick = TF_MODE_BIT(TF_STICK_PLUS + s);
    CHECK(!(out.set & stick) == !(inside || (c1 == 0 && in.h.c0 == 0)));
    CHECK(!(out.attracting & stick) == !(c1 < 0));
    if (out.set & stick)
      CHECK_NEAR((double)in.h.c0 + c1 * (double)out.x[s], 0,
                 4 * (double)TF_REAL_EPSILON);
  }
}

TEST(stick_solves_the_quadratic) {
  for (int i = 0; i < 20000; i++) {
    const inclusion_t in = {.h = {.c0 = (tf_real_t)tap_uniform(-0.5, 0.5),
                                  .cx = tap_bits() & 1 ? 1 : -1,
                                  .cxx = (tf_real_t)signed_log(1e-12, 0.3)},
                            .g = {.c0 = 9},
                            .g_now = 9};
    solutions_t out = {0};
    enumerate(&in, signs_of(&in.g), &out);
    if (!(out.set & TF_MODE_BIT(TF_STICK_PLUS))) continue;
    const real x = out.x[0];
    CHECK(fabsl(x) <= 1);
    CHECK_NEAR((in.h.cxx * x + in.h.cx) * x + in.h.c0, 0,
               8 * (real)TF_REAL_EPSILON);
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

TEST(mode_names_are_the_contract) {
  const char *const name[] = {"slip+", "slip-", "stick+", "stick-", "pinned"};
  const unsigned mode[] = {TF_SLIP_PLUS, TF_SLIP_MINUS, TF_STICK_PLUS,
                           TF_STICK_MINUS, TF_PINNED};
  for (unsigned i = 0; i < TF_MODES; i++) {
    CHECK(!strcmp(tf_mode_name(mode[i]), name[i]));
    CHECK(mode[i] == i && TF_MODE_BIT(i) == 1u << i);
  }
  CHECK(!strcmp(tf_mode_name(TF_NO_MODE), "unknown mode"));
  CHECK(!strcmp(tf_mode_name(UINT_MAX), "unknown mode"));
}

int main(int argc, char **argv) {
  tap_begin(argc, argv);
  RUN(enumeration_against_grid_search);
  RUN(one_or_three_solutions);
  RUN(stick_solves_the_quadratic);
  RUN(residual_vanishes_at_solutions_only);
  RUN(mode_names_are_the_contract);
  return tap_end();
}
