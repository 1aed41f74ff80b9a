// The theta step, linearised about its start: the motion without friction, and
// how the velocities at the end respond to a force F and a moment M that are
// constant over the step. Equations (1)-(8) of DESIGN.md.
//
// The velocities are z = w - omega0 and p = v - d z: p carries the kinetic
// energy without a cross term, so that the mass matrix is diagonal and nothing
// cancels where beta or r is small.
#ifndef TF_LINEAR_H
#define TF_LINEAR_H

#include "../friction/inclusion.h"
#include "../model/mechanics.h"

// A change of the velocities p and z over the step.
typedef struct {
  tf_real_t p, z;
} tf_change_t;

typedef struct {
  tf_real_t omega0;        // of the turntable at the end of the step
  tf_real_t p, z;          // at the start of the step
  tf_change_t free;        // change without friction
  tf_real_t r_explicit;    // r + (1 - theta) dt v [m]
  tf_real_t arm;           // r_theta cos(gamma), arm of F about the axis [m]
  tf_real_t p_b, p_t, p_c; // dt S^-1 by rows, see change_under()
  tf_real_t z_t, z_c;
  bool definite; // false: the effective mass is not positive
} tf_linear_t;

// S (dv, dw) = dt (b, c) for a force b along r and a torque c about the axis,
// solved for (dp, dz); t = c + d b is the torque with the arm of b. So the
// large implicit mass a multiplies c alone and never the difference
// t - d b.
TF_INLINE tf_change_t change_under(const tf_linear_t *l, tf_real_t b,
                                   tf_real_t t, tf_real_t c) {
  return (tf_change_t){l->p_b * b + l->p_t * t - l->p_c * c,
                       l->z_t * t + l->z_c * c - l->p_t * b};
}

// The response to a friction force and moment.
TF_INLINE tf_change_t response_to(const tf_machine_t *k, const tf_linear_t *l,
                                  tf_force_t f) {
  const tf_real_t t = f.F * l->arm + f.M;
  return change_under(l, f.F * k->sin_gamma, t, t - f.F * k->d_sin_gamma);
}

// The same to F = mu alone and to M = kappa mu alone.
TF_INLINE tf_change_t response_to_mu(const tf_machine_t *k,
                                     const tf_linear_t *l) {
  const tf_real_t t = k->tyre.mu * l->arm;
  return change_under(l, k->mu_sin_gamma, t, t - k->mu_d_sin_gamma);
}

TF_INLINE tf_change_t response_to_kappa_mu(const tf_machine_t *k,
                                           const tf_linear_t *l) {
  return (tf_change_t){k->kappa_mu * (l->p_t - l->p_c),
                       k->kappa_mu * (l->z_t + l->z_c)};
}

TF_INLINE tf_linear_t linearise(const tf_machine_t *k, const tf_state_t *state,
                                const tf_input_t *input) {
  const tf_real_t v = state->v, w = state->w, theta_dt = k->theta_dt;
  tf_linear_t l;
  // (1)
  const tf_real_t theta_dt_v = theta_dt * v, rt = state->r + theta_dt_v;
  const tf_real_t mr = k->m * rt, mrw = mr * w, twice = mrw + mrw;
  // (2), (3)
  const tf_real_t Q_r = radial_force(k, input, rt, v, mrw * w);
  const tf_real_t Q_phi = disc_torque(k, input, w, twice * v);
  // (4)
  const tf_real_t e = theta_dt * twice;
  const tf_real_t J = k->inertia + mr * (rt + 2 * theta_dt_v);
  // (5): det S without the m^2 d^2 that would cancel
  const tf_real_t definite = k->m_plus_a * J + k->m_a_d2;
  const tf_real_t det = definite + e * e;
  const tf_real_t scale = k->dt / det;
  // (6)
  l.p_b = scale * J;
  l.p_t = scale * e;
  l.p_c = scale * k->d_a;
  l.z_t = scale * k->m;
  l.z_c = scale * k->a;
  l.free = change_under(&l, Q_r, Q_phi + k->d * Q_r, Q_phi);
  l.arm = rt * k->cos_gamma;
  l.omega0 = input->omega0;
  l.z = w - l.omega0;
  l.p = v - k->d * l.z;
  l.r_explicit = state->r + k->explicit_dt * v;
  l.definite = (definite > 0) & (scale > 0); // scale is 0 where det overflows
  return l;
}

// (7): where a step ends, after a change of the velocities by friction.
typedef struct {
  tf_real_t r, v, w;
} tf_end_t;

