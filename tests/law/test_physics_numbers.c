/* test_physics_numbers.c - the numbers the project promises to hit, computed
 * by the reference of tests/support and held to the last digit that was
 * written down. They are what the simulator's own tests may lean on; so here
 * the reference is also tested against itself by other means (difference
 * quotients, a plain Runge-Kutta in physical time, Lagrange's mass matrix).
 *
 * The arrival at the two-fold, t = 2.0462756, and the slope of the weak
 * direction, -10.24425, are easily missed: at t = 2.046269 the orbit is still
 * 2e-7 m short of the two-fold, and its slope is -10.2367. */
#include <float.h>

#include "orbit.h"
#include "paper.h"
#include "tap.h"

#define DEGREE (PAPER_PI / 180.0L)

/* Half of the last printed place, and the rounding of long double itself. */
static long double place(long double unit) {
  return 0.5L * unit + 8.0L * LDBL_EPSILON;
}

static long double any(double lo, double hi) {
  return (long double)tap_uniform(lo, hi);
}

static void two_fold(const paper_t *p, long double x[3]) {
  x[0] = PAPER_R_STAR;
  x[1] = paper_sing_v(p, PAPER_R_STAR, PAPER_W_STAR);
  x[2] = PAPER_W_STAR;
}

TEST(two_fold_position_and_constants) {
  paper_t p;
  long double x[3];
  paper_default(&p);
  two_fold(&p, x);
  CHECK_NEAR(p.kappa, 0.27241153714062027818L, place(1e-20L));
  CHECK_NEAR(p.k2, 2.2270992253886014441L, place(1e-19L) * 2.0L);
  CHECK_NEAR(x[1], -0.0301217L, LDBL_EPSILON); /* exact */
  CHECK_NEAR(paper_g(&p, x), 0.009727385146L, place(1e-12L));
  CHECK_NEAR(paper_h(&p, x), 0.0L, LDBL_EPSILON);
  CHECK_NEAR(paper_lie(&p, x, p.mu, 1), 0.0L, LDBL_EPSILON);
  CHECK_NEAR(paper_lie(&p, x, -p.mu, 1), 0.0L, LDBL_EPSILON);
  CHECK_NEAR(paper_v_at(&p, x[0], x[2], 0.0L), x[1], LDBL_EPSILON);
}

TEST(normal_form_constants) {
  paper_t p;
  paper_twofold_t n;
  long double x[3];
  paper_default(&p);
  two_fold(&p, x);
  paper_twofold(&p, x, 1, &n);
  CHECK_NEAR(n.Kpp, -0.0023567513838866354L, place(1e-19L));
  CHECK_NEAR(n.Kpm, 0.0032510430314189251L, place(1e-19L));
  CHECK_NEAR(n.Kmp, -0.0027567704314507111L, place(1e-19L));
  CHECK_NEAR(n.Kmm, 0.0028510239838548495L, place(1e-19L));
  CHECK_NEAR(n.J1, -1.0635141712155655L, place(1e-16L));
  CHECK_NEAR(n.J2, -1.2541959590469642L, place(1e-16L));
  CHECK_NEAR(n.J1 * n.J2, 1.3338551759277435L, place(1e-16L));
  CHECK_NEAR(n.eigen[0], -0.15432040368L, place(1e-11L));
  CHECK_NEAR(n.eigen[1], -2.16338972658L, place(1e-11L));
  CHECK_NEAR(n.eigen[1] / n.eigen[0], 14.019L, place(1e-3L));
  CHECK(n.Kpp < 0.0L && 0.0L < n.Kmm); /* (Invisible): both folds */
}

