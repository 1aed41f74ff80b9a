/* What the paper says in words and no other test has: each statement as a law,
 * in the paper's own formulas, and where it speaks of a motion in the core's.
 * What does not hold as it is said is noted in docs/PAPER.md. */
#include "common.h"

static real any(double low, double high) {
  return (real)tap_uniform(low, high);
}

/* Places a two-fold of both tangencies invisible at random; 0 where (singKappa)
 * and (singK2) have no machine for it. */
static int placed(paper_t *p, real x[3], paper_twofold_t *n) {
  paper_default(p);
  p->gamma = any(-3.1, -1.8);
  x[0] = any(0.05, 0.6);
  x[2] = any(-2, -1.005);
  x[1] = paper_sing_v(p, x[0], x[2]);
  p->kappa = paper_sing_kappa(p, x[0]);
  p->k2 = paper_sing_k2(p, x[0], x[2]);
  if (p->kappa <= 0 || p->k2 <= 0 || paper_g(p, x) <= 0) return 0;
  paper_twofold(p, x, 1, n);
  return n->Kpp < 0 && n->Kmm > 0;
}

/* "Has magnitude mu": at the edge of stick; the law reaches 4 mu/3 at g = 0.
 * The moment has the factor mu already, and never exceeds kappa mu. */
TEST(slip_force_is_between_mu_and_four_thirds_of_it) {
  paper_t p;
  paper_default(&p);
  real F, M;
  for (int i = 0; i < 2000; i++) {
    p.mu = any(0.1, 3);
    p.kappa = any(0.01, 2);
    paper_friction(&p, any(-1, 1), any(-1, 1), &F, &M);
    CHECK(fabsl(F) >= p.mu * (1 - 1e-15L));
    CHECK(fabsl(F) <= p.mu * (4 / 3.0L + 1e-15L));
    CHECK(fabsl(M) <= p.mu * p.kappa * (1 + 1e-15L));
    paper_friction(&p, 1e-3L, 0, &F, &M);
    CHECK_NEAR(F, 4 * p.mu / 3, 1e-17L);
    paper_friction(&p, 1e-25L, 1, &F, &M);
    CHECK_NEAR(F, p.mu, 1e-17L);
    CHECK_NEAR(M, p.mu * p.kappa, 1e-17L);
  }
}

/* At a two-fold stick has any lambda, and the two slips are independent. */
TEST(any_force_balances_its_moment_at_a_two_fold) {
  int seen = 0;
  for (int i = 0; i < 2000; i++) {
    paper_t p;
    paper_twofold_t n;
    real x[3], up[3], down[3], size = 0;
    if (!placed(&p, x, &n)) continue;
    for (int j = 0; j < 5; j++)
      CHECK_NEAR(paper_lie(&p, x, any(-10, 10), 1), 0, 1e-16L);
    paper_f(&p, x, p.mu, 1, up);
    paper_f(&p, x, -p.mu, 1, down);
    for (int j = 0; j < 3; j++) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      const real part = up[k] * down[l] - up[l] * down[k];
      size += part * part;
    }
    CHECK(sqrtl(size) > 1e-8L);
    seen++;
  }
  CHECK(seen > 100);
}

/* The matrix of (SlidNormForm): real eigenvalues at least 2 apart, so of the
 * same magnitude only with J1 + J2 = 0, and one is 0 only with J1 J2 = 1. In
 * case 1 the first is the weak one. */
TEST(eigenvalues_of_the_normal_form_are_apart) {
  int first = 0;
  for (int i = 0; i < 2000; i++) {
    paper_t p;
    paper_twofold_t n;
    real x[3];
    if (!placed(&p, x, &n)) continue;
    const real close = 1e-15L * (1 + n.eigen[1] * n.eigen[1]);
    CHECK(n.eigen[0] - n.eigen[1] >= 2);
    CHECK_NEAR(n.eigen[0] + n.eigen[1], n.J1 + n.J2, close);
    CHECK_NEAR(n.eigen[0] * n.eigen[1], n.J1 * n.J2 - 1, close);
    if (n.J1 >= 0 || n.J2 >= 0 || n.J1 * n.J2 <= 1) continue;
    CHECK(n.eigen[1] < n.eigen[0] && n.eigen[0] < 0);
    first++;
  }
  CHECK(first > 100);
}

