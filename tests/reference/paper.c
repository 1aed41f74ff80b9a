/* paper.c - the equations of the paper in the paper's order and letters; see
 * paper.h for what this is for. Labels above the code are those of the paper.
 * No expression is rearranged for speed: the point is that a reader can hold
 * the page next to the code. */
#include "paper.h"

#include <math.h>

static real sign(real x) { return x > 0.0L ? 1.0L : x < 0.0L ? -1.0L : 0.0L; }

static real dot(const real a[3], const real b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* m (beta^2 + r^2) = dt / dtau */
real paper_clock_rate(const paper_t *p, real r) {
  return p->m * (p->beta * p->beta + r * r);
}

paper_t paper_default(void) {
  paper_t p = {.m = 1,
               .d = 1,
               .beta = 1.0L / 20.0L,
               .c1 = 1e-3L,
               .c2 = 1e-3L,
               .r0 = 0.1L,
               .omega0 = -1,
               .mu = 1,
               .gamma = -0.75L * PAPER_PI};
  p.kappa = paper_sing_kappa(&p, PAPER_R_STAR);
  p.k2 = paper_sing_k2(&p, PAPER_R_STAR, PAPER_W_STAR);
  return p;
}

/* (stickV)  v* = (w* - w0) (d - r* cot gamma) */
real paper_sing_v(const paper_t *p, real r, real w) {
  return (w - p->omega0) * (p->d - r / tanl(p->gamma));
}

/* (singKappa)  kappa = -(2 r*^2 + beta^2 (1 - cos 2 gamma))
 *                       / (2 r* cos gamma) */
real paper_sing_kappa(const paper_t *p, real r) {
  return -(2.0L * r * r + p->beta * p->beta * (1.0L - cosl(2.0L * p->gamma))) /
         (2.0L * r * cosl(p->gamma));
}

/* (singK2)  k2 = 1 / ((r* - r0) p2(r*)) (
 *   sin(gamma) (beta^2 + r*^2) (m r* w*^2 - c2 v*)
 *   - cos(gamma) (c1 r* w* + c2 d r* v*
 *     + m (r*^2 (v* (w* + w0) - d w*^2) + beta^2 v* (w0 - w*)))) */
real paper_sing_k2(const paper_t *p, real r, real w) {
  const real v = paper_sing_v(p, r, w), b2 = p->beta * p->beta;
  const real along = (b2 + r * r) * (p->m * r * w * w - p->c2 * v);
  const real inertia =
      r * r * (v * (w + p->omega0) - p->d * w * w) + b2 * v * (p->omega0 - w);
  const real across = p->c1 * r * w + p->c2 * p->d * r * v + p->m * inertia;
  return (sinl(p->gamma) * along - cosl(p->gamma) * across) /
         ((r - p->r0) * paper_p2(p, r));
}

/* (h)  h = -(v - d (w - w0)) sin(gamma) - r (w - w0) cos(gamma) */
real paper_h(const paper_t *p, const real x[3]) {
  const real W = x[2] - p->omega0;
  return -(x[1] - p->d * W) * sinl(p->gamma) - x[0] * W * cosl(p->gamma);
}

/* (g)  g = -(v - d (w - w0)) cos(gamma) + r (w - w0) sin(gamma) */
real paper_g(const paper_t *p, const real x[3]) {
  const real W = x[2] - p->omega0;
  return -(x[1] - p->d * W) * cosl(p->gamma) + x[0] * W * sinl(p->gamma);
}

void paper_h_x(const paper_t *p, const real x[3], real n[3]) {
  n[0] = -(x[2] - p->omega0) * cosl(p->gamma);
  n[1] = -sinl(p->gamma);
  n[2] = p->d * sinl(p->gamma) - x[0] * cosl(p->gamma);
}

real paper_v_at(const paper_t *p, real r, real w, real h) {
  const real W = w - p->omega0;
  return p->d * W - (h + r * W * cosl(p->gamma)) / sinl(p->gamma);
}

/* (force)   F = sign(h) mu (4/3 - cot(psi) / (18 kappa))
 * (moment)  M = sign(g) sign(h) (mu/6) cot(psi)
 * psi = arccot 6 kappa + |1 - (2/pi) arccot 6 kappa| arctan |h/g| */
void paper_friction(const paper_t *p, real h, real g, real *F, real *M) {
  const real edge = atanl(1.0L / (6.0L * p->kappa));
  const real slip = atan2l(fabsl(h), fabsl(g));
  const real psi = edge + fabsl(1.0L - 2.0L / PAPER_PI * edge) * slip;
  const real cot_psi = cosl(psi) / sinl(psi);
  *F = sign(h) * p->mu * (4.0L / 3.0L - cot_psi / (18.0L * p->kappa));
  *M = sign(g) * sign(h) * p->mu / 6.0L * cot_psi;
}

/* p1 = k2 (r0 - r) - c2 v + m r w^2 */
real paper_p1(const paper_t *p, const real x[3]) {
  return p->k2 * (p->r0 - x[0]) - p->c2 * x[1] + p->m * x[0] * x[2] * x[2];
}

/* p2 = d r cos(gamma) + (beta^2 + r^2) sin(gamma) */
real paper_p2(const paper_t *p, real r) {
  return p->d * r * cosl(p->gamma) +
         (p->beta * p->beta + r * r) * sinl(p->gamma);
}

/* (ds1)  r' = m (beta^2 + r^2) v
 * (ds2)  v' = (beta^2 + d^2 + r^2) p1 - d (c1 + 2 m r v) w + F p2 + d M
 * (ds3)  w' = d p1 - (c1 + 2 m r v) w + F r cos(gamma) + M */
void paper_rhs(const paper_t *p, const real x[3], real F, real M, real dx[3]) {
  const real r = x[0], v = x[1], w = x[2], p1 = paper_p1(p, x);
  const real drag = p->c1 + 2.0L * p->m * r * v;
  dx[0] = paper_clock_rate(p, r) * v;
  dx[1] = (p->beta * p->beta + p->d * p->d + r * r) * p1 - p->d * drag * w +
          F * paper_p2(p, r) + p->d * M;
  dx[2] = p->d * p1 - drag * w + F * r * cosl(p->gamma) + M;
}

void paper_rhs_time(const paper_t *p, const real x[3], real F, real M,
                    real dx[3]) {
  const real rate = paper_clock_rate(p, x[0]);
  paper_rhs(p, x, F, M, dx);
  for (int i = 0; i < 3; i++) dx[i] /= rate;
}

/* (VF) with the stick law M = sign(g) kappa F */
void paper_f(const paper_t *p, const real x[3], real lambda, int s,
             real dx[3]) {
  paper_rhs(p, x, lambda, (real)s * p->kappa * lambda, dx);
}

real paper_lie(const paper_t *p, const real x[3], real lambda, int s) {
  real n[3], f[3];
  paper_h_x(p, x, n);
  paper_f(p, x, lambda, s, f);
  return dot(n, f);
}

/* d/dx (h_x . f) = h_x . f_x + h_xx . f, where only h_rw = -cos(gamma) of
 * the second derivatives of h is not zero. */
void paper_lie_x(const paper_t *p, const real x[3], real lambda, int s,
                 real n[3]) {
  const real r = x[0], v = x[1], w = x[2], m = p->m, d = p->d;
  const real cg = cosl(p->gamma), sg = sinl(p->gamma);
  const real arm = p->beta * p->beta + d * d + r * r;
  const real drag = p->c1 + 2.0L * m * r * v, p1 = paper_p1(p, x);
  const real p1_r = -p->k2 + m * w * w, p1_v = -p->c2;
  const real p1_w = 2.0L * m * r * w;
  const real p2_r = d * cg + 2.0L * r * sg;
  const real f1_x[3] = {2.0L * m * r * v, paper_clock_rate(p, r), 0.0L};
  const real f2_x[3] = {
      2.0L * r * p1 + arm * p1_r - 2.0L * d * m * v * w + lambda * p2_r,
      arm * p1_v - 2.0L * d * m * r * w, arm * p1_w - d * drag};
  const real f3_x[3] = {d * p1_r - 2.0L * m * v * w + lambda * cg,
                        d * p1_v - 2.0L * m * r * w, d * p1_w - drag};
  real h_x[3], f[3];
  paper_h_x(p, x, h_x);
  paper_f(p, x, lambda, s, f);
  for (int i = 0; i < 3; i++)
    n[i] = h_x[0] * f1_x[i] + h_x[1] * f2_x[i] + h_x[2] * f3_x[i];
  n[0] -= cg * f[2];
  n[2] -= cg * f[0];
}

real paper_delassus(const paper_t *p, real r, int s) {
  const real sg = sinl(p->gamma);
  return (r * r + p->beta * p->beta * sg * sg +
          (real)s * p->kappa * r * cosl(p->gamma)) /
         paper_clock_rate(p, r);
}

/* (muCalc)  lambda = -(h_x . f(x, 0)) / (h_x . f_lambda(x, 0)) */
real paper_lambda(const paper_t *p, const real x[3], int s) {
  const real at_zero = paper_lie(p, x, 0.0L, s);
  return -at_zero / (paper_lie(p, x, 1.0L, s) - at_zero);
}

/* (svf), in physical time */
void paper_stick(const paper_t *p, const real x[3], int s, real dx[3]) {
  const real lambda = paper_lambda(p, x, s);
  paper_rhs_time(p, x, lambda, (real)s * p->kappa * lambda, dx);
}

/* The eigenvector of (SlidNormForm) for the first eigenvalue, (lambda - J2,
 * 1), taken back to (xi, eta) by xi_bar / eta_bar = sqrt(-K++/K--) xi / eta.
 * In the direction (xi, eta) the field is (xi f+ + eta f-) / (xi + eta), hence
 * lambda / mu = (xi - eta) / (xi + eta). */
static void weak_direction(paper_twofold_t *t) {
  const real xi = (t->eigen[0] - t->J2) * sqrtl(-t->Kmm / t->Kpp);
  for (int i = 0; i < 3; i++) t->weak[i] = xi * t->plus[i] + t->minus[i];
  t->lambda = (xi - 1.0L) / (xi + 1.0L);
}

/* K^{ab} = d/dx (h_x . f(x, a mu)) . f(x, b mu)
 * J1 = K-+ / sqrt(-K++ K--),  J2 = -K+- / sqrt(-K++ K--)
 * v+ = (K++ f- - K+- f+) / (2 mu),  v- = (K-+ f- - K-- f+) / (2 mu) */
void paper_twofold(const paper_t *p, const real x[3], int s,
                   paper_twofold_t *out) {
  real fp[3], fm[3], np[3], nm[3], root, gap;
  paper_f(p, x, p->mu, s, fp);
  paper_f(p, x, -p->mu, s, fm);
  paper_lie_x(p, x, p->mu, s, np);
  paper_lie_x(p, x, -p->mu, s, nm);
  out->Kpp = dot(np, fp);
  out->Kpm = dot(np, fm);
  out->Kmp = dot(nm, fp);
  out->Kmm = dot(nm, fm);
  root = sqrtl(-out->Kpp * out->Kmm);
  out->J1 = out->Kmp / root;
  out->J2 = -out->Kpm / root;
  gap = out->J1 - out->J2;
  gap = sqrtl(gap * gap + 4.0L);
  out->eigen[0] = 0.5L * (out->J1 + out->J2 + gap);
  out->eigen[1] = 0.5L * (out->J1 + out->J2 - gap);
  for (int i = 0; i < 3; i++) {
    out->plus[i] = (out->Kpp * fm[i] - out->Kpm * fp[i]) / (2.0L * p->mu);
    out->minus[i] = (out->Kmp * fm[i] - out->Kmm * fp[i]) / (2.0L * p->mu);
  }
  weak_direction(out);
}

/* Appendix B. For x in (x_s, a] the string rolls and the pressure is
 * k (a + sigma - x) tan(phi); for x in [-a, x_s) it slips under rho delta.
 * F = int p, M = -int x p. */

/* Adds int p and -int x p over [lo, hi], p = c0 + c1 x, by three points of
 * Gauss and Legendre (exact to degree five). */
static void add_zone(real lo, real hi, real c0, real c1, real *F, real *M) {
  const real half = 0.5L * (hi - lo), mid = 0.5L * (hi + lo);
  const real node = sqrtl(0.6L);
  for (int i = -1; i <= 1; i++) {
    const real x = mid + half * node * (real)i;
    const real weight = half * (i ? 5.0L : 8.0L) / 9.0L;
    *F += weight * (c0 + c1 * x);
    *M -= weight * x * (c0 + c1 * x);
  }
}

int paper_string_quadrature(const paper_string_t *q, real phi, real *F,
                            real *M) {
  const real slope = q->k * tanl(phi);
  const real at_zero = slope * (q->a + q->sigma);
  real lo = -q->a, hi = q->a;
  *F = *M = 0.0L;
  /* The pressure grows from the leading edge a backwards to -a. */
  if (at_zero - slope * lo <= q->delta) {
    add_zone(lo, hi, at_zero, -slope, F, M);
    return 1;
  }
  if (at_zero - slope * hi >= q->delta) {
    add_zone(lo, hi, q->rho * q->delta, 0.0L, F, M);
    return 3;
  }
  for (int i = 0; i < 80; i++) {
    const real mid = 0.5L * (lo + hi);
    if (at_zero - slope * mid > q->delta)
      lo = mid;
    else
      hi = mid;
  }
  add_zone(-q->a, lo, q->rho * q->delta, 0.0L, F, M);
  add_zone(hi, q->a, at_zero, -slope, F, M);
  return 2;
}
