// The theta step, linearised about its start: the motion without friction, and
// how the velocities at the end respond to a force F and a moment M that are
// constant over the step. Equations (1)-(8) of DESIGN.md.
//
// The velocities are z = w - omega0 and p = v - d z: p carries the kinetic
// energy without a cross term, so that the mass matrix is diagonal and nothing
// cancels where beta or r is small. They are against the turntable of the end
// of the step; a slip at its start or at the theta point is against the
// turntable of that instant, see slip_at_instant().
#ifndef TF_LINEAR_H
#define TF_LINEAR_H

#include "../friction/inclusion.h"
#include "../model/mechanics.h"

// A change of the velocities p and z over the step, or these themselves.
typedef struct {
  tf_real_t p, z;
} change_t;

// The velocities of a state against a turntable.
TF_INLINE change_t velocities(const tf_machine_t *k, const tf_state_t *state,
                              tf_real_t omega0) {
  const tf_real_t z = state->w - omega0;
  return (change_t){slider_speed(k, state->v, z), z};
}

typedef struct {
  tf_real_t omega0;        // of the turntable at the end of the step
  tf_real_t p, z;          // at the start, against that turntable
  change_t free;           // change without friction
  tf_real_t r_explicit;    // r + (1 - theta) dt v [m]
  tf_real_t arm;           // r_theta cos(gamma), arm of F about the axis [m]
  tf_real_t p_b, p_t, p_c; // dt S^-1 by rows, see change_under()
  tf_real_t z_t, z_c;
  bool definite; // false: the effective mass is not positive
} linear_t;

// S (dv, dw) = dt (b, c) for a force b along r and a torque c about the axis,
// solved for (dp, dz); t = c + d b is the torque with the arm of b. So the
// large implicit mass a multiplies c alone and never the difference
// t - d b.
TF_INLINE change_t change_under(const linear_t *l, tf_real_t b, tf_real_t t,
                                tf_real_t c) {
  return (change_t){l->p_b * b + l->p_t * t - l->p_c * c,
                    l->z_t * t + l->z_c * c - l->p_t * b};
}

// The response to a friction force and moment.
TF_INLINE change_t response_to(const tf_machine_t *k, const linear_t *l,
                               tf_force_t f) {
  const tf_real_t t = f.F * l->arm + f.M;
  return change_under(l, f.F * k->sin_gamma, t, t - f.F * k->d_sin_gamma);
}

// The same to F = mu alone and to M = kappa mu alone.
TF_INLINE change_t response_to_mu(const tf_machine_t *k, const linear_t *l) {
  const tf_real_t t = k->contact.tyre.mu * l->arm;
  return change_under(l, k->mu_sin_gamma, t, t - k->mu_d_sin_gamma);
}

TF_INLINE change_t response_to_kappa_mu(const tf_machine_t *k,
                                        const linear_t *l) {
  return (change_t){k->contact.kappa_mu * (l->p_t - l->p_c),
                    k->contact.kappa_mu * (l->z_t + l->z_c)};
}

// (1): r at the theta point.
TF_INLINE tf_real_t r_at_theta(const tf_machine_t *k, tf_real_t r,
                               tf_real_t v) {
  return r + k->theta_dt * v;
}

// (5), (6): the rows of dt S^-1, from J with its implicit parts and e: det S is
// `definite` + e^2, without the m^2 d^2 that would cancel.
TF_INLINE void invert(const tf_machine_t *k, tf_real_t J, tf_real_t e,
                      linear_t *l) {
  const tf_real_t definite = k->m_plus_a * J + k->m_a_d2;
  const tf_real_t scale = k->dt / (definite + e * e);
  l->p_b = scale * J;
  l->p_t = scale * e;
  l->p_c = scale * k->d_a;
  l->z_t = scale * k->m;
  l->z_c = scale * k->a;
  // scale is 0 where the determinant overflows
  l->definite = (definite > 0) & (scale > 0);
}

