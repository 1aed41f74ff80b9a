/// The machine as a piecewise smooth system, as every event-driven peer needs
/// it: one smooth field a mode, and the rules by which a mode ends.
///
/// State (r, h, z): displacement, lateral slip speed, speed of the disc over
/// the turntable. With h itself in the state stick holds h = 0 exactly, and
/// h = 0 is as sharp next to h = g = 0 as elsewhere:
///   q = r z,  p = -(h + q cos) / sin,  g = (q + h cos) / sin
///   v = p + d z,  w = z + omega0 + alpha t
///
/// Every peer needs a rule for h = g = 0, where the field has no limit: inside
/// a small radius the rest of the way is taken as a straight line, and the
/// motion goes on in the attracting stick that leaves in its own direction.
/// Without the rule they end on a branch that depends on the tolerance.
#pragma once

#include <math.h>

#include "bench/harness.h"

typedef struct {
  double r; // [m]
  double h; // [m/s]
  double z; // [rad/s]
  double t; // [s], for the speed of the turntable
} point_t;

// As four numbers, as libraries have it.
static inline point_t point_of(const double *y) {
  return (point_t){y[0], y[1], y[2], y[3]};
}

static inline void point_to(point_t y, double *to) {
  to[0] = y.r;
  to[1] = y.h;
  to[2] = y.z;
  to[3] = y.t;
}

// side: sign of h, 0 in stick. roll: sign of g. Both are frozen over a step,
// so that a step past a switch goes on in the same smooth field.
typedef struct {
  int side, roll;
} contact_t;

typedef struct {
  double d, k2, c1, c2, r0, omega0, alpha, m, inv_m, beta2, sin, cos, inv_sin;
  double mu, kappa;
  double a;       // T(y) = tan(a atan y)
  double quarter; // a pi / 2
  double force_0, force_T, moment_T;
  double epsilon2; // of the smoothed law
  // Appendix B: k, delta, sigma, rho and a, of the string.
  double stiffness, pressure, sigma, rho, half;
  int jumps;  // or the law is one field, smooth or
  int string; // string
} model_t;

static inline model_t model_of(const problem_t *problem) {
  const tf_params_t *p = &problem->params;
  const double half_pi = 1.57079632679489661923;
  const double kappa = p->kappa, mu = p->mu;
  const double beta = p->beta, gamma = p->gamma;
  model_t k = {.d = p->d, .k2 = p->k2, .c1 = p->c1};
  k.c2 = p->c2;
  k.r0 = p->r0;
  k.omega0 = p->omega0;
  k.alpha = problem->alpha;
  k.m = p->m;
  k.inv_m = 1 / k.m;
  k.beta2 = beta * beta;
  k.sin = sin(gamma);
  k.cos = cos(gamma);
  k.inv_sin = 1 / k.sin;
  k.mu = mu;
  k.kappa = kappa;
  k.a = atan(6 * kappa) / half_pi;
  k.quarter = k.a * half_pi;
  k.force_0 = 4 * mu / 3;
  k.force_T = mu / (18 * kappa);
  k.moment_T = mu / 6;
  k.epsilon2 = p->epsilon * p->epsilon;
  k.stiffness = p->k;
  k.pressure = p->delta;
  k.sigma = p->sigma;
  k.rho = p->rho;
  k.half = p->a;
  k.jumps = p->law == TF_TYRE_JUMP;
  k.string = p->law == TF_TYRE_STRING;
  return k;
}

static inline point_t model_start(const model_t *k, const problem_t *problem) {
  return (point_t){(double)problem->start[0], problem->h,
                   (double)problem->start[2] - k->omega0, 0};
}

static inline double rolling(const model_t *k, point_t y) {
  return (y.r * y.z + y.h * k->cos) * k->inv_sin;
}

static inline contact_t contact_of(const model_t *k, const problem_t *problem) {
  const uint8_t mode = problem->mode;
  return (contact_t){mode == TF_SLIP_PLUS    ? 1
                     : mode == TF_SLIP_MINUS ? -1
                                             : 0,
                     rolling(k, model_start(k, problem)) < 0 ? -1 : 1};
}

// d/dt of rolling().
static inline double rolling_rate(const model_t *k, point_t y, point_t dy) {
  return (dy.r * y.z + y.r * dy.z + dy.h * k->cos) * k->inv_sin;
}

