/* test_errata.c - where this project departs from the printed paper, one test
 * a misprint. Each shows two things: that the corrected form follows from
 * something the misprint cannot touch (virtual power on the moving wheel, an
 * energy balance, quadrature of the pressure, the sliding field itself), and
 * that the form as printed does not. Without the second half a test could
 * pass for both and would mean nothing. */
#include "common.h"

static real any(double lo, double hi) { return (real)tap_uniform(lo, hi); }

static void any_state(real x[3]) {
  x[0] = any(0.05, 0.5);
  x[1] = any(-1, 1);
  x[2] = any(-1.8, 1.8);
}

/* A vector in the frame of the slot: along it (r) and across it (phi). */
typedef struct {
  real r, phi;
} vector_t;

static real dot(vector_t a, vector_t b) { return a.r * b.r + a.phi * b.phi; }

/* The slider is at (r, d). How it moves when r changes by dr and the disc turns
 * by dphi. */
static vector_t moved(const paper_t *p, real r, real dr, real dphi) {
  return (vector_t){dr - p->d * dphi, r * dphi};
}

/* The wheel's two directions: across (h) and along (g). */
static vector_t across(const paper_t *p) {
  return (vector_t){-sinl(p->gamma), -cosl(p->gamma)};
}
static vector_t along(const paper_t *p) {
  return (vector_t){-cosl(p->gamma), sinl(p->gamma)};
}

/* Virtual power: for each of dr, dphi the power of inertia, with centrifugal
 * and Coriolis terms, less that of the spring, dampers, friction -F across the
 * wheel and moment M. Zero in both for the true accelerations; returns the
 * larger. */
static real imbalance(const paper_t *p, const real x[3], const real accel[2],
                      real F, real M) {
  const real r = x[0], v = x[1], w = x[2], theta = p->beta * p->beta * p->m;
  const vector_t rate = moved(p, r, accel[0], accel[1]), wheel = across(p);
  const vector_t force = {
      p->m * (rate.r - r * w * w) + F * wheel.r,
      p->m * (rate.phi + 2 * v * w - p->d * w * w) + F * wheel.phi};
  const real by_r =
      dot(force, moved(p, r, 1, 0)) + p->k2 * (r - p->r0) + p->c2 * v;
  const real by_phi =
      dot(force, moved(p, r, 0, 1)) + theta * accel[1] + p->c1 * w - M;
  return fmaxl(fabsl(by_r), fabsl(by_phi));
}

/* (h), (g) are the velocity of the wheel over the turning disc, across and
 * along. Everything below that speaks of friction rests on this. */
TEST(h_and_g_are_the_slip_of_the_wheel) {
  paper_t p = paper_default();
  for (int i = 0; i < 100; i++) {
    real x[3];
    any_state(x);
    p.gamma = any(-3, 3);
    const vector_t u = moved(&p, x[0], x[1], x[2]);
    const vector_t disc = moved(&p, x[0], 0, p.omega0);
    const vector_t slip = {u.r - disc.r, u.phi - disc.phi};
    CHECK_NEAR(paper_h(&p, x), dot(slip, across(&p)), 1e-18L);
    CHECK_NEAR(paper_g(&p, x), dot(slip, along(&p)), 1e-18L);
  }
}

/* (ds1)-(ds3): the dot is d/dtau, dt = m (beta^2 + r^2) dtau. */
TEST(erratum_rescaled_time) {
  paper_t p = paper_default();
  for (int i = 0; i < 100; i++) {
    const real F = any(0.2, 1), M = any(-1, 1);
    real x[3], tau[3];
    any_state(x);
    const real rate = p.m * (p.beta * p.beta + x[0] * x[0]);
    paper_rhs(&p, x, F, M, tau);
    const real in_tau[2] = {tau[1], tau[2]};
    const real in_t[2] = {tau[1] / rate, tau[2] / rate};
    CHECK_NEAR(imbalance(&p, x, in_t, F, M), 0, 1e-16L);
    CHECK_NEAR(tau[0] / rate, x[1], 1e-18L);
    CHECK(imbalance(&p, x, in_tau, F, M) > 1e-4L);
    CHECK(fabsl(tau[0] - x[1]) > 0.5L * fabsl(x[1])); /* v is dr/dt */
  }
}