TF_INLINE tf_end_t end_after(const tf_machine_t *k, const tf_linear_t *l,
                             tf_change_t friction) {
  const tf_real_t p = l->p + l->free.p + friction.p;
  const tf_real_t z = l->z + l->free.z + friction.z;
  tf_end_t end;
  end.w = z + l->omega0;
  end.v = p + k->d * z;
  end.r = l->r_explicit + k->theta_dt * end.v;
  return end;
}

// (9): slip at the theta point, at which the force of a slip is evaluated.
TF_INLINE tf_slip_t slip_at_theta(const tf_machine_t *k, const tf_linear_t *l,
                                  tf_real_t r_theta, tf_change_t friction) {
  const tf_real_t p = l->p + k->theta * (l->free.p + friction.p);
  const tf_real_t z = l->z + k->theta * (l->free.z + friction.z);
  return slip_from_pq(k, p, r_theta * z);
}

// (8): responses of p, z and r at the end of the step to x = F / mu or to
// y = M / (kappa mu).
typedef struct {
  tf_real_t p, z, r;
} tf_response_t;

TF_INLINE tf_response_t response_at_end(const tf_machine_t *k, tf_change_t c) {
  return (tf_response_t){c.p, c.z, k->theta_dt * (c.p + k->d * c.z)};
}

// The end of the step without friction, and the responses there.
typedef struct {
  tf_real_t p, z, r;
  tf_response_t F, M;
} tf_free_end_t;

TF_INLINE tf_free_end_t free_end(const tf_machine_t *k, const tf_linear_t *l) {
  tf_free_end_t end;
  end.p = l->p + l->free.p;
  end.z = l->z + l->free.z;
  end.r = l->r_explicit + k->theta_dt * (end.p + k->d * end.z);
  end.F = response_at_end(k, response_to_mu(k, l));
  end.M = response_at_end(k, response_to_kappa_mu(k, l));
  return end;
}

// (8): h and g at the end of the step as quadratic forms of x and y, because p+
// is affine in them and q+ = r+ z+ is a product of two affine functions.
TF_INLINE void slip_forms(const tf_machine_t *k, const tf_free_end_t *end,
                          tf_slip_t free, tf_form_t *h, tf_form_t *g) {
  const tf_response_t F = end->F, M = end->M;
  const tf_slip_t f = slip_from_pq(k, F.p, end->r * F.z + end->z * F.r);
  const tf_slip_t m = slip_from_pq(k, M.p, end->r * M.z + end->z * M.r);
  const tf_real_t FF = F.r * F.z, MM = M.r * M.z, FM = F.r * M.z + M.r * F.z;
  *h = (tf_form_t){free.h,
                   f.h,
                   m.h,
                   -FF * k->cos_gamma,
                   -FM * k->cos_gamma,
                   -MM * k->cos_gamma};
  *g = (tf_form_t){
      free.g,           f.g, m.g, FF * k->sin_gamma, FM * k->sin_gamma,
      MM * k->sin_gamma};
}

// (8): the Delassus scalar of the step, from the slope of h+ in x.
TF_INLINE tf_real_t delassus_of_slope(const tf_machine_t *k, tf_real_t slope) {
  return -slope * k->inv_mu_dt;
}

// (10): the force b along r and the torque t that end the step at p = z = 0,
// from change_under() inverted with c = t - d b.
typedef struct {
  tf_real_t b, t;
} tf_rest_load_t;

TF_INLINE tf_rest_load_t load_to_rest(const tf_machine_t *k,
                                      const tf_linear_t *l) {
  const tf_real_t p = l->p + l->free.p, z = l->z + l->free.z;
  const tf_real_t P = l->p_b + k->d * l->p_c, T = l->p_t - l->p_c;
  const tf_real_t B = l->p_t + k->d * l->z_c, Z = l->z_t + l->z_c;
  const tf_real_t det = P * Z + T * B;
  return (tf_rest_load_t){(T * z - Z * p) / det, -(P * z + B * p) / det};
}

// (10): the friction force and moment that do so. With sin(gamma) = 0 friction
// has no component along r and the wheel cannot be pinned: F is larger then
// than any mu.
TF_INLINE tf_force_t pinning_force(const tf_machine_t *k,
                                   const tf_linear_t *l) {
  const tf_rest_load_t load = load_to_rest(k, l);
  if (k->sin_gamma == 0) return (tf_force_t){TF_REAL_MAX, 0};
  const tf_real_t F = load.b / k->sin_gamma;
  return (tf_force_t){F, load.t - F * l->arm};
}

#endif
