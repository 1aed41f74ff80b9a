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
#include <tgmath.h>

#include "bench/problem.h"

#ifdef PEER_LONG
typedef long double real_t;
#else
typedef tf_real_t real_t;
#endif

// Whether the law jumps. Peers that are timed know it when they are compiled.
#ifdef PEER_JUMPS
#define JUMPS(k) PEER_JUMPS
#else
#define JUMPS(k) ((k)->jumps)
#endif

typedef struct {
  real_t r; // [m]
  real_t h; // [m/s]
  real_t z; // [rad/s]
  real_t t; // [s], for the speed of the turntable
} point_t;

// As four numbers, as libraries have it.
static inline point_t point_of(const double *y) {
  return (point_t){(real_t)y[0], (real_t)y[1], (real_t)y[2], (real_t)y[3]};
}

static inline void point_to(point_t y, double *to) {
  to[0] = (double)y.r;
  to[1] = (double)y.h;
  to[2] = (double)y.z;
  to[3] = (double)y.t;
}

// side: sign of h, 0 in stick. roll: sign of g. Both are frozen over a step,
// so that a step past a switch goes on in the same smooth field.
typedef struct {
  int side, roll;
} contact_t;

typedef struct {
  real_t d, k2, c1, c2, r0, omega0, alpha, m, inv_m, beta2, sin, cos, inv_sin;
  real_t mu, kappa;
  real_t a;       // T(y) = tan(a atan y)
  real_t quarter; // a pi / 2
  real_t force_0, force_T, moment_T;
  real_t epsilon2; // of the smoothed law
  // Appendix B: k, delta, sigma, rho and a, of the string.
  real_t stiffness, pressure, sigma, rho, half;
  int jumps;  // or the law is one field, smooth or
  int string; // string
} model_t;

static inline model_t model_of(const problem_t *problem) {
  const tf_params_t *p = &problem->params;
  const real_t half_pi = (real_t)1.57079632679489661923132169163975144L;
  const real_t kappa = (real_t)p->kappa, mu = (real_t)p->mu;
  const real_t beta = (real_t)p->beta, gamma = (real_t)p->gamma;
  model_t k = {.d = (real_t)p->d, .k2 = (real_t)p->k2, .c1 = (real_t)p->c1};
  k.c2 = (real_t)p->c2;
  k.r0 = (real_t)p->r0;
  k.omega0 = (real_t)p->omega0;
  k.alpha = (real_t)problem->alpha;
  k.m = (real_t)p->m;
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
  k.epsilon2 = (real_t)p->epsilon * (real_t)p->epsilon;
  k.stiffness = (real_t)p->k;
  k.pressure = (real_t)p->delta;
  k.sigma = (real_t)p->sigma;
  k.rho = (real_t)p->rho;
  k.half = (real_t)p->a;
  k.jumps = p->law == TF_TYRE_JUMP;
  k.string = p->law == TF_TYRE_STRING;
  return k;
}

static inline point_t model_start(const model_t *k, const problem_t *problem) {
  return (point_t){(real_t)problem->start[0], (real_t)problem->h,
                   (real_t)problem->start[2] - k->omega0, 0};
}

static inline real_t rolling(const model_t *k, point_t y) {
  return (y.r * y.z + y.h * k->cos) * k->inv_sin;
}

// d/dt of rolling().
static inline real_t rolling_rate(const model_t *k, point_t y, point_t dy) {
  return (dy.r * y.z + y.r * dy.z + dy.h * k->cos) * k->inv_sin;
}

static inline void model_end(const model_t *k, point_t y, double x[3]) {
  const real_t p = -(y.h + y.r * y.z * k->cos) * k->inv_sin;
  x[0] = (double)y.r;
  x[1] = (double)(p + k->d * y.z);
  x[2] = (double)(y.z + k->omega0 + k->alpha * y.t);
}

// m (p' - d alpha) = Q_r + F sin,
// m (beta^2 + r^2) (z' + alpha) = Q_phi + d Q_r + F r cos + M.
static inline point_t rates(const model_t *k, point_t y, real_t F, real_t M) {
  const real_t p = -(y.h + y.r * y.z * k->cos) * k->inv_sin;
  const real_t v = p + k->d * y.z, w = y.z + k->omega0 + k->alpha * y.t;
  const real_t mrw = k->m * y.r * w;
  const real_t Q_r = k->k2 * (k->r0 - y.r) - k->c2 * v + mrw * w;
  const real_t Q_phi = -k->c1 * w - 2 * mrw * v;
  const real_t dz = (Q_phi + k->d * Q_r + F * y.r * k->cos + M) * k->inv_m /
                        (k->beta2 + y.r * y.r) -
                    k->alpha;
  const real_t dp = (Q_r + F * k->sin) * k->inv_m + k->d * k->alpha;
  return (point_t){v, -k->sin * dp - k->cos * (v * y.z + y.r * dz), dz, 1};
}