/* The eigenvector gives the field on it too: dw/dr = f3 / f1 there. */
TEST(weak_direction_at_the_two_fold) {
  paper_t p;
  paper_twofold_t n;
  long double x[3], f[3];
  paper_default(&p);
  two_fold(&p, x);
  paper_twofold(&p, x, 1, &n);
  paper_f(&p, x, n.lambda * p.mu, 1, f);
  CHECK_NEAR(n.lambda, 0.0949L, place(1e-4L));
  CHECK_NEAR(n.lambda, 0.094910507L, place(1e-9L));
  CHECK_NEAR(n.weak[2] / n.weak[0], -10.2442529L, place(1e-7L));
  CHECK_NEAR(f[2] / f[0], n.weak[2] / n.weak[0], 1e-15L);
  CHECK_NEAR(f[1] / f[0], n.weak[1] / n.weak[0], 1e-15L);
  /* The field next to the two-fold points along its own displacement. */
  for (int side = -1; side <= 1; side += 2) {
    const long double step = 1e-8L * (long double)side;
    long double y[3] = {x[0] + step, 0.0L, 0.0L}, dy[3];
    y[2] = x[2] + step * n.weak[2] / n.weak[0];
    y[1] = paper_v_at(&p, y[0], y[2], 0.0L);
    paper_stick(&p, y, 1, dy);
    CHECK_NEAR(dy[2] / dy[0], n.weak[2] / n.weak[0], 1e-4L);
  }
}

TEST(zeros_of_the_delassus_number) {
  paper_t p;
  paper_default(&p);
  const long double sg = sinl(p.gamma);
  const long double other = p.beta * p.beta * sg * sg / PAPER_R_STAR;
  CHECK_NEAR(paper_delassus(&p, PAPER_R_STAR, 1), 0.0L, 1e-17L);
  CHECK_NEAR(paper_delassus(&p, other, 1), 0.0L, 1e-17L);
  CHECK(paper_delassus(&p, 0.5L * other, 1) > 0.0L);
  CHECK(paper_delassus(&p, 0.18L, 1) < 0.0L);
  CHECK(paper_delassus(&p, 0.19L, 1) > 0.0L);
  for (int i = 0; i < 200; i++) {
    const int s = i % 2 ? 1 : -1;
    const long double x[3] = {any(0.001, 1.0), any(-1, 1), any(-2, 2)};
    const long double rate = p.m * (p.beta * p.beta + x[0] * x[0]);
    const long double slope =
        paper_lie(&p, x, 0.0L, s) - paper_lie(&p, x, 1.0L, s);
    CHECK_NEAR(rate * paper_delassus(&p, x[0], s), slope, 1e-16L);
    if (s < 0) CHECK(paper_delassus(&p, x[0], s) > 0.0L);
  }
}

/* With v on h = 0, h_x . f(x, 0) is a quadratic in w: third differences are
 * zero, and so at most two w go with each zero of A. */
TEST(two_folds_are_a_quadratic_in_w) {
  paper_t p;
  paper_default(&p);
  for (int i = 0; i < 100; i++) {
    const long double r = any(0.01, 1.0), w = any(-2, 2);
    long double at[4];
    for (int k = 0; k < 4; k++) {
      long double x[3] = {r, 0.0L, w + 0.5L * (long double)k};
      x[1] = paper_v_at(&p, r, x[2], 0.0L);
      at[k] = paper_lie(&p, x, 0.0L, 1);
    }
    CHECK_NEAR(at[3] - 3.0L * at[2] + 3.0L * at[1] - at[0], 0.0L, 1e-15L);
    CHECK(fabsl(at[2] - 2.0L * at[1] + at[0]) > 1e-9L);
  }
}

TEST(gradient_of_the_lie_derivative) {
  const long double step = 1e-2L;
  paper_t p;
  paper_default(&p);
  for (int i = 0; i < 200; i++) {
    const long double x[3] = {any(0.05, 0.5), any(-1, 1), any(-2, 1)};
    const long double lambda = any(-1, 1);
    const int s = i % 2 ? 1 : -1;
    long double n[3];
    paper_lie_x(&p, x, lambda, s, n);
    for (int k = 0; k < 3; k++) {
      /* Sixth order, exact: h_x . f is a polynomial of degree 4 or less. */
      static const long double c[3] = {0.75L, -0.15L, 1.0L / 60.0L};
      long double sum = 0.0L;
      for (int j = 1; j <= 3; j++) {
        long double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
        up[k] += step * (long double)j;
        down[k] -= step * (long double)j;
        sum += c[j - 1] *
               (paper_lie(&p, up, lambda, s) - paper_lie(&p, down, lambda, s));
      }
      CHECK_NEAR(sum / step, n[k], 1e-14L);
    }
  }
}

