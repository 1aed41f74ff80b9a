// What a good engineer writes without this project: constants hoisted, one
// division by the inertia, one square root and two tangents an evaluation, no
// branches, all in registers.
#include "rk4_smooth.h"

#include <float.h>
#include <math.h>

#ifdef TF_REAL_FLOAT
#define TAN tanf
#define ATAN atanf
#define SQRT sqrtf
#define FABS fabsf
#define COPYSIGN copysignf
#define SMALLEST FLT_MIN
#else
#define TAN tan
#define ATAN atan
#define SQRT sqrt
#define FABS fabs
#define COPYSIGN copysign
#define SMALLEST DBL_MIN
#endif

rk4_smooth_t rk4_smooth_prepare(const tf_params_t *p) {
  const double kappa = (double)p->kappa, gamma = (double)p->gamma;
  const double half_pi = 1.57079632679489661923;
  return (rk4_smooth_t){.d = p->d,
                        .k2 = p->k2,
                        .c1 = p->c1,
                        .c2 = p->c2,
                        .r0 = p->r0,
                        .omega0 = p->omega0,
                        .m = p->m,
                        .inv_m = 1 / p->m,
                        .beta2 = p->beta * p->beta,
                        .sin_gamma = (tf_real_t)sin(gamma),
                        .cos_gamma = (tf_real_t)cos(gamma),
                        .a = (tf_real_t)(atan(6 * kappa) / half_pi),
                        .force_0 = 4 * p->mu / 3,
                        .force_T = p->mu / (18 * p->kappa),
                        .moment_T = p->mu / 6,
                        .epsilon2 = p->epsilon * p->epsilon,
                        .dt = p->dt,
                        .half = p->dt / 2,
                        .sixth = p->dt / 6};
}

// With p = v - d (w - omega0) the mass matrix is diagonal:
//   m p' = Q_r + F sin(gamma)
//   m (beta^2 + r^2) w' = Q_phi + d Q_r + F r cos(gamma) + M
// G / (H + SMALLEST) is 0 at G = H = 0 and infinite nowhere where it matters.
static inline rk4_state_t rates(const rk4_smooth_t *k, rk4_state_t x) {
  const tf_real_t z = x.w - k->omega0;
  const tf_real_t p = x.v - k->d * z, q = x.r * z;
  const tf_real_t h = -p * k->sin_gamma - q * k->cos_gamma;
  const tf_real_t g = q * k->sin_gamma - p * k->cos_gamma;
  const tf_real_t share = h / SQRT(h * h + k->epsilon2);
  const tf_real_t y = FABS(g) / (FABS(h) + SMALLEST);
  const tf_real_t T = TAN(k->a * ATAN(y));
  const tf_real_t F = share * (k->force_0 - k->force_T * T);
  const tf_real_t M = share * COPYSIGN(k->moment_T * T, g);
  const tf_real_t mrw = k->m * x.r * x.w;
  const tf_real_t Q_r = k->k2 * (k->r0 - x.r) - k->c2 * x.v + mrw * x.w;
  const tf_real_t Q_phi = -k->c1 * x.w - 2 * mrw * x.v;
  const tf_real_t dw = (Q_phi + k->d * Q_r + F * x.r * k->cos_gamma + M) *
                       k->inv_m / (k->beta2 + x.r * x.r);
  const tf_real_t dp = (Q_r + F * k->sin_gamma) * k->inv_m;
  return (rk4_state_t){x.v, dp + k->d * dw, dw};
}

static inline rk4_state_t ahead(rk4_state_t x, tf_real_t t, rk4_state_t dx) {
  return (rk4_state_t){x.r + t * dx.r, x.v + t * dx.v, x.w + t * dx.w};
}

void rk4_smooth_step(const rk4_smooth_t *k, rk4_state_t *state) {
  const rk4_state_t x = *state;
  const rk4_state_t k1 = rates(k, x);
  const rk4_state_t k2 = rates(k, ahead(x, k->half, k1));
  const rk4_state_t k3 = rates(k, ahead(x, k->half, k2));
  const rk4_state_t k4 = rates(k, ahead(x, k->dt, k3));
  state->r = x.r + k->sixth * (k1.r + 2 * (k2.r + k3.r) + k4.r);
  state->v = x.v + k->sixth * (k1.v + 2 * (k2.v + k3.v) + k4.v);
  state->w = x.w + k->sixth * (k1.w + 2 * (k2.w + k3.w) + k4.w);
}