/* (eom1)-(eom3) with friction `across` the slit and `along` it, solved for
 * (r'', phi''): R1 from (eom1), then phi'' from (eom3), r'' from (eom2). */
static void free_body(const paper_t *p, const real x[3], real across,
                      real along, real M, real accel[2]) {
  const real r = x[0], v = x[1], w = x[2], m = p->m;
  const real theta = p->beta * p->beta * m;
  const real R2 = -p->k2 * (r - p->r0) - p->c2 * v;
  const real R1_rest = m * (p->d * w * w - 2 * v * w) - across;
  accel[1] = (-p->c1 * w + p->d * R2 + r * R1_rest + M) / (theta + m * r * r);
  accel[0] = (R2 + along) / m + p->d * accel[1] + r * w * w;
}

/* (eom1) R1 - F cos(gamma), (eom2) R2 + F sin(gamma). */
TEST(erratum_eom_signs) {
  paper_t p = paper_default();
  for (int i = 0; i < 100; i++) {
    const real F = any(0.2, 1), M = any(-1, 1);
    const real cg = cosl(p.gamma), sg = sinl(p.gamma);
    real x[3], dx[3], right[2], printed[2];
    any_state(x);
    free_body(&p, x, -F * cg, F * sg, M, right);
    free_body(&p, x, F * cg, -F * cg, M, printed);
    paper_rhs_time(&p, x, F, M, dx);
    CHECK_NEAR(imbalance(&p, x, right, F, M), 0, 1e-16L);
    CHECK_NEAR(right[0], dx[1], 1e-15L * (1 + fabsl(dx[1])));
    CHECK_NEAR(right[1], dx[2], 1e-15L * (1 + fabsl(dx[2])));
    CHECK(imbalance(&p, x, printed, F, M) > 0.01L);
    CHECK(fabsl(printed[0] - dx[1]) + fabsl(printed[1] - dx[2]) > 0.01L);
  }
}

static real energy(const paper_t *p, const real x[3]) {
  const ref_machine_t q = {PARAMETERS_OF(real, p)};
  return ref_energy(&q, x[0], x[1] - p->d * x[2], x[2], x[0] - p->r0);
}

/* Text: c1 acts between the discs. Equations: against the ground. With no
 * other loss, dE/dt is -c1 w^2 and not -c1 (w - w0) w. */
TEST(erratum_c1_damps_against_the_ground) {
  paper_t p = paper_default();
  p.c1 = 0.1L;
  p.c2 = 0;
  for (int i = 0; i < 100; i++) {
    real x[3], dx[3], gain = 0;
    any_state(x);
    x[2] = any(0.2, 1.8);
    paper_rhs_time(&p, x, 0, 0, dx);
    for (int j = -2; j <= 2; j++) { /* of degree 4 along a line: exact */
      const real step = 1e-4L * (real)j;
      real y[3];
      for (int k = 0; k < 3; k++) y[k] = x[k] + step * dx[k];
      if (j) gain += (j * j == 1 ? 4 : -1) * energy(&p, y) / (6 * step);
    }
    CHECK_NEAR(gain, -p.c1 * x[2] * x[2], 1e-10L);
    CHECK(fabsl(gain + p.c1 * (x[2] - p.omega0) * x[2]) > 0.01L);
  }
}

/* Stick ties M = sign(g) kappa F: the limit of the slip law at h = 0. */
TEST(erratum_stick_moment_has_the_sign_of_g) {
  paper_t p = paper_default();
  for (int i = 0; i < 100; i++) {
    const real size = any(0.01, 1), side = i % 2 ? 1 : -1;
    const real roll = i % 4 < 2 ? 1 : -1;
    real F, M;
    paper_friction(&p, side * 1e-17L, roll * size, &F, &M);
    CHECK_NEAR(F, side * p.mu, 1e-13L);
    CHECK_NEAR(M, roll * p.kappa * F, 1e-13L);
    if (roll > 0)
      CHECK_NEAR(M, p.kappa * F, 1e-13L); /* the text */
    else
      CHECK(fabsl(M - p.kappa * F) > 0.5L);
  }
}

