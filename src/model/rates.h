// Accelerations at an instant. In (p, q), p = v - d z, q = r z, z = w - omega0:
//   m p' = Q_r + F sin(gamma) + m d alpha
//   J z' = Q_phi + d Q_r + F r cos(gamma) + M - J alpha,  q' = r z' + v z
// On h = 0 with F = lambda, M = s kappa lambda:  h' = N - A(s) lambda.
#ifndef TF_RATES_H
#define TF_RATES_H

#include "../friction/codim2.h"
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

#define tf_rates_at TF_LINK(tf_rates_at)
TF_API rates_t tf_rates_at(const tf_machine_t *k, const tf_input_t *input,
                           tf_real_t r, tf_real_t p, tf_real_t z,
                           tf_real_t omega);

// (slidCond): h' next to h = 0 in slip+ and in slip-, by the sign of g.
typedef struct {
  tf_real_t plus, minus;
} slip_limits_t;

TF_INLINE slip_limits_t slip_limits(const tf_machine_t *k, const rates_t *a,
                                    sign_t s) {
  const tf_real_t Amu = a->A[s] * k->contact.tyre.mu;
  return (slip_limits_t){a->N - Amu, a->N + Amu};
}

// The multiplier that keeps h at 0, as far as the law of stick has it, by the
// sign of g; its A is not 0.
TF_INLINE tf_real_t stick_lambda(const tf_machine_t *k, const rates_t *a,
                                 sign_t s) {
  return clip(a->N / a->A[s], -k->contact.tyre.mu, k->contact.tyre.mu);
}

// The law of the contact at an instant of the machine: the modes that are
// consistent on the surface h = 0, and the field at h = g = 0.

// h = g = 0 means p = 0 and r z = 0: the wheel turns with the turntable, or the
// slider passes the axis. Set to 0 is whichever of z and r changes r z now.
TF_INLINE void place_at_codim2(const rates_t *now, tf_real_t *r, tf_real_t *z) {
  if (now->vz > now->rz)
    *r = 0;
  else
    *z = 0;
}

// How h and g change at h = g = 0, at an instant.
#define tf_codim2_field_of TF_LINK(tf_codim2_field_of)
TF_API codim2_field_t tf_codim2_field_of(const tf_machine_t *k,
                                         const rates_t *rates);

// g' in the stick with one sign of g, under lambda.
TF_INLINE tf_real_t g_rate_in_stick(const tf_machine_t *k, const rates_t *a,
                                    sign_t s, tf_real_t lambda) {
  const tf_real_t moment = signed_kappa(k, s) * lambda;
  return slip_from_pq(k, a->dp + lambda * a->Fp,
                      a->dq + lambda * a->Fq + moment * a->Mq)
      .g;
}

// The regions of h = 0 at g != 0: both slips lead to it (stick alone is
// consistent), both lead away (all three are), or one crosses it.
TF_INLINE void surface_modes(const tf_machine_t *k, const rates_t *a, sign_t s,
                             consistent_modes_t *out) {
  const slip_limits_t h_rate = slip_limits(k, a, s);
  const bool plus = h_rate.plus > 0, minus = h_rate.minus < 0;
  const unsigned stick = stick_with(s);
  tf_contact_modes_t *solutions = &out->solutions;
  *out = (consistent_modes_t){.lambda = {0, 0}};
  solutions->set = (uint8_t)(plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS);
  solutions->near_stick = (uint8_t)stick;
  solutions->departure[0] = h_rate.plus;
  solutions->departure[1] = h_rate.minus;
  if (a->A[s] > 0) solutions->attracting = (uint8_t)TF_MODE_BIT(stick);
  if (plus != minus) return;
  solutions->set |= (uint8_t)TF_MODE_BIT(stick);
  // A = 0 is the vertical line of a two-fold: any lambda, 0 the smallest.
  if (a->A[s] != 0) out->lambda[s] = stick_lambda(k, a, s);
}

// A wheel at rest on a turntable that changes its speed: the force that holds
// it, and when the rest ends.

// No term of the force at rest is beyond those of w^2.
#define REST_ORDER 2

// The force and the moment of a wheel at rest, as polynomials in time.
typedef struct {
  const tf_machine_t *machine;
  const tf_input_t *input;
  tf_real_t r, omega;  // omega: of the turntable at time 0
  tf_real_t inverse_m; // 1 / m
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2))
  tf_real_t arm;       // r cos(gamma)
  tf_real_t F[REST_ORDER + 1], M[REST_ORDER + 1];
} rest_motion_t;

#define tf_rest_motion TF_LINK(tf_rest_motion)
TF_API rest_motion_t tf_rest_motion(const tf_machine_t *k, const tf_input_t *u,
                                    tf_real_t r, tf_real_t omega);

// Whether something ends the rest within a time, which then becomes that of the
// first: it leaves its law, an attracting stick begins, or the slip does that
// the exit rule names.
#define tf_rest_ends TF_LINK(tf_rest_ends)
TF_API bool tf_rest_ends(const rest_motion_t *rest, tf_real_t *time);

// Whether within a time the rest leaves its law or an attracting stick is
// consistent, but not any more at its end: a look at the end misses it.
#define tf_rest_is_interrupted TF_LINK(tf_rest_is_interrupted)
TF_API bool tf_rest_is_interrupted(const rest_motion_t *rest, tf_real_t time);

#endif
