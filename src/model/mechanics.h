// Kinematics: slip speeds of the wheel, and the range of states.
#ifndef TF_MECHANICS_H
#define TF_MECHANICS_H

#include "../friction/mode_set.h"
#include "../num/kernel.h"
#include "../num/pair.h"
#include "twofold/machine.h"

// Where a step begins or ends.
typedef struct {
  tf_real_t r, v, w;
} end_state_t;

// p = v - d z, the speed along the slider that the slip sees.
TF_INLINE tf_real_t slider_speed(const tf_machine_t *k, tf_real_t v,
                                 tf_real_t z) {
  return v - k->d * z;
}

// P = v - d w, the same seen from the ground: the kinetic energy has m P^2/2.
TF_INLINE tf_real_t ground_speed(const tf_machine_t *k, tf_real_t v,
                                 tf_real_t w) {
  return v - k->d * w;
}

// By how much the turntable turns faster after some time of a step. A build for
// one scene whose turntable is steady defines this as 0 (port/core.h).
#ifndef TF_STEP_TURN
#define TF_STEP_TURN(u, time) ((u)->alpha * (time))
#endif

// Its gain over the step, and over what follows the theta point; its speed at
// that point. omega0 of the inputs is that at the end.
TF_INLINE tf_real_t turn_of_step(const tf_machine_t *k, const tf_input_t *u) {
  return TF_STEP_TURN(u, k->dt);
}

TF_INLINE tf_real_t turn_after_theta(const tf_machine_t *k,
                                     const tf_input_t *u) {
  return TF_STEP_TURN(u, k->explicit_dt);
}

TF_INLINE tf_real_t speed_at_theta(const tf_machine_t *k, const tf_input_t *u) {
  return u->omega0 - turn_after_theta(k, u);
}

// v from p and z, or from P and w.
TF_INLINE tf_real_t slider_velocity(const tf_machine_t *k, tf_real_t p,
                                    tf_real_t z) {
  return p + k->d * z;
}

// (h), (g): the slip is (p, q) rotated by gamma, with q = r z.
TF_INLINE tf_slip_t slip_from_pq(const tf_machine_t *k, tf_real_t p,
                                 tf_real_t q) {
  return (tf_slip_t){p * k->minus_sin_gamma - q * k->cos_gamma,
                     q * k->sin_gamma - p * k->cos_gamma};
}

TF_INLINE tf_slip_t slip_speeds(const tf_machine_t *k, tf_real_t r, tf_real_t v,
                                tf_real_t z) {
  return slip_from_pq(k, slider_speed(k, v, z), r * z);
}

// What the terms of h and g amount to without their signs [m/s].
TF_INLINE tf_real_t slip_terms(const tf_machine_t *k, tf_real_t r, tf_real_t v,
                               tf_real_t w, tf_real_t omega0) {
  return magnitude(v) +
         (magnitude(k->d) + magnitude(r)) * (magnitude(w) + magnitude(omega0));
}

// What rounding makes of h and g at a state: below it they count as 0. With u =
// epsilon/2, and a step that moves v and w by no more than their size,
//   w and omega0 are off by u |w| and u |omega0|, and v by u |v|;
//   the sums and products that form v+ and w+ add 4 u of each;
//   z, d z, r z, p and the two products of h or g add u each.
// h and g are (p, q) rotated, so that this is at most 2 (1 + 4 + 3) u times the
// sum of their terms. Every test of h = 0 or g = 0 uses this bound, so that a
// state means the same to all of them.
#define SLIP_ROUNDINGS (32 * TF_REAL_EPSILON)
TF_INLINE tf_real_t slip_rounding(const tf_machine_t *k, tf_real_t r,
                                  tf_real_t v, tf_real_t w, tf_real_t omega0) {
  return SLIP_ROUNDINGS * slip_terms(k, r, v, w, omega0);
}