/* (singK2) writes p2(r, v, w), which claims that the factor of F in (ds2)
 * follows v and w: it does not. The formula, so read, makes (r, w) a
 * two-fold. */
TEST(erratum_p2_depends_on_r_alone) {
  for (int i = 0; i < 100; i++) {
    real x[3], y[3], on[3], off[3];
    paper_t p = paper_default();
    any_state(x);
    any_state(y);
    y[0] = x[0];
    paper_rhs(&p, x, 1, 0, on);
    paper_rhs(&p, x, 0, 0, off);
    const real factor = on[1] - off[1];
    paper_rhs(&p, y, 1, 0, on);
    paper_rhs(&p, y, 0, 0, off);
    CHECK_NEAR(factor, paper_p2(&p, x[0]), 1e-17L);
    CHECK_NEAR(factor, on[1] - off[1], 1e-17L); /* other v, other w */
    y[0] = any(0.12, 0.5);
    y[2] = any(-1.5, -0.5);
    p.kappa = paper_sing_kappa(&p, y[0]);
    p.k2 = paper_sing_k2(&p, y[0], y[2]);
    y[1] = paper_sing_v(&p, y[0], y[2]);
    CHECK_NEAR(paper_h(&p, y), 0, 1e-18L);
    CHECK_NEAR(paper_lie(&p, y, p.mu, 1), 0, 1e-16L);
    CHECK_NEAR(paper_lie(&p, y, -p.mu, 1), 0, 1e-16L);
  }
}

/* The sine of the angle between (svf) at x* + xi v+ + eta v- and the field of
 * (SlidNormForm), xi_bar = scale xi, eta_bar = eta; 2 if they are opposed. */
static real normal_form_miss(const paper_t *p, const real at[3],
                             const paper_twofold_t *n, real xi, real eta,
                             real scale) {
  const real *a = n->plus, *b = n->minus;
  const real area = a[0] * b[2] - a[2] * b[0], step = 1e-2L;
  const real form[2] = {(n->J1 * scale * xi + eta) / scale,
                        scale * xi + n->J2 * eta};
  real x[3], dx[3], field[2], size;
  for (int k = 0; k < 3; k++) x[k] = at[k] + step * (xi * a[k] + eta * b[k]);
  x[1] = paper_v_at(p, x[0], x[2], 0);
  paper_stick(p, x, 1, dx);
  CHECK(fabsl(paper_lambda(p, x, 1)) < p->mu); /* (SlidCond) */
  field[0] = (dx[0] * b[2] - dx[2] * b[0]) / area;
  field[1] = (a[0] * dx[2] - a[2] * dx[0]) / area;
  size = hypotl(field[0], field[1]) * hypotl(form[0], form[1]);
  if (field[0] * form[0] + field[1] * form[1] < 0) return 2;
  return fabsl(field[0] * form[1] - field[1] * form[0]) / size;
}

/* xi_bar / eta_bar = sqrt(-K++/K--) xi / eta. Scaling both alike leaves the
 * ratio; scaling eta by that root instead of xi is not it either. */
TEST(erratum_normal_form_scales_the_ratio) {
  const paper_t p = paper_default();
  paper_twofold_t n;
  const real v = paper_sing_v(&p, PAPER_R_STAR, PAPER_W_STAR);
  const real at[3] = {PAPER_R_STAR, v, PAPER_W_STAR};
  paper_twofold(&p, at, 1, &n);
  const real root = sqrtl(-n.Kpp / n.Kmm);
  for (int i = 0; i < 100; i++) {
    const real xi = any(0.1, 1), eta = any(0.1, 1);
    CHECK(normal_form_miss(&p, at, &n, xi, eta, root) < 1e-4L);
    CHECK(normal_form_miss(&p, at, &n, xi, eta, 1) > 0.02L);
    CHECK(normal_form_miss(&p, at, &n, xi, eta, 1 / root) > 0.04L);
  }
}

