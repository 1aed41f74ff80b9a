// Accelerations at an instant. In (p, q), p = v - d z, q = r z, z = w - omega0:
//   m p' = Q_r + F sin(gamma) + m d alpha
//   J z' = Q_phi + d Q_r + F r cos(gamma) + M - J alpha,  q' = r z' + v z
// On h = 0 with F = lambda, M = s kappa lambda:  h' = N - A(s) lambda.
#ifndef TF_RATES_H
#define TF_RATES_H

#include "mechanics.h"

typedef struct {
  tf_real_t dp, dq;   // p', q' without friction [m/s^2]
  tf_real_t dz;       // z' without friction [rad/s^2]
  tf_real_t Fp, Fq;   // of F = 1 N
  tf_real_t Mq;       // of M = 1 N m
  tf_real_t N;        // h' without friction [m/s^2]
  tf_real_t A[2];     // Delassus scalar, by the sign of g [1/kg]
  tf_real_t vz, rz;   // bounds of the two parts of q', v z and r z' [m/s^2]
  tf_force_t pinning; // holds the wheel at rest; TF_REAL_MAX where none
} rates_t;

TF_INLINE rates_t rates_at(const tf_machine_t *k, const tf_input_t *input,
                           tf_real_t r, tf_real_t p, tf_real_t z,
                           tf_real_t omega) {
  const tf_real_t v = slider_velocity(k, p, z), w = z + omega, mr = k->m * r;
  const tf_real_t Q_r = radial_force(k, input, r, v, mr * w * w);
  const tf_real_t Q_phi = disc_torque(k, input, w, 2 * mr * v * w);
  const tf_real_t J = inertia_at(k, r);
  const tf_real_t arm = r * k->cos_gamma, alpha = input->alpha;
  const tf_real_t p_rate = Q_r / k->m + k->d * alpha;
  const tf_real_t z_rate = (Q_phi + k->d * Q_r) / J - alpha;
  rates_t a;
  a.dp = p_rate;
  a.dz = z_rate;
  a.dq = r * z_rate + v * z;
  a.Fp = k->sin_gamma / k->m;
  a.Fq = r * arm / J;
  a.Mq = r / J;
  a.N = slip_from_pq(k, a.dp, a.dq).h;
  a.A[PLUS] = delassus_at(k, arm, PLUS, J);
  a.A[MINUS] = delassus_at(k, arm, MINUS, J);
  a.vz = magnitude(v * z);
  a.rz = magnitude(r) *
         (magnitude(z_rate) +
          k->contact.tyre.mu * (magnitude(arm) + k->contact.stick_kappa) / J);
  // Larger than any mu where the disc already turns against the turntable, and
  // with sin gamma = 0, where friction cannot keep the slider from moving.
  a.pinning.F =
      z != 0 || k->sin_gamma == 0 ? TF_REAL_MAX : -p_rate * k->m / k->sin_gamma;
  a.pinning.M = -z_rate * J - a.pinning.F * arm;
  return a;
}

// (slidCond): h' next to h = 0 in slip+ and in slip-, by the sign of g.
typedef struct {
  tf_real_t plus, minus;
} slip_limits_t;

TF_INLINE slip_limits_t slip_limits(const tf_machine_t *k, const rates_t *a,
                                    sign_t s) {
  const tf_real_t Amu = a->A[s] * k->contact.tyre.mu;
  return (slip_limits_t){a->N - Amu, a->N + Amu};
}

// Whether both slips lead to h = 0, so that stick alone is consistent there:
// |N| < A mu.
TF_INLINE bool is_sliding(slip_limits_t h_rate) {
  return (h_rate.plus < 0) & (h_rate.minus > 0);
}

// The multiplier that keeps h at 0, as far as the law of stick has it, by the
// sign of g; its A is not 0.
TF_INLINE tf_real_t stick_lambda(const tf_machine_t *k, const rates_t *a,
                                 sign_t s) {
  return clip(a->N / a->A[s], -k->contact.tyre.mu, k->contact.tyre.mu);
}

#endif