/* "If J1 J2 - 1 > 0 then the sliding region is simply xi, eta > 0, and xi, eta
 * < 0 otherwise"; escaping is opposite. */
TEST(sliding_quadrant_has_the_sign_of_j1_j2_less_one) {
  int seen[2] = {0};
  for (int i = 0; i < 4000; i++) {
    paper_t p;
    paper_twofold_t n;
    real x[3], size = 0;
    if (!placed(&p, x, &n)) continue;
    if (fabsl(n.J1 * n.J2 - 1) < 0.05L) continue;
    const int sign = n.J1 * n.J2 > 1 ? 1 : -1;
    for (int j = 0; j < 3; j++) size += fabsl(n.plus[j]) + fabsl(n.minus[j]);
    for (int side = -1; side <= 1; side += 2) {
      const real xi = any(0.2, 1) * 1e-8L / size * (real)(side * sign);
      const real eta = any(0.2, 1) * 1e-8L / size * (real)(side * sign);
      real y[3];
      for (int j = 0; j < 3; j++)
        y[j] = x[j] + xi * n.plus[j] + eta * n.minus[j];
      CHECK(paper_lie(&p, y, p.mu, 1) * (real)side < 0);
      CHECK(paper_lie(&p, y, -p.mu, 1) * (real)side > 0);
    }
    seen[sign > 0]++;
  }
  CHECK(seen[0] > 20 && seen[1] > 100);
}

/* A times (svf) in (r, w), which is regular at the two-fold; A itself. */
static real scaled(const paper_t *p, const real y[2], real to[2]) {
  const real A = paper_delassus(p, y[0], 1);
  const real x[3] = {y[0], paper_v_at(p, y[0], y[1], 0), y[1]};
  real f[3];
  paper_stick(p, x, 1, f);
  to[0] = A * f[0];
  to[1] = A * f[2];
  return A;
}

/* Whether y on h = 0 is in the sliding region at g > 0. */
static int slides(const paper_t *p, const real y[2]) {
  const real x[3] = {y[0], paper_v_at(p, y[0], y[1], 0), y[1]};
  return paper_g(p, x) > 0 && paper_delassus(p, y[0], 1) > 0 &&
         fabsl(paper_lambda(p, x, 1)) < p->mu;
}

/* Follows stick by Runge and Kutta until A < 1e-4, less than 1 ms before the
 * two-fold; its time, or -1 where it leaves the sliding region before. */
static real time_to_the_two_fold(const paper_t *p, real y[2]) {
  const real step = 0.05L;
  real t = 0;
  for (int i = 0; i < 4000; i++) {
    real f[4][2], z[2], A[4];
    A[0] = scaled(p, y, f[0]);
    if (A[0] < 1e-4L) return t;
    for (int j = 1; j < 4; j++) {
      const real part = j == 3 ? step : step / 2;
      for (int k = 0; k < 2; k++) z[k] = y[k] + part * f[j - 1][k];
      A[j] = scaled(p, z, f[j]);
    }
    for (int k = 0; k < 2; k++)
      y[k] += step / 6 * (f[0][k] + 2 * f[1][k] + 2 * f[2][k] + f[3][k]);
    t += step / 6 * (A[0] + 2 * A[1] + 2 * A[2] + A[3]);
    if (!slides(p, y)) return -1;
  }
  return -1;
}

/* "Whole sets of solutions evolve into the singularity", along the weak
 * eigenvector, and in finite time: from all of the lower sliding region up to r
 * = 0.22 m, 1.3 rad/s deep; farther down stick may leave it to slip. */