/* Case 3, eigenvalues of opposite sign, is J1 J2 < 1; never J1 J2 > 1. The
 * eigenvalues are those of [[J1, 1], [1, J2]], put back into it. */
TEST(erratum_case_three_is_below_one) {
  int below = 0, above = 0;
  for (int i = 0; i < 400; i++) {
    const real J1 = any(-3, 3), J2 = any(-3, 3);
    const real gap = sqrtl((J1 - J2) * (J1 - J2) + 4);
    const real up = 0.5L * (J1 + J2 + gap);
    const real down = 0.5L * (J1 + J2 - gap);
    CHECK_NEAR((J1 - up) * (J2 - up), 1, 1e-16L);
    CHECK_NEAR((J1 - down) * (J2 - down), 1, 1e-16L);
    CHECK((up * down < 0) == (J1 * J2 < 1));
    CHECK(up - down >= 2); /* never equal */
    below += J1 * J2 < 1;
    above += J1 * J2 > 1;
  }
  CHECK(below > 50 && above > 50);
}

static int is_two_fold(const paper_t *p, const real x[3], int s) {
  return fabsl(paper_h(p, x)) < 1e-16L &&
         fabsl(paper_lie(p, x, p->mu, s)) < 1e-16L &&
         fabsl(paper_lie(p, x, -p->mu, s)) < 1e-16L;
}

/* gamma = 0: r* = -sign(g) kappa, or r* = 0. The v* printed goes with
 * r* = -kappa (g > 0), so the printed pair is not a two-fold at either g. */
TEST(erratum_gamma_zero) {
  for (int i = 0; i < 100; i++) {
    paper_t p = paper_default();
    p.gamma = 0;
    p.kappa = any(0.1, 0.4);
    p.k2 = any(0.1, 4);
    const real w0 = p.omega0, still[3] = {0, 0, any(-2, 2)};
    for (int s = -1; s <= 1; s += 2) {
      const real r = -(real)s * p.kappa;
      const real v =
          (p.d * (p.k2 * (p.r0 - r) + p.m * r * w0 * w0) - p.c1 * w0) /
          (p.d * p.c2 + 2 * p.m * r * w0);
      const real right[3] = {r, v, w0};
      CHECK(is_two_fold(&p, right, s));
      CHECK(!is_two_fold(&p, right, -s));
      CHECK(is_two_fold(&p, still, s)); /* r = v = 0, any w */
    }
    const real v_printed =
        (p.d * (p.k2 / p.m * (p.kappa + p.r0) - p.kappa * w0 * w0) -
         p.c1 / p.m * w0) /
        (p.d * p.c2 / p.m - 2 * p.kappa * w0);
    const real printed[3] = {p.kappa, v_printed, w0};
    const real meant[3] = {-p.kappa, v_printed, w0};
    CHECK(!is_two_fold(&p, printed, 1) && !is_two_fold(&p, printed, -1));
    CHECK(is_two_fold(&p, meant, 1));
  }
}

static void any_string(paper_string_t *q) {
  q->k = any(0.3, 3);
  q->delta = any(0.3, 3);
  q->sigma = any(0.1, 2);
  q->rho = any(0.2, 0.9);
  q->a = any(0.3, 3);
}

/* Appendix B, x_s = a + sigma - (delta/k) cot(phi): there k q = delta. */
TEST(erratum_string_slip_border) {
  for (int i = 0; i < 200; i++) {
    paper_string_t q;
    any_string(&q);
    q.delta = q.k * (i % 2 ? any(1.2, 3) : any(0.2, 0.8));
    const real t = tanl(any(0.1, 1.4)), lead = q.a + q.sigma;
    const real right = lead - q.delta / q.k / t;
    const real printed = lead - 1 / q.k / t;
    CHECK_NEAR(q.k * (lead - right) * t, q.delta, 1e-16L);
    if (fabsl(q.delta - 1) > 0.01L)
      CHECK(fabsl(q.k * (lead - printed) * t - q.delta) > 0.005L);
  }
}

