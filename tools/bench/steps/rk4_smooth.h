/// @file
/// The usual way to simulate this machine, for comparison: friction smoothed
/// over epsilon, libm's tangents, classical Runge-Kutta of order four.
#ifndef TWOFOLD_BENCH_RK4_SMOOTH_H
#define TWOFOLD_BENCH_RK4_SMOOTH_H

#include "twofold/machine.h"

/// Constants of one machine, so that no step computes them again.
typedef struct {
  tf_real_t d, k2, c1, c2, r0, omega0, m, inv_m;
  tf_real_t beta2; // beta^2 [m^2]
  tf_real_t sin_gamma, cos_gamma;
  tf_real_t a;               // T(y) = tan(a atan y)
  tf_real_t force_0;         // 4 mu / 3 [N]
  tf_real_t force_T;         // mu / (18 kappa) [N]
  tf_real_t moment_T;        // mu / 6 [N]
  tf_real_t epsilon2;        // epsilon^2 [m^2/s^2]
  tf_real_t dt, half, sixth; // dt, dt / 2, dt / 6 [s]
} rk4_smooth_t;

/// r [m], v [m/s], w [rad/s].
typedef struct {
  tf_real_t r, v, w;
} rk4_state_t;

rk4_smooth_t rk4_smooth_prepare(const tf_params_t *p);

/// Advances by dt.
void rk4_smooth_step(const rk4_smooth_t *k, rk4_state_t *state);

#endif