// start: the velocities at the start, against the turntable of the end.
TF_INLINE linear_t linearise(const tf_machine_t *k, const tf_state_t *state,
                             const tf_input_t *input, change_t start) {
  const tf_real_t v = state->v, w = state->w, theta_dt = k->theta_dt;
  linear_t l;
  // (1)
  const tf_real_t r_theta = r_at_theta(k, state->r, v);
  const tf_real_t mr = k->m * r_theta, mrw = mr * w, twice = mrw + mrw;
  // (2), (3)
  const tf_real_t Q_r = radial_force(k, input, r_theta, v, mrw * w);
  const tf_real_t Q_phi = disc_torque(k, input, w, twice * v);
  // (4)
  const tf_real_t e = theta_dt * twice;
  const tf_real_t J = k->inertia + mr * (r_theta + 2 * (theta_dt * v));
  invert(k, J, e, &l); // (5), (6)
  l.omega0 = input->omega0;
  l.free = change_under(&l, Q_r, Q_phi + k->d * Q_r, Q_phi);
  l.arm = r_theta * k->cos_gamma;
  l.p = start.p;
  l.z = start.z;
  l.r_explicit = state->r + k->explicit_dt * v;
  return l;
}

TF_INLINE tf_real_t end_r(const tf_machine_t *k, const linear_t *l,
                          tf_real_t end_v) {
  return l->r_explicit + k->theta_dt * end_v;
}

// (7): where a step ends, after a change of the velocities by friction.
TF_INLINE end_state_t end_after(const tf_machine_t *k, const linear_t *l,
                                change_t friction) {
  const tf_real_t p = l->p + l->free.p + friction.p;
  const tf_real_t z = l->z + l->free.z + friction.z;
  const tf_real_t v = slider_velocity(k, p, z);
  return (end_state_t){end_r(k, l, v), v, z + l->omega0};
}

// (8): the change of the velocities under x and y, from that of each.
TF_INLINE change_t change_of(tf_real_t x, tf_real_t y, change_t F, change_t M) {
  return (change_t){x * F.p + y * M.p, x * F.z + y * M.z};
}

// (12): by how much the angle grows in a step, from w at its start and end.
TF_INLINE tf_real_t angle_change(const tf_machine_t *k, tf_real_t w,
                                 tf_real_t w_end) {
  return k->explicit_dt * w + k->theta_dt * w_end;
}

// The slip at an instant of a step, from p and z against the turntable of its
// end: at that instant the turntable is slower by a turn.
TF_INLINE tf_slip_t slip_at_instant(const tf_machine_t *k, tf_real_t turn,
                                    tf_real_t r, tf_real_t p, tf_real_t z) {
  return slip_from_pq(k, p - k->d * turn, r * (z + turn));
}

// (9): slip at the theta point, at which the force of a slip is evaluated.
TF_INLINE tf_slip_t slip_at_theta(const tf_machine_t *k, const linear_t *l,
                                  tf_real_t turn, tf_real_t r_theta,
                                  change_t friction) {
  const tf_real_t p = l->p + k->theta * (l->free.p + friction.p);
  const tf_real_t z = l->z + k->theta * (l->free.z + friction.z);
  return slip_at_instant(k, turn, r_theta, p, z);
}

// (8): responses of p, z and r at the end of the step to x = F / mu or to
// y = M / (kappa mu).
typedef struct {
  tf_real_t p, z, r;
} response_t;

TF_INLINE response_t response_at_end(const tf_machine_t *k, change_t c) {
  return (response_t){c.p, c.z, k->theta_dt * slider_velocity(k, c.p, c.z)};
}

// The end of the step without friction, and the responses there.
typedef struct {
  tf_real_t p, z, r;
  response_t by_x, by_y;
} free_end_t;

