// The linearly implicit step without the friction law: how the end of a step
// answers to a force F and a moment M that are constant over it. Equations
// (1)-(8) of DESIGN.md. Velocities are z = w - omega0 and p = v - d z: p
// carries the kinetic energy without a cross term, so the mass matrix is
// diagonal and nothing cancels when beta or r is small.
#ifndef TF_LINEAR_H
#define TF_LINEAR_H

#include "../model/mechanics.h"
#include "twofold/friction.h"

// A change of the velocities.
typedef struct {
  tf_real_t p, z;
} tf_change_t;

typedef struct {
  tf_real_t omega0;        // of the turntable at the end of the step
  tf_real_t p, z;          // at the start of the step
  tf_change_t free;        // change without friction
  tf_real_t r_explicit;    // r + (1 - theta) dt v [m]
  tf_real_t arm;           // r_theta cos(gamma), arm of F about the axis [m]
  tf_real_t p_b, p_t, p_c; // dt S^-1 by rows, see response()
  tf_real_t z_t, z_c;
  bool definite; // false: the effective mass is not positive
} tf_linear_t;

// S (dv, dw) = dt (b, c) for a force b along r and a torque c about the axis,
// solved for (dp, dz); t = c + d b is the torque with the arm of b. So the
// large implicit stiffness a meets c alone and never the difference t - d b.
TF_INLINE tf_change_t answer(const tf_linear_t *l, tf_real_t b, tf_real_t t,
                             tf_real_t c) {
  return (tf_change_t){l->p_b * b + l->p_t * t - l->p_c * c,
                       l->z_t * t + l->z_c * c - l->p_t * b};
}

// Answer to a friction force and moment.
TF_INLINE tf_change_t response(const tf_machine_t *k, const tf_linear_t *l,
                               tf_force_t f) {
  const tf_real_t t = f.F * l->arm + f.M;
  return answer(l, f.F * k->sin_gamma, t, t - f.F * k->d_sin_gamma);
}

// The same for F = mu and for M = kappa mu alone.
TF_INLINE tf_change_t force_response(const tf_machine_t *k,
                                     const tf_linear_t *l) {
  const tf_real_t t = k->tyre.mu * l->arm;
  return answer(l, k->mu_sin_gamma, t, t - k->mu_d_sin_gamma);
}

TF_INLINE tf_change_t moment_response(const tf_machine_t *k,
                                      const tf_linear_t *l) {
  return (tf_change_t){k->kappa_mu * (l->p_t - l->p_c),
                       k->kappa_mu * (l->z_t + l->z_c)};
}

TF_INLINE tf_linear_t linearise(const tf_machine_t *k, const tf_state_t *state,
                                const tf_input_t *input) {
  const tf_real_t v = state->v, w = state->w, h = k->theta_dt;
  tf_linear_t l;
  // (1)
  const tf_real_t hv = h * v, rt = state->r + hv;
  const tf_real_t mr = k->m * rt, mrw = mr * w, twice = mrw + mrw;
  // (2), (3)
  const tf_real_t Q_r = radial_force(k, input, rt, v, mrw * w);
  const tf_real_t Q_phi = disc_torque(k, input, w, twice * v);
  // (4)
  const tf_real_t e = h * twice;
  const tf_real_t J = k->inertia + mr * (rt + 2 * hv);
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
  l.free = answer(&l, Q_r, Q_phi + k->d * Q_r, Q_phi);
  l.arm = rt * k->cos_gamma;
  l.omega0 = input->omega0;
  l.z = w - l.omega0;
  l.p = v - k->d * l.z;
  l.r_explicit = state->r + k->explicit_dt * v;
  l.definite = (definite > 0) & (scale > 0); // scale is 0 where det overflows
  return l;
}

// Where a step ends.
typedef struct {
  tf_force_t force;
  tf_real_t r, v, w;
} tf_end_t;

// (7)
TF_INLINE tf_end_t end_after(const tf_machine_t *k, const tf_linear_t *l,
                             tf_force_t force, tf_change_t friction) {
  const tf_real_t p = l->p + l->free.p + friction.p;
  const tf_real_t z = l->z + l->free.z + friction.z;
  tf_end_t end;
  end.force = force;
  end.w = z + l->omega0;
  end.v = p + k->d * z;
  end.r = l->r_explicit + k->theta_dt * end.v;
  return end;
}

TF_INLINE tf_slip_t end_slip(const tf_machine_t *k, const tf_linear_t *l,
                             const tf_end_t *end) {
  return slip_speeds(k, end->r, end->v, end->w - l->omega0);
}

// (9): slip at the theta point, where a slip force is to be evaluated.
TF_INLINE tf_slip_t theta_slip(const tf_machine_t *k, const tf_linear_t *l,
                               tf_real_t r_theta, tf_change_t friction) {
  const tf_real_t p = l->p + k->theta * (l->free.p + friction.p);
  const tf_real_t z = l->z + k->theta * (l->free.z + friction.z);
  return slip_from_pq(k, p, r_theta * z);
}

// (8): answers of p, z and r at the end of the step to x and y alone, that is
// to F = mu and to M = kappa mu.
typedef struct {
  tf_real_t p, z, r;
} tf_response_t;

TF_INLINE tf_response_t response_at_end(const tf_machine_t *k, tf_change_t c) {
  return (tf_response_t){c.p, c.z, k->theta_dt * (c.p + k->d * c.z)};
}

// h and g at the end of the step as forms of x and y: from p+ affine in them
// and q+ = r+ z+ a product of two affine functions.
TF_INLINE void slip_forms(const tf_machine_t *k, tf_real_t r, tf_real_t z,
                          tf_slip_t free, const tf_response_t *F,
                          const tf_response_t *M, tf_form_t *h, tf_form_t *g) {
  const tf_slip_t f = slip_from_pq(k, F->p, r * F->z + z * F->r);
  const tf_slip_t m = slip_from_pq(k, M->p, r * M->z + z * M->r);
  const tf_real_t FF = F->r * F->z, MM = M->r * M->z;
  const tf_real_t FM = F->r * M->z + M->r * F->z;
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

// (10): the force and moment under which the velocities end at p = z = 0: the
// rows of S solved for F and M. Without a hold of F on v (sin gamma = 0) the
// wheel cannot be pinned; F is then out of any mu's reach.
TF_INLINE tf_force_t pinning_force(const tf_machine_t *k,
                                   const tf_linear_t *l) {
  const tf_real_t p = l->p + l->free.p, z = l->z + l->free.z;
  // answer() inverted: (p, z) = answer(b, t, c), c = t - d b.
  const tf_real_t P = l->p_b + k->d * l->p_c, T = l->p_t - l->p_c;
  const tf_real_t B = l->p_t + k->d * l->z_c, Z = l->z_t + l->z_c;
  const tf_real_t det = P * Z + T * B;
  const tf_real_t b = (T * z - Z * p) / det, t = -(P * z + B * p) / det;
  if (k->sin_gamma == 0) return (tf_force_t){TF_REAL_MAX, 0};
  const tf_real_t F = b / k->sin_gamma;
  return (tf_force_t){F, t - F * l->arm};
}

#endif