static inline void model_end(const model_t *k, point_t y, double x[3]) {
  const double p = -(y.h + y.r * y.z * k->cos) * k->inv_sin;
  x[0] = y.r;
  x[1] = (p + k->d * y.z);
  x[2] = (y.z + k->omega0 + k->alpha * y.t);
}

// m (p' - d alpha) = Q_r + F sin,
// m (beta^2 + r^2) (z' + alpha) = Q_phi + d Q_r + F r cos + M.
static inline point_t rates(const model_t *k, point_t y, double F, double M) {
  const double p = -(y.h + y.r * y.z * k->cos) * k->inv_sin;
  const double v = p + k->d * y.z, w = y.z + k->omega0 + k->alpha * y.t;
  const double mrw = k->m * y.r * w;
  const double Q_r = k->k2 * (k->r0 - y.r) - k->c2 * v + mrw * w;
  const double Q_phi = -k->c1 * w - 2 * mrw * v;
  const double dz = (Q_phi + k->d * Q_r + F * y.r * k->cos + M) * k->inv_m /
                        (k->beta2 + y.r * y.r) -
                    k->alpha;
  const double dp = (Q_r + F * k->sin) * k->inv_m + k->d * k->alpha;
  return (point_t){v, -k->sin * dp - k->cos * (v * y.z + y.r * dz), dz, 1};
}

// T = tan(a (pi/2 - angle)), angle = arctan(H / G), in the form that stays
// smooth where the frozen signs let H or G become negative.
static inline point_t slip_rates(const model_t *k, contact_t c, point_t y) {
  const double side = c.side, roll = c.roll;
  const double H = side * y.h, G = roll * rolling(k, y);
  const double T =
      tan(G > H ? k->quarter - k->a * atan(H / G) : k->a * atan(G / H));
  return rates(k, y, side * (k->force_0 - k->force_T * T),
               side * roll * k->moment_T * T);
}

// The law with sign(h) smoothed to h / sqrt(h^2 + epsilon^2). The quotient is 0
// at g = h = 0 and infinite nowhere where it matters.
// cppcheck-suppress passedByValue  ; four reals, inlined
static inline point_t smooth_rates(const model_t *k, point_t y) {
  const double share = y.h / sqrt(y.h * y.h + k->epsilon2);
  const double g = rolling(k, y);
  const double T = tan(k->a * atan(fabs(g) / (fabs(y.h) + TF_REAL_MIN)));
  return rates(k, y, share * (k->force_0 - k->force_T * T),
               share * copysign(k->moment_T * T, g));
}

// The string at rest on the ground over a length l - sigma of the contact, and
// sliding behind it; Appendix B as the integrals of its two pressures.
static inline point_t string_rates(const model_t *k, point_t y) {
  const double g = rolling(k, y), G = fabs(g), H = fabs(y.h), a = k->half;
  const double reach = k->pressure * G, slope = k->stiffness * H;
  const double longest = 2 * a + k->sigma;
  if (!(H > 0)) return rates(k, y, 0, 0);
  // The distance y = a + sigma - x at which it begins to slide.
  const double end = reach >= slope * longest   ? longest
                     : reach > slope * k->sigma ? reach / slope
                                                : k->sigma;
  const double kt = slope / G, x = a + k->sigma - end;
  double F = k->rho * k->pressure * (x + a);
  double M = k->rho * k->pressure * (a - x) * (a + x) / 2;
  if (end > k->sigma) {
    const double area = (end * end - k->sigma * k->sigma) / 2;
    const double cubes = end * end * end - k->sigma * k->sigma * k->sigma;
    F += kt * area;
    M -= kt * ((a + k->sigma) * area - cubes / 3);
  }
  return rates(k, y, copysign(k->mu * F, y.h),
               k->mu * M * (y.h * g < 0 ? -1 : 1));
}

// Stick: h' = h'_free - A lambda = 0 with M = roll kappa lambda.
typedef struct {
  double A;      // Delassus scalar [1/kg]
  double lambda; // [N]
  point_t rates; // of the sliding motion
} stick_t;

static inline stick_t stick_at(const model_t *k, int roll, point_t y) {
  const double spin =
      (y.r * k->cos + roll * k->kappa) * k->inv_m / (k->beta2 + y.r * y.r);
  point_t dy = rates(k, y, 0, 0);
  stick_t s = {.A = k->sin * k->sin * k->inv_m + k->cos * y.r * spin};
  s.lambda = dy.h / s.A;
  dy.h = 0;
  dy.z += s.lambda * spin;
  s.rates = dy;
  return s;
}