TEST(rescaled_equations_are_the_mass_matrix_form) {
  paper_t p;
  paper_default(&p);
  for (int i = 0; i < 500; i++) {
    const long double x[3] = {any(-1, 1), any(-2, 2), any(-3, 3)};
    const long double F = any(-1, 1), M = any(-1, 1);
    long double a[3], b[3];
    p.gamma = any(-3.1, 3.1);
    p.d = any(0.2, 2);
    p.m = any(0.2, 2);
    paper_rhs_time(&p, x, F, M, a);
    paper_rhs_mass(&p, x, F, M, b);
    for (int k = 0; k < 3; k++)
      CHECK_NEAR(a[k], b[k], 1e-15L * (1.0L + fabsl(b[k])));
  }
}

/* cot(psi) = T(|g/h|), T(y) = tan(a atan y), a = 1 - (2/pi) arccot 6 kappa:
 * F = sign(h) mu (4/3 - |T| / (18 kappa)), M = (mu/6) T(g/h). */
TEST(tyre_law_is_one_function_of_one_variable) {
  paper_t p;
  paper_default(&p);
  for (int i = 0; i < 1000; i++) {
    p.kappa = any(0.05, 2);
    const long double h = any(-1, 1), g = any(-1, 1) * expl(any(-20, 20));
    const long double side = h > 0.0L ? 1.0L : -1.0L;
    const long double a = 2.0L / PAPER_PI * atanl(6.0L * p.kappa);
    const long double T = tanl(a * atanl(g / h));
    long double F, M;
    paper_friction(&p, h, g, &F, &M);
    CHECK_NEAR(M, p.mu / 6.0L * T, 1e-16L);
    CHECK_NEAR(F, side * p.mu * (4.0L / 3.0L - fabsl(T) / (18.0L * p.kappa)),
               1e-16L);
  }
}

/* The same law is the string of Appendix B past its no-slip range, with
 * sigma = 0, rho = 2/3, a = 3 kappa, k = delta = 1 / (3 kappa), at psi. */
TEST(tyre_law_is_the_reduced_string) {
  paper_t p;
  paper_default(&p);
  const long double edge = atanl(1.0L / (6.0L * p.kappa));
  const long double stiff = 1.0L / (3.0L * p.kappa);
  const paper_string_t q = {stiff, stiff, 0.0L, 2.0L / 3.0L, 3.0L * p.kappa};
  for (int i = 1; i < 100; i++) {
    const long double slip = 0.5L * PAPER_PI * (long double)i / 100.0L;
    const long double psi = edge + (1.0L - 2.0L / PAPER_PI * edge) * slip;
    long double F, M, F_string, M_string;
    paper_friction(&p, sinl(slip), cosl(slip), &F, &M);
    CHECK(paper_string(&q, psi, &F_string, &M_string) == 2);
    CHECK_NEAR(F, p.mu * F_string, 1e-17L);
    CHECK_NEAR(M, p.mu * M_string, 1e-17L);
  }
}

/* Slip through (force)-(moment), or stick with s: one classical step of
 * Runge and Kutta in (r, v, w) and physical time. */
static void plain_rate(const paper_t *p, const long double x[3], int stuck,
                       long double dx[3]) {
  const long double h = paper_h(p, x), g = paper_g(p, x);
  long double F, M;
  if (stuck) {
    paper_stick(p, x, stuck, dx);
  } else {
    paper_friction(p, h, g, &F, &M);
    paper_rhs_mass(p, x, F, M, dx);
  }
}