TEST(sliding_region_flows_into_the_two_fold_in_finite_time) {
  paper_t p;
  paper_twofold_t n;
  paper_default(&p);
  const real x[3] = {PAPER_R_STAR, paper_sing_v(&p, PAPER_R_STAR, PAPER_W_STAR),
                     PAPER_W_STAR};
  paper_twofold(&p, x, 1, &n);
  const real slope = n.weak[2] / n.weak[0];
  int seen = 0;
  real longest = 0, deepest = 0;
  for (int i = 0; i < 200; i++) {
    real y[2] = {any(0.186, 0.22), any(-1.3, -1.001)};
    if (!slides(&p, y)) continue;
    if (y[1] < deepest) deepest = y[1];
    const real t = time_to_the_two_fold(&p, y);
    CHECK(t > 0 && t < 0.5L);
    CHECK_NEAR(y[0], x[0], 3e-5L);
    CHECK_NEAR(y[1] - x[2], slope * (y[0] - x[0]), 1e-6L);
    longest = fmaxl(longest, t);
    seen++;
  }
  printf("# %d starts, down to %.3Lf rad/s, at most %.3Lf s\n", seen, deepest,
         longest);
  CHECK(seen > 50);
}

/* "After leaving the escaping region trajectories go into an outward spiraling
 * motion": the |h| that each slip+ reaches grows until the windings end, at g <
 * 0, the side of the other sliding region. */
TEST(windings_grow_until_the_other_sliding_side) {
  if (!IS_DOUBLE) SKIP("the first windings are below the rounding of float");
  const tf_machine_t machine = prepared(&tf_scenes[0]->params);
  const tf_input_t input = tf_input_default(&machine);
  for (int i = 0; i < 6; i++) {
    const int place = i / 2;
    const tf_real_t from = TF_R(0.1858) - TF_R(0.0001) * (tf_real_t)place;
    const tf_real_t slip = i % 2 ? TF_R(-1e-9) : TF_R(1e-9);
    tf_state_t x = {.r = from,
                    .w = TF_R(-1.037) -
                         TF_R(10.2442529) * (from - (tf_real_t)PAPER_R_STAR)};
    tf_report_t report;
    tf_real_t peak = 0, before = 0;
    int windings = 0;
    CHECK(tf_begin_with_slip(&machine, &x, &input, slip, &report) == TF_OK);
    CHECK(report.mode == (i % 2 ? TF_SLIP_MINUS : TF_SLIP_PLUS));
    for (int k = 0; k < 5000 && tf_mode_is_slip(report.mode); k++) {
      if (report.mode == TF_SLIP_PLUS && report.slip.h > peak)
        peak = report.slip.h;
      const unsigned was = report.mode;
      CHECK(tf_step_located(&machine, &x, &input, &report) >= 0);
      if (was != TF_SLIP_PLUS || report.mode == TF_SLIP_PLUS) continue;
      CHECK(peak > before);
      before = peak;
      peak = 0;
      windings++;
    }
    printf("# %d windings, the last of %.3g m/s\n", windings, (double)before);
    CHECK(windings >= 4 && !tf_mode_is_slip(report.mode));
    CHECK(report.slip.g <= 0);
  }
}

/* gamma = 0: h = r (w0 - w), so the wheel has no lateral slip at r = 0 or where
 * the discs turn alike, and nowhere else; with v = 0 it rolls on at r = 0. */
TEST(gamma_zero_rolls_on_the_circle) {
  paper_t p;
  paper_default(&p);
  p.gamma = 0;
  for (int i = 0; i < 200; i++) {
    real x[3] = {any(-1, 1), any(-1, 1), any(-3, 3)};
    CHECK_NEAR(paper_h(&p, x), x[0] * (p.omega0 - x[2]), 1e-18L);
    x[0] = 0;
    CHECK(paper_h(&p, x) == 0);
    x[0] = 0.3L;
    x[2] = p.omega0;
    CHECK(paper_h(&p, x) == 0);
  }
  tf_params_t params = tf_scenes[0]->params;
  params.gamma = 0;
  const tf_machine_t machine = prepared(&params);
  const tf_input_t input = tf_input_default(&machine);
  tf_state_t x = {.w = TF_R(-1.2)};
  tf_report_t report;
  CHECK(tf_begin(&machine, &x, &input, &report) == TF_OK);
  for (int i = 0; i < 1000; i++) {
    CHECK(tf_step(&machine, &x, &input, &report) == TF_OK);
    CHECK(report.mode == TF_STICK_MINUS);
    CHECK(fabsl(wide(x.r)) < EPSILON && fabsl(wide(x.v)) < 64 * EPSILON);
  }
  x = (tf_state_t){.v = TF_R(0.1), .w = TF_R(-1.2)};
  CHECK(tf_begin(&machine, &x, &input, &report) >= TF_OK);
  for (int i = 0; i < 10; i++)
    CHECK(tf_step(&machine, &x, &input, &report) >= TF_OK);
  CHECK(fabsl(wide(x.r)) > 1e-5L);
}