TF_INLINE free_end_t free_end(const tf_machine_t *k, const linear_t *l) {
  free_end_t end;
  end.p = l->p + l->free.p;
  end.z = l->z + l->free.z;
  end.r = end_r(k, l, slider_velocity(k, end.p, end.z));
  end.by_x = response_at_end(k, response_to_mu(k, l));
  end.by_y = response_at_end(k, response_to_kappa_mu(k, l));
  return end;
}

// (8): the slip's response of first order, q' = r z' + z r'.
TF_INLINE tf_slip_t slip_response(const tf_machine_t *k, const free_end_t *end,
                                  response_t by) {
  return slip_from_pq(k, by.p, end->r * by.z + end->z * by.r);
}

// (8): h and g at the end of the step as quadratic forms of x and y, because p+
// is affine in them and q+ = r+ z+ is a product of two affine functions.
TF_INLINE void slip_forms(const tf_machine_t *k, const free_end_t *end,
                          tf_slip_t free, tf_form_t *h, tf_form_t *g) {
  const response_t x = end->by_x, y = end->by_y;
  const tf_slip_t by_x = slip_response(k, end, x);
  const tf_slip_t by_y = slip_response(k, end, y);
  const tf_real_t xx = x.r * x.z, yy = y.r * y.z, xy = x.r * y.z + y.r * x.z;
  *h = (tf_form_t){free.h,
                   by_x.h,
                   by_y.h,
                   -xx * k->cos_gamma,
                   -xy * k->cos_gamma,
                   -yy * k->cos_gamma};
  *g = (tf_form_t){
      free.g,           by_x.g, by_y.g, xx * k->sin_gamma, xy * k->sin_gamma,
      yy * k->sin_gamma};
}

// (8): the Delassus scalar of the step, from the slope of h+ in x.
TF_INLINE tf_real_t delassus_of_slope(const tf_machine_t *k, tf_real_t slope) {
  return -slope * k->inv_mu_dt;
}

// (10): the force b along r and the torque t that end the step at p = z = 0,
// from change_under() inverted with c = t - d b.
typedef struct {
  tf_real_t b, t;
} rest_load_t;

TF_INLINE rest_load_t load_to_rest(const tf_machine_t *k, const linear_t *l) {
  const tf_real_t p = l->p + l->free.p, z = l->z + l->free.z;
  const tf_real_t p_by_b = l->p_b + k->d * l->p_c, p_by_t = l->p_t - l->p_c;
  const tf_real_t minus_z_by_b = l->p_t + k->d * l->z_c,
                  z_by_t = l->z_t + l->z_c;
  const tf_real_t det = p_by_b * z_by_t + p_by_t * minus_z_by_b;
  return (rest_load_t){(p_by_t * z - z_by_t * p) / det,
                       -(p_by_b * z + minus_z_by_b * p) / det};
}

// (10): the friction force and moment that do so.
TF_INLINE tf_force_t friction_to_rest(const tf_machine_t *k,
                                      const linear_t *l) {
  const rest_load_t load = load_to_rest(k, l);
  const tf_real_t F = load.b / k->sin_gamma;
  return (tf_force_t){F, load.t - F * l->arm};
}

// What friction does is left out of a program for one scene without.
TF_INLINE bool has_friction(const tf_machine_t *k) {
  return k->contact.tyre.law != TF_TYRE_NONE;
}

// Without a moment no wheel is pinned: it sticks. A build for one such scene
// defines this as false, and leaves out what would be found and not read.
#ifndef TF_STEP_PINS
#define TF_STEP_PINS true
#endif

// With sin(gamma) = 0 friction has no component along r and the wheel cannot be
// pinned: F is larger then than any mu.
TF_INLINE bool can_be_pinned(const tf_machine_t *k) {
  return TF_STEP_PINS && k->sin_gamma != 0;
}

static const tf_force_t unpinnable = {TF_REAL_MAX, 0};

TF_INLINE tf_force_t pinning_force(const tf_machine_t *k, const linear_t *l) {
  return can_be_pinned(k) ? friction_to_rest(k, l) : unpinnable;
}

#endif