static void plain_orbit(const paper_t *p, long double x[3], int stuck,
                        long double time, int steps) {
  const long double dt = time / (long double)steps;
  for (int n = 0; n < steps; n++) {
    static const long double at[4] = {0.0L, 0.5L, 0.5L, 1.0L};
    static const long double weight[4] = {1.0L, 2.0L, 2.0L, 1.0L};
    long double k[3] = {0.0L, 0.0L, 0.0L}, sum[3] = {0.0L, 0.0L, 0.0L};
    for (int j = 0; j < 4; j++) {
      long double y[3];
      for (int i = 0; i < 3; i++) y[i] = x[i] + at[j] * dt * k[i];
      plain_rate(p, y, stuck, k);
      for (int i = 0; i < 3; i++) sum[i] += weight[j] / 6.0L * k[i];
    }
    for (int i = 0; i < 3; i++) x[i] += dt * sum[i];
  }
}

TEST(orbit_legs_agree_with_a_plain_runge_kutta) {
  static const struct {
    long double from, to;
    int stuck, steps;
  } leg[4] = {{0.0L, 0.0092L, 0, 4000},
              {0.2L, 1.8L, -1, 4000},
              {1.9082L, 1.9225L, 0, 4000},
              {1.93L, 2.04L, 1, 8000}};
  paper_t p;
  paper_default(&p);
  for (int n = 0; n < 4; n++) {
    long double x[3], y[3];
    orbit_chaos_state(leg[n].from, x);
    orbit_chaos_state(leg[n].to, y);
    plain_orbit(&p, x, leg[n].stuck, leg[n].to - leg[n].from, leg[n].steps);
    for (int i = 0; i < 3; i++) CHECK_NEAR(x[i], y[i], 1e-13L);
  }
}

TEST(state_at_one_second) {
  long double x[3];
  orbit_chaos_state(1.0L, x);
  CHECK_NEAR(x[0], 0.185676357258L, place(1e-12L));
  CHECK_NEAR(x[1], 0.010298364853L, place(1e-12L));
  CHECK_NEAR(x[2], -0.987353474328L, place(1e-12L));
}

/* slip+ falls in along an attracting direction 2.84 degrees off stick+. Three
 * motions go on: stick- (taken), stick+ (escaping), slip- at -0.35 degrees;
 * pinned is not among them. */
TEST(slip_enters_codimension_two) {
  paper_t p;
  orbit_events_t ev;
  int in = 0, out = 0;
  paper_default(&p);
  orbit_chaos(&ev);
  CHECK_NEAR(ev.fall.t, 0.009409869L, place(1e-9L));
  CHECK_NEAR(ev.fall.x[0], 0.179862653L, place(1e-9L));
  CHECK(ev.fall.x[1] == 0.0L && ev.fall.x[2] == p.omega0);
  CHECK_NEAR(ev.fall_angle / DEGREE, 2.8428L, place(1e-4L));
  CHECK_NEAR(paper_lambda(&p, ev.fall.x, -1), 0.0063142L, place(1e-7L));
  CHECK_NEAR(paper_lambda(&p, ev.fall.x, 1), -0.41225L, place(1e-5L));
  CHECK(paper_delassus(&p, ev.fall.x[0], -1) > 0.0L);
  CHECK(paper_delassus(&p, ev.fall.x[0], 1) < 0.0L);
  CHECK(ev.fall.ways.directions == 4);
  for (int i = 0; i < ev.fall.ways.directions; i++) {
    const ref_direction_t *way = &ev.fall.ways.direction[i];
    if (way->speed < 0.0L && way->attracting) {
      in++;
      CHECK_NEAR(way->angle, ev.fall_angle, 1e-15L);
    }
    if (way->speed > 0.0L) {
      out++;
      CHECK_NEAR(way->angle / DEGREE - 360.0L, -0.3457L, place(1e-4L));
    }
  }
  CHECK(in == 1 && out == 1);
}

/* Pinned: v' = w' = 0 at h = g = 0 fixes F and M; it needs |M| <= kappa |F|
 * and |F| <= mu. Returns the excess of |M|. */
