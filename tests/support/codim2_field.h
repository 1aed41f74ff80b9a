/* codim2_field.h - the field of slip at h = g = 0 by the paper's law: how fast
 * a slip of a given direction rotates and grows there. */
#ifndef TESTS_SUPPORT_CODIM2_FIELD_H
#define TESTS_SUPPORT_CODIM2_FIELD_H

#include "friction/codim2.h"
#include "sample.h"

#define STICKS (TF_MODE_BIT(TF_STICK_PLUS) | TF_MODE_BIT(TF_STICK_MINUS))

/* The accelerations of h and g at h = g = 0, under the loads of the machine:
 * without friction, by F = 1 N and by M = 1 N m. */
typedef struct {
  paper_t paper;
  real h[3], g[3];
} field_t;

static inline field_t field_at(const tf_params_t *params, const tf_input_t *u,
                               tf_real_t r) {
  field_t at = {.paper = paper_of(params)};
  /* The paper has no loads: one by the spring, the other by its damper. */
  at.paper.r0 += wide(u->force) / at.paper.k2;
  at.paper.c1 -= wide(u->torque) / at.paper.omega0;
  const real x[3] = {wide(r), 0, at.paper.omega0};
  real h_x[3], g_x[3];
  paper_h_x(&at.paper, x, h_x);
  paper_g_x(&at.paper, x, g_x);
  for (int by = 0; by < 3; by++) {
    real dx[3];
    paper_rhs_time(&at.paper, x, by == 1, by == 2, dx);
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

/* The angle along which slip leaves, from its T = cot(psi). */
static inline real angle_of(const field_t *at, real T, int roll) {
  return (real)roll * (PAPER_PI / 2) * atanl(T) / atanl(6 * at->paper.kappa);
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