// T = tan(a (pi/2 - angle)), angle = arctan(H / G), in the form that stays
// smooth where the frozen signs let H or G become negative.
static inline point_t slip_rates(const model_t *k, contact_t c, point_t y) {
  const real_t side = (real_t)c.side, roll = (real_t)c.roll;
  const real_t H = side * y.h, G = roll * rolling(k, y);
  const real_t T =
      tan(G > H ? k->quarter - k->a * atan(H / G) : k->a * atan(G / H));
  return rates(k, y, side * (k->force_0 - k->force_T * T),
               side * roll * k->moment_T * T);
}

// The law with sign(h) smoothed to h / sqrt(h^2 + epsilon^2). The quotient is 0
// at g = h = 0 and infinite nowhere where it matters.
// cppcheck-suppress passedByValue  ; four reals, inlined
static inline point_t smooth_rates(const model_t *k, contact_t c, point_t y) {
  (void)c;
  const real_t share = y.h / sqrt(y.h * y.h + k->epsilon2);
  const real_t g = rolling(k, y);
  const real_t T =
      tan(k->a * atan(fabs(g) / (fabs(y.h) + (real_t)TF_REAL_MIN)));
  return rates(k, y, share * (k->force_0 - k->force_T * T),
               share * copysign(k->moment_T * T, g));
}

// The string at rest on the ground over a length l - sigma of the contact, and
// sliding behind it; Appendix B as the integrals of its two pressures.
static inline point_t string_rates(const model_t *k, point_t y) {
  const real_t g = rolling(k, y), G = fabs(g), H = fabs(y.h), a = k->half;
  const real_t reach = k->pressure * G, slope = k->stiffness * H;
  const real_t longest = 2 * a + k->sigma;
  if (!(H > 0)) return rates(k, y, 0, 0);
  // The distance y = a + sigma - x at which it begins to slide.
  const real_t end = reach >= slope * longest   ? longest
                     : reach > slope * k->sigma ? reach / slope
                                                : k->sigma;
  const real_t kt = slope / G, x = a + k->sigma - end;
  real_t F = k->rho * k->pressure * (x + a);
  real_t M = k->rho * k->pressure * (a - x) * (a + x) / 2;
  if (end > k->sigma) {
    const real_t area = (end * end - k->sigma * k->sigma) / 2;
    const real_t cubes = end * end * end - k->sigma * k->sigma * k->sigma;
    F += kt * area;
    M -= kt * ((a + k->sigma) * area - cubes / 3);
  }
  return rates(k, y, copysign(k->mu * F, y.h),
               k->mu * M * (y.h * g < 0 ? -1 : 1));
}

// Stick: h' = h'_free - A lambda = 0 with M = roll kappa lambda.
typedef struct {
  real_t A;      // Delassus scalar [1/kg]
  real_t lambda; // [N]
  point_t rates; // of the sliding motion
} stick_t;

static inline stick_t stick_at(const model_t *k, int roll, point_t y) {
  const real_t spin = (y.r * k->cos + (real_t)roll * k->kappa) * k->inv_m /
                      (k->beta2 + y.r * y.r);
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
  if (!JUMPS(k)) return k->string ? string_rates(k, y) : smooth_rates(k, c, y);
  return c.side ? slip_rates(k, c, y) : stick_at(k, c.roll, y).rates;
}

// The time to h = g = 0 along a straight line; < 0 where it is left.
static inline real_t time_to_fall(const model_t *k, point_t y, point_t dy) {
  const real_t g = rolling(k, y);
  return -(y.h * y.h + g * g) / (y.h * dy.h + g * rolling_rate(k, y, dy));
}

// Takes the straight line to h = g = 0 in a time `fall` and picks the
// attracting stick that leaves from there. Returns 0 where there is none.
static inline int capture(const model_t *k, point_t dy, real_t fall, point_t *y,
                          contact_t *c) {
  y->r += fall * dy.r;
  y->t += fall;
  y->h = y->z = 0;
  for (int roll = -1; roll <= 1; roll += 2) {
    const stick_t s = stick_at(k, roll, *y);
    if (s.A <= 0 || fabs(s.lambda) > k->mu) continue;
    if ((real_t)roll * rolling_rate(k, *y, s.rates) <= 0) continue;
    *c = (contact_t){0, roll};
    return 1;
  }
  return 0;
}

// A mode ends where its margin falls through 0: slip at h = 0, stick at
// |lambda| = mu, both at g = 0, which in slip is a kink of F.
typedef enum { AT_H, AT_G, AT_LAMBDA, NOWHERE } switch_t;

static inline real_t margin(const model_t *k, contact_t c, switch_t at,
                            point_t y) {
  if (at == AT_H) return (real_t)c.side * y.h;
  if (at == AT_G) return (real_t)c.roll * rolling(k, y);
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
