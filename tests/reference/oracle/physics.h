// The machine and its tyre laws, written down anew from the equations of the
// paper (with its errata) in the velocities p = v - d z, z = w - omega0(t).
#ifndef ORACLE_PHYSICS_H
#define ORACLE_PHYSICS_H

#include "number.h"

typedef enum { JUMP, COULOMB, NONE, SMOOTH, STRING } law_t;

typedef struct {
  real t, omega0;
} knot_t;

enum { KNOTS = 8, PARAMETERS = 17 };

typedef struct {
  real m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma, epsilon;
  real k, delta, sigma, rho, a; // of the string
  law_t law;
  int knots;
  knot_t knot[KNOTS];
  // derived
  real s, c;  // sin, cos of gamma
  real share; // a of T(y) = tan(a atan y)
} machine_t;

void machine_derive(machine_t *p);

// The turntable between two knots: omega0 = base + slope (t - since).
typedef struct {
  real since, base, slope, until; // until: the next knot or a huge number
} ramp_t;

ramp_t ramp_at(const machine_t *p, real t);
real ramp_omega(const ramp_t *ramp, real t);

// Which smooth piece of the law: signs of h and g, zone of the string. A piece
// goes on analytically beyond its borders, so that a step may overshoot them.
typedef struct {
  int side, roll, zone; // zone: 0 no slip, 1 partial, 2 full
} piece_t;

typedef struct {
  real F, M;
} force_t;

int zone_of(const machine_t *p, real h, real g);
force_t force_of(const machine_t *p, const piece_t *piece, real h, real g);

typedef struct {
  real r, p, z, t;
} motion_t;

typedef struct {
  real v, dp, dz, dh, dg;
} rates_t;

void slip_of(const machine_t *p, const motion_t *x, real *h, real *g);
// The motion with given r and slip; needs r != 0.
motion_t motion_of(const machine_t *p, real r, real h, real g, real t);
rates_t rates_of(const machine_t *p, const ramp_t *ramp, const motion_t *x,
                 force_t f);
// On h = 0, roll s: J A, J N with J = m (beta^2 + r^2), h' = N - A lambda, and
// the answers of v, g to lambda.
typedef struct {
  real J, JA, JN;
  rates_t free;  // without friction
  real g_lambda; // dg'/dlambda
} stick_t;
stick_t stick_of(const machine_t *p, const ramp_t *ramp, const motion_t *x,
                 int roll);

#endif