/* gamma = pi/2: stick is v = d (w - w0), and lasts while the spring, damper and
 * centrifugal force on the slider are within mu: its borders are 2 mu of that
 * force apart, in r 2 mu / |k2 - m w^2|, and stick attracts between them. */
TEST(gamma_right_borders_are_two_mu_apart) {
  paper_t p;
  paper_default(&p);
  p.gamma = PAPER_PI / 2;
  for (int i = 0; i < 500; i++) {
    p.mu = any(0.1, 2);
    p.k2 = any(2, 5);
    p.c2 = any(0, 0.5);
    real x[3] = {any(-1, 1), any(-1, 1), any(-1, 1)}, border[2];
    CHECK_NEAR(paper_h(&p, x), p.d * (x[2] - p.omega0) - x[1], 1e-18L);
    x[1] = p.d * (x[2] - p.omega0);
    const real stiff = p.k2 - p.m * x[2] * x[2];
    for (int side = 0; side < 2; side++) {
      const real mu = side ? p.mu : -p.mu;
      border[side] = (p.k2 * p.r0 - p.c2 * x[1] + mu) / stiff;
      x[0] = border[side];
      CHECK_NEAR(paper_p1(&p, x), -mu, 1e-17L);
      CHECK_NEAR(paper_lie(&p, x, mu, 1), 0, 1e-16L * (1 + x[0] * x[0]));
    }
    CHECK_NEAR(border[1] - border[0], 2 * p.mu / fabsl(stiff), 1e-17L);
    x[0] = border[0] + any(0.01, 0.99) * (border[1] - border[0]);
    CHECK(fabsl(paper_lambda(&p, x, 1)) < p.mu);
    CHECK_NEAR(paper_delassus(&p, x[0], 1), 1 / p.m, 1e-16L);
  }
}

/* Appendix B: with sigma = 0, rho = 2/3, delta = 1 / (3 kappa), a = 3 kappa the
 * slip begins (x_s = -a) at F = 1, M = kappa, whatever k is. */
TEST(string_begins_to_slip_at_force_one) {
  for (int i = 0; i < 200; i++) {
    const real kappa = any(0.1, 1), k = any(0.3, 10);
    const paper_string_t q = {k, 1 / (3 * kappa), 0, 2 / 3.0L, 3 * kappa};
    const real edge = atanl(1 / (18 * k * kappa * kappa));
    for (int side = -1; side <= 1; side += 2) {
      real F, M;
      const int zone =
          paper_string(&q, edge * (1 + 1e-13L * (real)side), &F, &M);
      CHECK(zone == (side < 0 ? 1 : 2));
      CHECK_NEAR(F, 1, 1e-10L);
      CHECK_NEAR(M, kappa, 1e-10L);
    }
  }
}

/* (force) and (moment) are the string of Appendix B past its no-slip range,
 * with sigma = 0, rho = 2/3, a = 3 kappa, k = delta = 1 / (3 kappa), at psi. */
TEST(tyre_law_is_the_reduced_string) {
  paper_t p;
  paper_default(&p);
  const real edge = atanl(1 / (6 * p.kappa));
  const real stiff = 1 / (3 * p.kappa);
  const paper_string_t q = {stiff, stiff, 0, 2 / 3.0L, 3 * p.kappa};
  for (int i = 1; i < 100; i++) {
    const real slip = PAPER_PI / 2 * (real)i / 100;
    const real psi = edge + (1 - 2 / PAPER_PI * edge) * slip;
    real F, M, F_string, M_string;
    paper_friction(&p, sinl(slip), cosl(slip), &F, &M);
    CHECK(paper_string(&q, psi, &F_string, &M_string) == 2);
    CHECK_NEAR(F, p.mu * F_string, 1e-17L);
    CHECK_NEAR(M, p.mu * M_string, 1e-17L);
  }
}