// One sum instead of three comparisons: NaN and infinity survive into it.
TF_INLINE bool in_reach(tf_real_t r, tf_real_t v, tf_real_t w) {
  return within(magnitude(r) + magnitude(v) + magnitude(w), TF_STATE_LIMIT);
}

TF_INLINE bool input_in_range(const tf_input_t *u) {
  return within(magnitude(u->omega0) + magnitude(u->r0) + magnitude(u->force) +
                    magnitude(u->torque) + magnitude(u->alpha),
                TF_STATE_LIMIT);
}

TF_INLINE bool in_range(const tf_state_t *state, const tf_input_t *u) {
  return in_reach(state->r, state->v, state->w) && input_in_range(u);
}

// The mechanics of the machine, each formula once: inertia, the smooth forces,
// the Delassus scalar. With z = w - omega0, p = v - d z and q = r z the kinetic
// energy relative to the turntable has no cross term, and
//   m p' = Q_r + F sin(gamma) + m d alpha
//   J z' = Q_phi + d Q_r + F r cos(gamma) + M - J alpha,   J = m (beta^2 + r^2)
//   Q_r   = k2 (r0 - r) - c2 v + m r w^2 + force                        (2)
//   Q_phi = torque - c1 w - 2 m r v w                                   (3)
// The located step integrates the angular momentum J w instead of z. Its rate
// has no term -2 m r v w, because that is part of (J w)':
//   (J w)' = torque - c1 w + d Q_r + F r cos(gamma) + M                 (14)

// J/m = beta^2 + r^2, the square of the radius of gyration [m^2].
TF_INLINE tf_real_t gyration2_at(const tf_machine_t *k, tf_real_t r) {
  return k->beta2 + r * r;
}

// J = m (beta^2 + r^2) [kg m^2].
TF_INLINE tf_real_t inertia_at(const tf_machine_t *k, tf_real_t r) {
  return k->m * gyration2_at(k, r);
}

// Twice the energy: of the slider, the disc and the spring from r0. Of v the
// slider's part is what is left beside the disc's, P = v - d w.
TF_INLINE tf_real_t twice_energy(const tf_machine_t *k, tf_real_t r,
                                 tf_real_t v, tf_real_t w, tf_real_t r0) {
  const tf_real_t P = ground_speed(k, v, w), stretch = r - r0;
  return k->m * P * P + inertia_at(k, r) * w * w + k->k2 * stretch * stretch;
}

// m beta^2, the inertia of the disc, in pairs: tf_machine_t.beta2 is rounded.
TF_INLINE pair_t disc_inertia_pair(tf_real_t m, tf_real_t beta) {
  return pair_times(two_product(beta, beta), m);
}

// (2). The caller forms m r w^2, because it needs m r w elsewhere as well.
TF_INLINE tf_real_t radial_force(const tf_machine_t *k, const tf_input_t *u,
                                 tf_real_t r, tf_real_t v,
                                 tf_real_t centrifugal) {
  return k->k2 * (u->r0 - r) - k->c2 * v + centrifugal + u->force;
}

// (3). The caller forms 2 m r v w.
TF_INLINE tf_real_t disc_torque(const tf_machine_t *k, const tf_input_t *u,
                                tf_real_t w, tf_real_t coriolis) {
  return u->torque - k->c1 * w - coriolis;
}

// What the terms of (2) and (3) amount to without their signs, for a stretch of
// the spring up to s and speeds up to v and w: a share of it is what rounding
// makes of their sums.
typedef struct {
  tf_real_t radial, torque;
} force_terms_t;

TF_INLINE force_terms_t force_terms(const tf_machine_t *k, const tf_input_t *u,
                                    tf_real_t s, tf_real_t r, tf_real_t v,
                                    tf_real_t w) {
  const tf_real_t mrw = k->m * magnitude(r * w);
  return (force_terms_t){
      k->k2 * magnitude(s) + k->c2 * magnitude(v) + mrw * magnitude(w) +
          magnitude(u->force),
      magnitude(u->torque) + k->c1 * magnitude(w) + 2 * mrw * magnitude(v)};
}