/* F and M in the three cases against quadrature; as printed, F is
 * -2 a k (a + delta) tan(phi), delta (2 a + sigma) + ..., 2 a delta. */
TEST(erratum_string_force_in_the_three_cases) {
  int seen[4] = {0, 0, 0, 0};
  for (int i = 0; i < 1000; i++) {
    paper_string_t q;
    any_string(&q);
    const ref_machine_t corrected = {.law = REF_STRING,
                                     .mu = 1,
                                     .k = q.k,
                                     .delta = q.delta,
                                     .sigma = q.sigma,
                                     .rho = q.rho,
                                     .a = q.a};
    const real phi = any(0.05, 1.5), t = tanl(phi);
    const ref_slip_t slip = {sinl(phi), cosl(phi)};
    const ref_piece_t piece = ref_piece_at(&corrected, slip, 1);
    const ref_force_t by = ref_slip_force(&corrected, slip, piece);
    real F_sum, M_sum, printed;
    const int zone = paper_string_quadrature(&q, phi, &F_sum, &M_sum);
    CHECK(zone == piece.zone + 1);
    CHECK_NEAR(by.F, F_sum, 1e-15L * (1 + fabsl(by.F)));
    CHECK_NEAR(by.M, M_sum, 1e-14L * (1 + fabsl(by.M)));
    if (zone == 1)
      printed = -2 * q.a * q.k * (q.a + q.delta) * t;
    else if (zone == 2)
      printed = q.delta * (2 * q.a + q.sigma) +
                q.delta * q.delta / (2 * q.k) * (1 - 2 * q.rho) / t -
                0.5L * q.k * q.sigma * q.sigma * t;
    else
      printed = 2 * q.a * q.delta;
    CHECK(fabsl(printed - F_sum) > 0.01L);
    seen[zone]++;
  }
  CHECK(seen[1] > 50 && seen[2] > 50 && seen[3] > 50);
}

/* Statements of the paper's text that do not hold. */

/* "When h != 0, F and M are smooth functions of h and g": M is, F is continuous
 * with a kink at g = 0. One-sided slopes in g by extrapolated differences. */
TEST(erratum_force_has_a_kink) {
  paper_t p = paper_default();
  const real a = 2 / PAPER_PI * atanl(6 * p.kappa);
  for (int i = 0; i < 100; i++) {
    const real h = any(0.01, 1) * (i % 2 ? 1 : -1);
    const real step = 1e-5L * fabsl(h);
    real F[2][3], M[2][3], slope[2], arm[2];
    for (int side = 0; side < 2; side++) {
      const real to = side ? step : -step;
      for (int j = 0; j < 3; j++)
        paper_friction(&p, h, (real)j * to, &F[side][j], &M[side][j]);
      slope[side] = (4 * F[side][1] - 3 * F[side][0] - F[side][2]) / (2 * to);
      arm[side] = (4 * M[side][1] - 3 * M[side][0] - M[side][2]) / (2 * to);
    }
    const real kink = p.mu * a / (18 * p.kappa * h);
    CHECK_NEAR(slope[1], -kink, 1e-8L * fabsl(kink));
    CHECK_NEAR(slope[0], kink, 1e-8L * fabsl(kink));
    CHECK_NEAR(arm[1], arm[0], 1e-8L * fabsl(arm[0]));
    CHECK_NEAR(F[0][0], F[1][0], 1e-18L);
  }
}

/* Figure 5: its regions lie on h = 0, where v follows from r and omega; the
 * caption puts them on v = 0, which is off h = 0 wherever the discs differ. */
TEST(erratum_regions_lie_on_h_zero) {
  paper_t p = paper_default();
  for (int i = 0; i < 100; i++) {
    const real r = any(0.17, 0.2), w = any(-1.06, -1.005);
    const real on[3] = {r, paper_sing_v(&p, r, w), w};
    const real caption[3] = {r, 0, w};
    CHECK_NEAR(paper_h(&p, on), 0, 1e-18L);
    CHECK(fabsl(on[1]) > 0.003L);
    CHECK(fabsl(paper_h(&p, caption)) > 0.002L);
  }
}
