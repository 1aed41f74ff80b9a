/* scheme.h - one Moreau step by the equations (1)-(7) of DESIGN.md in long
 * double, with the parameters as they were given. Forces are those of the
 * reference, by its accelerations without friction; what is implicit in the
 * mass matrix, as it is printed there, is the scheme's alone. */
#ifndef TESTS_SUPPORT_SCHEME_H
#define TESTS_SUPPORT_SCHEME_H

#include "common.h"
#include "reference.h"

typedef struct {
  paper_t p;
  real x[3]; /* r, v, w at the start */
  real dt, theta, omega0, alpha, sin, cos, r_t, Q_r, Q_phi, s[2][2], det;
} scheme_step_t;

/* (1)-(5). */
static inline scheme_step_t scheme_step(const tf_params_t *params,
                                        const tf_input_t *u, const real x[3]) {
  scheme_step_t c = {.p = paper_of(params), .x = {x[0], x[1], x[2]}};
  const real v = x[1], w = x[2], m = c.p.m, d = c.p.d;
  c.dt = wide(params->dt);
  c.theta = wide(params->theta);
  c.omega0 = wide(u->omega0);
  c.alpha = wide(u->alpha);
  c.sin = sinl(c.p.gamma);
  c.cos = cosl(c.p.gamma);
  const real t = c.theta * c.dt, a = t * (c.p.c2 + t * c.p.k2);
  c.r_t = x[0] + t * v;
  ref_machine_t q = {PARAMETERS_OF(real, params)};
  q.r0 = wide(u->r0);
  q.omega0 = c.omega0;
  const ref_rate_t free =
      ref_rate(&q, ref_state(&q, c.r_t, v, w), (ref_force_t){0, 0});
  const real inertia = m * (c.p.beta * c.p.beta + c.r_t * c.r_t);
  c.Q_r = m * free.p + wide(u->force);
  c.Q_phi = inertia * free.z - d * m * free.p + wide(u->torque);
  const real e = 2 * t * m * c.r_t * w;
  const real J = inertia + t * (c.p.c1 + 2 * m * c.r_t * v);
  c.s[0][0] = m + a;
  c.s[0][1] = -(m * d + e);
  c.s[1][0] = -(m * d - e);
  c.s[1][1] = J + m * d * d;
  c.det = c.s[0][0] * c.s[1][1] - c.s[0][1] * c.s[1][0];
  return c;
}

/* S (dv, dw) = dt (force, torque). */
static inline void scheme_change(const scheme_step_t *c, real force,
                                 real torque, real d[2]) {
  d[0] = c->dt * (c->s[1][1] * force - c->s[0][1] * torque) / c->det;
  d[1] = c->dt * (c->s[0][0] * torque - c->s[1][0] * force) / c->det;
}

/* The moment of a friction force about the axis. */
static inline real scheme_arm(const scheme_step_t *c) {
  return c->r_t * c->cos - c->p.d * c->sin;
}

/* (7): r, v, w at the end. */
static inline void scheme_end(const scheme_step_t *c, real F, real M,
                              real end[3]) {
  real d[2];
  scheme_change(c, c->Q_r + F * c->sin, c->Q_phi + F * scheme_arm(c) + M, d);
  end[1] = c->x[1] + d[0];
  end[2] = c->x[2] + d[1];
  end[0] = c->x[0] + c->dt * (c->x[1] + c->theta * d[0]);
}

/* h and g of (h) and (g) at some r, v, w, at a share of the step. */
typedef struct {
  real h, g;
} scheme_slip_t;

static inline scheme_slip_t scheme_slip(const scheme_step_t *c, real share,
                                        const real x[3]) {
  const real before = (1 - share) * c->dt * c->alpha;
  const real z = x[2] - (c->omega0 - before), e = x[1] - c->p.d * z;
  return (scheme_slip_t){-e * c->sin - x[0] * z * c->cos,
                         x[0] * z * c->sin - e * c->cos};
}

#endif