// (2) and (3) in pairs.
TF_INLINE pair_t radial_force_pair(const tf_machine_t *k, const tf_input_t *u,
                                   pair_t r, pair_t v, pair_t centrifugal) {
  const pair_t spring = pair_times(pair_plus(pair_negative(r), u->r0), k->k2);
  return pair_difference(pair_sum(spring, pair_plus(centrifugal, u->force)),
                         pair_times(v, k->c2));
}

TF_INLINE pair_t disc_torque_pair(const tf_machine_t *k, const tf_input_t *u,
                                  pair_t w, pair_t coriolis) {
  const pair_t lost = pair_sum(pair_times(w, k->c1), coriolis);
  return pair_plus(pair_negative(lost), u->torque);
}

// Term n of the Taylor series of (2), from the terms of r, v and r w^2.
TF_INLINE tf_real_t radial_force_term(const tf_machine_t *k,
                                      const tf_input_t *u, int n, tf_real_t r,
                                      tf_real_t v, tf_real_t rw2) {
  const tf_real_t Q_r = k->m * rw2 - k->k2 * r - k->c2 * v;
  return n == 0 ? Q_r + (k->k2 * u->r0 + u->force) : Q_r;
}

// Term n of the Taylor series of torque - c1 w + d Q_r in (14).
TF_INLINE tf_real_t momentum_rate_term(const tf_machine_t *k,
                                       const tf_input_t *u, int n, tf_real_t w,
                                       tf_real_t Q_r) {
  const tf_real_t rate = k->d * Q_r - k->c1 * w;
  return n == 0 ? rate + u->torque : rate;
}

// The time derivatives of (2) and (3) at (r, v, w) under the rates dr, dv, dw,
// with the inputs held.
TF_INLINE tf_real_t radial_force_rate(const tf_machine_t *k, tf_real_t r,
                                      tf_real_t w, tf_real_t dr, tf_real_t dv,
                                      tf_real_t dw) {
  return -k->k2 * dr - k->c2 * dv + k->m * (dr * w * w + 2 * r * w * dw);
}

TF_INLINE tf_real_t disc_torque_rate(const tf_machine_t *k, tf_real_t r,
                                     tf_real_t v, tf_real_t w, tf_real_t dr,
                                     tf_real_t dv, tf_real_t dw) {
  return -k->c1 * dw - 2 * k->m * (dr * v * w + r * dv * w + r * v * dw);
}

// Term n of the Taylor series of (2) at rest on a turntable, r and v constant,
// from the term of w^2.
TF_INLINE tf_real_t radial_force_at_rest_term(const tf_machine_t *k,
                                              const tf_input_t *u, int n,
                                              tf_real_t r, tf_real_t w2) {
  const tf_real_t Q_r = k->m * r * w2;
  return n == 0 ? Q_r + (k->k2 * (u->r0 - r) + u->force) : Q_r;
}

// (2) and (3) along h = 0 at one r, by powers of g: w = omega0 + zeta g, v =
// nu g with zeta = sine/r and nu = d zeta - cos(gamma).
typedef struct {
  tf_real_t Q_r[3], Q_phi[3];
} forces_along_g_t;

TF_INLINE forces_along_g_t forces_along_g(const tf_machine_t *k,
                                          const tf_input_t *u, tf_real_t sine,
                                          tf_real_t r, tf_real_t zeta,
                                          tf_real_t nu) {
  const tf_real_t m = k->m, w0 = u->omega0;
  return (forces_along_g_t){
      {k->k2 * (u->r0 - r) + u->force + m * r * w0 * w0,
       2 * m * w0 * sine - k->c2 * nu, m * sine * zeta},
      {u->torque - k->c1 * w0, -k->c1 * zeta - 2 * m * r * nu * w0,
       -2 * m * nu * sine}};
}

