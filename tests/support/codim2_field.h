/* codim2_field.h - the field of slip at h = g = 0 by the paper's law: how fast
 * a slip of a given direction rotates and grows there. */
#ifndef TESTS_SUPPORT_CODIM2_FIELD_H
#define TESTS_SUPPORT_CODIM2_FIELD_H

#include "friction/codim2.h"
#include "sample.h"

#define STICKS (TF_MODE_BIT(TF_STICK_PLUS) | TF_MODE_BIT(TF_STICK_MINUS))

/* The accelerations of h and g at h = g = 0: without friction, by F = 1 N and
 * by M = 1 N m. */
typedef struct {
  paper_t paper;
  real h[3], g[3];
} field_t;

/* A machine at h = g = 0, and the field there by the paper and by the core. */
typedef struct {
  tf_params_t params;
  tf_machine_t k;
  tf_input_t u;
  tf_real_t r;
  field_t at;
  codim2_field_t field;
} place_t;

/* At a speed of the turntable, under its acceleration and the loads of the
 * input: the paper has none, they act by the inverse mass matrix. */
static inline field_t field_at(const tf_params_t *params, const tf_input_t *u,
                               tf_real_t r, real omega0) {
  field_t at = {.paper = paper_of(params)};
  at.paper.omega0 = omega0;
  const real x[3] = {wide(r), 0, omega0}, alpha = wide(u->alpha);
  const real Q_r = wide(u->force), beta = at.paper.beta;
  const real Q_phi = wide(u->torque) + at.paper.d * Q_r;
  const real by_mass = 1 / (at.paper.m * (beta * beta + x[0] * x[0]));
  real h_x[3], g_x[3];
  paper_h_x(&at.paper, x, h_x);
  paper_g_x(&at.paper, x, g_x);
  for (int by = 0; by < 3; by++) {
    real dx[3];
    paper_rhs_time(&at.paper, x, by == 1, by == 2, dx);
    dx[1] += Q_r / at.paper.m + by_mass * at.paper.d * Q_phi;
    dx[2] += by_mass * Q_phi - alpha;
    for (int i = 0; i < 3; i++) {
      at.h[by] += h_x[i] * dx[i];
      at.g[by] += g_x[i] * dx[i];
    }
    if (by == 0) continue;
    at.h[by] -= at.h[0];
    at.g[by] -= at.g[0];
  }
  return at;
}

/* How fast g grows in the stick on one side of g = 0. */
static inline real stick_growth(const field_t *at, int roll) {
  const real moment = (real)roll * at->paper.kappa;
  const real lambda = -at->h[0] / (at->h[1] + moment * at->h[2]);
  return (real)roll * (at->g[0] + lambda * (at->g[1] + moment * at->g[2]));
}

/* Slip of 1 m/s at an angle from the h axis of one side: the rate of that angle
 * [rad/s] and of the length of the slip [m/s^2]. */
typedef struct {
  real rotation, growth;
} slip_rate_t;

static inline slip_rate_t slip_rate_at(const field_t *at, int side,
                                       real angle) {
  const real h = (real)side * cosl(angle), g = sinl(angle);
  real F, M;
  paper_friction(&at->paper, h, g, &F, &M);
  const real dh = at->h[0] + F * at->h[1] + M * at->h[2];
  const real dg = at->g[0] + F * at->g[1] + M * at->g[2];
  return (slip_rate_t){(real)side * (dg * h - dh * g), dh * h + dg * g};
}

/* Some of the machines as in the other tests, most of extreme shapes, where two
 * directions of one kind are more often close to each other. */
static inline tf_params_t any_params(int n) {
  tf_params_t params = random_params();
  params.omega0 = uniform(-2, 2);
  if (n % 4 == 0) return params;
  params.kappa = uniform(0.5, 20);
  params.beta = uniform(0.001, 0.5);
  params.d = uniform(-5, 5);
  return params;
}

#endif