// cppcheck-suppress passedByValue  ; three reals, inlined
static inline point_t contact_rates(const model_t *k, contact_t c, point_t y) {
  if (!k->jumps) return k->string ? string_rates(k, y) : smooth_rates(k, y);
  return c.side ? slip_rates(k, c, y) : stick_at(k, c.roll, y).rates;
}

// The time to h = g = 0 along a straight line; < 0 where it is left.
static inline double time_to_fall(const model_t *k, point_t y, point_t dy) {
  const double g = rolling(k, y);
  return -(y.h * y.h + g * g) / (y.h * dy.h + g * rolling_rate(k, y, dy));
}

// Takes the straight line to h = g = 0 in a time `fall` and picks the
// attracting stick that leaves from there. Returns 0 where there is none.
static inline int capture(const model_t *k, point_t dy, double fall, point_t *y,
                          contact_t *c) {
  y->r += fall * dy.r;
  y->t += fall;
  y->h = y->z = 0;
  for (int roll = -1; roll <= 1; roll += 2) {
    const stick_t s = stick_at(k, roll, *y);
    if (s.A <= 0 || fabs(s.lambda) > k->mu) continue;
    if (roll * rolling_rate(k, *y, s.rates) <= 0) continue;
    *c = (contact_t){0, roll};
    return 1;
  }
  return 0;
}

// A mode ends where its margin falls through 0: slip at h = 0, stick at
// |lambda| = mu, both at g = 0, which in slip is a kink of F.
typedef enum { AT_H, AT_G, AT_LAMBDA, NOWHERE } switch_t;

static inline double margin(const model_t *k, contact_t c, switch_t at,
                            point_t y) {
  if (at == AT_H) return c.side * y.h;
  if (at == AT_G) return c.roll * rolling(k, y);
  return k->mu - fabs(stick_at(k, c.roll, y).lambda);
}

// Goes on from there: from h = 0 in stick, but never in an escaping one
// (A < 0), or in slip to the other side. Returns 0 where nothing is possible.
static inline int change(const model_t *k, switch_t at, contact_t *c,
                         point_t *y) {
  if (at == AT_H) {
    y->h = 0;
    const stick_t s = stick_at(k, c->roll, *y);
    c->side = s.A > 0 && fabs(s.lambda) <= k->mu ? 0 : -c->side;
  } else if (at == AT_LAMBDA) {
    c->side = stick_at(k, c->roll, *y).lambda > 0 ? 1 : -1;
  } else if (c->side) {
    y->z = -y->h * k->cos / y->r;
    c->roll = -c->roll;
  } else {
    y->z = 0;
    return capture(k, (point_t){0, 0, 0, 1}, 0, y, c);
  }
  return 1;
}

// A motion for solvers that find the roots of functions themselves: the
// functions, and what becomes of the motion at a root.
enum { ROOTS = 3 };

typedef struct {
  model_t model;
  contact_t contact;
  double near; // [m/s] of h = g = 0: the rest is a straight line
} motion_t;

static inline motion_t motion_of(const problem_t *problem, double tol) {
  motion_t x = {.model = model_of(problem), .near = sqrt(tol) / 10};
  x.contact = contact_of(&x.model, problem);
  return x;
}

// The margins of g, of h or lambda, and in slip of the way to h = g = 0.
static inline void margins(const motion_t *x, point_t at, double root[ROOTS]) {
  const contact_t c = x->contact;
  root[0] = margin(&x->model, c, AT_G, at);
  root[1] = margin(&x->model, c, c.side ? AT_H : AT_LAMBDA, at);
  root[2] = c.side ? hypot(at.h, root[0]) - x->near : 1;
}

// Goes on from root number i at time *t. Returns 0 where nothing is possible.
static inline int change_at(motion_t *x, int i, double *t, point_t *at) {
  const model_t *k = &x->model;
  contact_t *c = &x->contact;
  if (!c->side || i == 1)
    return change(k, i != 1 ? AT_G : c->side ? AT_H : AT_LAMBDA, c, at);
  const point_t dy = slip_rates(k, *c, *at);
  if (i == 0) {
    // g is 0 to rounding, so that the root may be found twice.
    c->roll = rolling_rate(k, *at, dy) < 0 ? 1 : -1;
    return change(k, AT_G, c, at);
  }
  const double fall = time_to_fall(k, *at, dy);
  if (!(fall > 0)) return 1;
  *t += fall;
  return capture(k, dy, fall, at, c);
}
