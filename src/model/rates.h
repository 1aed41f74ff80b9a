// Accelerations at an instant. In (p, q), p = v - d z, q = r z, z = w - omega0:
//   m p' = Q_r + F sin(gamma) + m d alpha
//   J z' = Q_phi + d Q_r + F r cos(gamma) + M - J alpha,  q' = r z' + v z
// On h = 0 with F = lambda, M = s kappa lambda:  h' = N - A(s) lambda.
#ifndef TF_RATES_H
#define TF_RATES_H

#include "mechanics.h"

typedef struct {
  tf_real_t p, q;     // p', q' without friction [m/s^2]
  tf_real_t z;        // z' without friction [rad/s^2]
  tf_real_t Fp, Fq;   // of F = 1 N
  tf_real_t Mq;       // of M = 1 N m
  tf_real_t N;        // h' without friction [m/s^2]
  tf_real_t A[2];     // Delassus scalar for s = +1, -1 [1/kg]
  tf_real_t vz, rz;   // bounds of the two parts of q', v z and r z' [m/s^2]
  tf_force_t pinning; // holds the wheel at rest; TF_REAL_MAX where none
} rates_t;

TF_INLINE rates_t rates_at(const tf_machine_t *k, const tf_input_t *input,
                           tf_real_t r, tf_real_t p, tf_real_t z,
                           tf_real_t omega) {
  const tf_real_t v = p + k->d * z, w = z + omega, mr = k->m * r;
  const tf_real_t Q_r = radial_force(k, input, r, v, mr * w * w);
  const tf_real_t Q_phi = disc_torque(k, input, w, 2 * mr * v * w);
  const tf_real_t J = inertia_at(k, r);
  const tf_real_t arm = r * k->cos_gamma, alpha = input->alpha;
  const tf_real_t p_rate = Q_r / k->m + k->d * alpha;
  const tf_real_t z_rate = (Q_phi + k->d * Q_r) / J - alpha;
  rates_t a;
  a.p = p_rate;
  a.z = z_rate;
  a.q = r * z_rate + v * z;
  a.Fp = k->sin_gamma / k->m;
  a.Fq = r * arm / J;
  a.Mq = r / J;
  a.N = -a.p * k->sin_gamma - a.q * k->cos_gamma;
  for (int s = 0; s < 2; s++) a.A[s] = delassus_at(k, arm, s, J);
  a.vz = magnitude(v * z);
  a.rz = magnitude(r) * (magnitude(z_rate) +
                         k->tyre.mu * (magnitude(arm) + k->stick_kappa) / J);
  // Larger than any mu where the disc already turns against the turntable, and
  // with sin gamma = 0, where friction cannot keep the slider from moving.
  a.pinning.F =
      z != 0 || k->sin_gamma == 0 ? TF_REAL_MAX : -p_rate * k->m / k->sin_gamma;
  a.pinning.M = -z_rate * J - a.pinning.F * arm;
  return a;
}

#endif