// z' under a force and a moment of friction; arm = r cos(gamma).
TF_INLINE tf_real_t spin_rate_under(tf_real_t arm, tf_force_t f, tf_real_t J) {
  return (f.F * arm + f.M) / J;
}

// s kappa, by the sign of g.
TF_INLINE tf_real_t signed_kappa(const tf_machine_t *k, sign_t s) {
  return with_sign(s, k->contact.stick_kappa);
}

// The arm of lambda about the axis, r cos(gamma) + s kappa [m]: lambda acts on
// z' by this arm over J.
TF_INLINE tf_real_t stick_arm(const tf_machine_t *k, tf_real_t arm, sign_t s) {
  return arm + signed_kappa(k, s);
}

// The Delassus scalar of stick, h' = N - A lambda,
//   A(r, s) = sin^2(gamma)/m + r cos(gamma) (r cos(gamma) + s kappa)/J,
// from its second term: r cos(gamma) times what lambda does to z'. A caller
// that has 1/J multiplies by it.
TF_INLINE tf_real_t delassus_from(const tf_machine_t *k, tf_real_t rotation) {
  return k->sin_gamma * k->sin_gamma / k->m + rotation;
}

// A at arm = r cos(gamma).
TF_INLINE tf_real_t delassus_at(const tf_machine_t *k, tf_real_t arm, sign_t s,
                                tf_real_t J) {
  return delassus_from(k, arm * stick_arm(k, arm, s) / J);
}

// A J, which vanishes with A and takes no division: r^2 + b r + c.
typedef struct {
  tf_real_t b, c; // s kappa cos(gamma) [m], beta^2 sin^2(gamma) [m^2]
} delassus_quadratic_t;

TF_INLINE delassus_quadratic_t delassus_quadratic(const tf_machine_t *k,
                                                  sign_t s) {
  return (delassus_quadratic_t){signed_kappa(k, s) * k->cos_gamma,
                                k->beta2 * k->sin_gamma * k->sin_gamma};
}

// The value of A J at r, and its rate under dr.
TF_INLINE tf_real_t delassus_quadratic_at(delassus_quadratic_t at,
                                          tf_real_t r) {
  return r * r + at.b * r + at.c;
}

TF_INLINE tf_real_t delassus_quadratic_rate(delassus_quadratic_t at,
                                            tf_real_t r, tf_real_t dr) {
  return (2 * r + at.b) * dr;
}

// dA/dt under dr: A depends on r alone.
TF_INLINE tf_real_t delassus_rate(const tf_machine_t *k, tf_real_t r,
                                  tf_real_t dr, sign_t s, tf_real_t J) {
  const tf_real_t arm = r * k->cos_gamma, of_lambda = stick_arm(k, arm, s);
  const tf_real_t darm = dr * k->cos_gamma, dJ = 2 * k->m * r * dr;
  return (darm * (of_lambda + arm) - arm * (of_lambda / J) * dJ) / J;
}

// The constants of a machine that depend on its step: for tf_prepare, and for
// what is left of a step.

// The shortest step of a machine [s].
#define MIN_STEP TF_R(1e-9)

// The chance of an exit stays that of a whole step: one draw decides it.
TF_INLINE void set_step_length(tf_machine_t *k, tf_real_t dt) {
  const tf_real_t theta_dt = k->theta * dt;
  const tf_real_t a = theta_dt * (k->c2 + theta_dt * k->k2);
  k->dt = dt;
  k->theta_dt = theta_dt;
  k->explicit_dt = dt - theta_dt;
  k->a = a;
  k->d_a = k->d * a;
  k->m_plus_a = k->m + a;
  k->m_a_d2 = k->m * a * k->d * k->d;
  k->inertia = k->m * k->beta2 + theta_dt * k->c1;
  k->inv_mu_dt = inverse_or_0(k->contact.tyre.mu * dt);
}

#endif
