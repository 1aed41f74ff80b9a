// What the compensated step computes in pairs of tf_real_t. The machine is at
// state + compensation. The step is solved in tf_real_t, but
// * h at the start is that of their sum: an error of epsilon there would be one
//   of epsilon h / dt in the force that holds the stick, while one of epsilon
//   in a coefficient is no more than that in an increment;
// * at the end the increments of p and z are refined once: the residual of (6)
//   is formed in pairs, and the inverse that solved for them solves for what
//   is missing. So an epsilon in a coefficient costs an epsilon of an epsilon.
#ifndef TF_COMPENSATION_H
#define TF_COMPENSATION_H

#include "../num/pair.h"
#include "stages.h"
#include "twofold/compensated.h"

// The state in pairs.
typedef struct {
  pair_t r, v, w;
} state_pair_t;

TF_INLINE state_pair_t paired(const tf_state_t *state,
                              const tf_compensation_t *low) {
  return (state_pair_t){
      {state->r, low->r}, {state->v, low->v}, {state->w, low->w}};
}

TF_INLINE pair_t sine_pair(const tf_compensated_t *k) {
  return (pair_t){k->machine.sin_gamma, k->low_sin_gamma};
}

TF_INLINE pair_t cosine_pair(const tf_compensated_t *k) {
  return (pair_t){k->machine.cos_gamma, k->low_cos_gamma};
}

// (h), (g). In stick h is the small difference of p sin gamma and q cos gamma,
// so it is formed in pairs. g is small beside p and q only where h is not, and
// then it decides nothing: the leading parts of p and q are enough.
TF_INLINE start_t slip_in_pairs(const tf_compensated_t *k,
                                const state_pair_t *state, pair_t omega0) {
  const pair_t z = pair_normalized(pair_difference(state->w, omega0));
  const pair_t p =
      pair_normalized(pair_difference(state->v, pair_times(z, k->machine.d)));
  const pair_t q = pair_product(state->r, z);
  const pair_t h =
      pair_sum(pair_product(sine_pair(k), p), pair_product(cosine_pair(k), q));
  const tf_real_t g = slip_from_pq(&k->machine, p.hi, q.hi).g;
  return (start_t){p.hi, z.hi, {-(h.hi + h.lo), g}, true, true};
}

// (6) in pairs: by how much the change c of p and z fails to solve its rows
//   m dp + a dv - e dz   = dt b,  b = Q_r + F sin gamma
//   J dz + e dp + d a dv = dt t,  t = Q_phi + d Q_r + F r_theta cos gamma + M,
// solved for the change that is missing. theta dt v, a and e are small beside
// r, m and J: tf_real_t is enough for them. M_low is what the rounding of M
// left out.
TF_INLINE change_t refinement(const tf_compensated_t *constants,
                              const state_pair_t *state, const tf_input_t *u,
                              const linear_t *l, tf_force_t f, tf_real_t M_low,
                              change_t c) {
  const tf_machine_t *k = &constants->machine;
  const tf_real_t theta_dt_v = k->theta_dt * state->v.hi;
  const pair_t r_theta = pair_plus(state->r, theta_dt_v),
               mr = pair_times(r_theta, k->m);
  const pair_t mrw = pair_product(mr, state->w),
               mrwv = pair_product(mrw, state->v);
  const pair_t Q_r =
      radial_force_pair(k, u, r_theta, state->v, pair_product(mrw, state->w));
  const pair_t Q_phi = disc_torque_pair(k, u, state->w, pair_sum(mrwv, mrwv));
  const pair_t arm = pair_product(r_theta, cosine_pair(constants));
  const pair_t moment = pair_plus(pair_times(arm, f.F), f.M);
  const pair_t b = pair_sum(Q_r, pair_times(sine_pair(constants), f.F));
  const pair_t t = pair_sum(pair_sum(Q_phi, pair_times(Q_r, k->d)),
                            pair_plus(moment, M_low));
  const pair_t J =
      pair_sum((pair_t){k->inertia, constants->low_inertia},
               pair_product(mr, pair_plus(r_theta, 2 * theta_dt_v)));
  const tf_real_t e = 2 * k->theta_dt * mrw.hi;
  const tf_real_t a_dv = k->a * slider_velocity(k, c.p, c.z);
  const pair_t row_b = pair_difference(
      pair_times(b, k->dt), pair_plus(two_product(k->m, c.p), a_dv - e * c.z));
  const pair_t row_t =
      pair_difference(pair_times(t, k->dt),
                      pair_plus(pair_times(J, c.z), e * c.p + k->d * a_dv));
  const tf_real_t residual_b = (row_b.hi + row_b.lo) / k->dt;
  const tf_real_t residual_t = (row_t.hi + row_t.lo) / k->dt;
  return change_under(l, residual_b, residual_t,
                      residual_t - k->d * residual_b);
}