static long double pinned_excess(const paper_t *p, const long double x[3]) {
  const long double sg = sinl(p->gamma), cg = cosl(p->gamma);
  const long double F = -paper_p1(p, x) / sg;
  const long double M = p->c1 * x[2] - F * (x[0] * cg - p->d * sg);
  long double dx[3];
  paper_rhs(p, x, F, M, dx);
  CHECK_NEAR(fabsl(dx[1]) + fabsl(dx[2]), 0.0L, 1e-17L);
  return fabsl(M) - p->kappa * fabsl(F);
}

TEST(stick_ends_at_the_turning_point_of_the_spring) {
  paper_t p;
  orbit_events_t ev;
  int out = 0;
  paper_default(&p);
  orbit_chaos(&ev);
  CHECK_NEAR(ev.leave.t, 1.908120383L, place(1e-9L));
  CHECK_NEAR(ev.leave.x[0], 0.192272795344L, place(1e-12L));
  CHECK_NEAR(ev.leave.x[1], 0.0L, LDBL_EPSILON);
  for (int i = 1; i < 10; i++) { /* all along stick- */
    const long double t =
        ev.fall.t + (ev.leave.t - ev.fall.t) * (long double)i / 10;
    long double x[3];
    orbit_chaos_state(t, x);
    CHECK(fabsl(paper_lambda(&p, x, -1)) < 0.03L);
  }
  CHECK_NEAR(fabsl(paper_lambda(&p, ev.leave.x, 1)), 1.718L, place(1e-3L));
  CHECK(fabsl(paper_lambda(&p, ev.leave.x, 1)) > p.mu);
  CHECK(pinned_excess(&p, ev.leave.x) > 0.0L);
  CHECK(pinned_excess(&p, ev.fall.x) > 0.0L);
  CHECK_NEAR(360.0L + ev.leave_angle / DEGREE, 359.56L, place(1e-2L));
  CHECK_NEAR(360.0L + ev.leave_angle / DEGREE, 359.5629L, place(1e-4L));
  for (int i = 0; i < ev.leave.ways.directions; i++)
    out += ev.leave.ways.direction[i].speed > 0.0L;
  CHECK(ev.leave.ways.directions == 3 && out == 1);
}

TEST(slip_lands_in_the_lower_sliding_region) {
  paper_t p;
  orbit_events_t ev;
  paper_default(&p);
  orbit_chaos(&ev);
  CHECK_NEAR(ev.land.t, 1.922602663L, place(1e-9L));
  CHECK_NEAR(ev.land.x[0], 0.191960972L, place(1e-9L));
  CHECK_NEAR(ev.land.x[2], -1.053244828L, place(1e-9L));
  CHECK_NEAR(paper_h(&p, ev.land.x), 0.0L, LDBL_EPSILON);
  CHECK(paper_g(&p, ev.land.x) > 0.0L);
  CHECK(paper_delassus(&p, ev.land.x[0], 1) > 0.0L);
  CHECK(fabsl(paper_lambda(&p, ev.land.x, 1)) < p.mu);
}

TEST(stick_arrives_at_the_two_fold) {
  paper_t p;
  paper_twofold_t n;
  orbit_events_t ev;
  long double x[3];
  paper_default(&p);
  two_fold(&p, x);
  paper_twofold(&p, x, 1, &n);
  orbit_chaos(&ev);
  CHECK_NEAR(ev.twofold.t, 2.0462756096L, place(1e-10L));
  for (int i = 0; i < 3; i++) CHECK_NEAR(ev.twofold.x[i], x[i], 3e-14L);
  /* 0/0 there: extrapolated from rounding-sized distances. */
  long double dx[3];
  paper_stick(&p, ev.near.x, 1, dx);
  CHECK_NEAR(dx[2] / dx[0], n.weak[2] / n.weak[0], 5e-5L);
  CHECK_NEAR(paper_lambda(&p, ev.near.x, 1), n.lambda * p.mu, 1e-5L);
  /* What the earlier figure for the arrival was: close, but before it. */
  orbit_chaos_state(2.046269L, x);
  CHECK_NEAR(x[0] - PAPER_R_STAR, 1.99e-7L, place(1e-9L));
  CHECK(paper_delassus(&p, x[0], 1) < 1e-6L);
}