// What M leaves out: in stick it is s kappa F, which has to be rounded to M.
TF_INLINE tf_real_t moment_remainder(const tf_machine_t *k, unsigned mode,
                                     tf_force_t f) {
  const pair_t M = two_product(k->contact.stick_kappa, f.F);
  if (mode == TF_STICK_PLUS) return (M.hi - f.M) + M.lo;
  if (mode == TF_STICK_MINUS) return -(M.hi + f.M) - M.lo;
  return 0;
}

// from + change, however different their sizes.
TF_INLINE pair_t moved(pair_t from, pair_t change) {
  const pair_t s = two_sum(from.hi, change.hi);
  return fast_two_sum(s.hi, s.lo + (from.lo + change.lo));
}

// (7), (12): from + dt v + theta dt dv. dt v is formed exactly: its rounding
// would have the same sign for as long as v is the same.
TF_INLINE pair_t travelled(const tf_machine_t *k, pair_t from, pair_t v,
                           tf_real_t dv) {
  const pair_t travel = two_product(k->dt, v.hi);
  return moved(
      from, (pair_t){travel.hi, travel.lo + (k->dt * v.lo + k->theta_dt * dv)});
}

// (7): the end of a step under a force and the change that responds to it.
TF_INLINE state_pair_t end_in_pairs(const tf_compensated_t *constants,
                                    const state_pair_t *state,
                                    const tf_input_t *u, const linear_t *l,
                                    unsigned mode, tf_force_t f,
                                    change_t friction) {
  const tf_machine_t *k = &constants->machine;
  const change_t c = {l->free.p + friction.p, l->free.z + friction.z};
  const change_t low =
      refinement(constants, state, u, l, f, moment_remainder(k, mode, f), c);
  const pair_t dz = {c.z, low.z};
  const pair_t dv = pair_sum((pair_t){c.p, low.p}, pair_times(dz, k->d));
  return (state_pair_t){travelled(k, state->r, state->v, dv.hi),
                        moved(state->v, dv), moved(state->w, dz)};
}

// (10): v = 0 and w = omega0 exactly.
TF_INLINE state_pair_t end_at_rest_in_pairs(const tf_machine_t *k,
                                            const state_pair_t *state,
                                            tf_real_t omega0) {
  const pair_t travel = two_product(k->explicit_dt, state->v.hi);
  return (state_pair_t){moved(state->r, travel), {0, 0}, {omega0, 0}};
}

// The compensation of the new state and, where asked for, its angle (12).
TF_INLINE void store_compensation(const tf_machine_t *k, tf_state_t *state,
                                  tf_compensation_t *low,
                                  const state_pair_t *to) {
  pair_t phi = {state->phi, low->phi};
  if (k->with_angle) {
    const pair_t w = {state->w, low->w};
    phi = travelled(k, phi, w, pair_difference(to->w, w).hi);
  }
  state->phi = phi.hi;
  *low = (tf_compensation_t){to->r.lo, to->v.lo, to->w.lo, phi.lo};
}

#endif
