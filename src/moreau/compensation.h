// What a compensated step does otherwise than a plain one. The machine is at
// x = state + carry. Its step is solved with the digits of tf_real_t, but
// * h at the start is that of x: an error of epsilon there would be one of
//   epsilon h / dt in the force that holds the stick, while one of epsilon in
//   a coefficient is no more than that in an increment;
// * at the end the increments of p and z are refined once: the residual of (6)
//   is formed in pairs, and the inverse that solved for them solves for what
//   they lack. So an epsilon in a coefficient costs an epsilon of an epsilon.
#ifndef TF_COMPENSATION_H
#define TF_COMPENSATION_H

#include "../num/pair.h"
#include "linear.h"
#include "twofold/compensated.h"

// What is known beyond tf_real_t.
typedef struct {
  const tf_compensated_t *constants;
  const tf_compensation_t *carry;
} digits_t;

// The state, all digits.
typedef struct {
  pair_t r, v, w;
} whole_t;

TF_INLINE whole_t whole(const tf_state_t *x, const tf_compensation_t *carry) {
  return (whole_t){{x->r, carry->r}, {x->v, carry->v}, {x->w, carry->w}};
}

TF_INLINE pair_t whole_sine(const tf_compensated_t *k) {
  return (pair_t){k->machine.sin_gamma, k->low_sin_gamma};
}

TF_INLINE pair_t whole_cosine(const tf_compensated_t *k) {
  return (pair_t){k->machine.cos_gamma, k->low_cos_gamma};
}

typedef struct {
  tf_slip_t slip;
  tf_real_t p, z;
} motion_at_t;

// (h), (g). In stick h is the small difference of p sin gamma and
// q cos gamma, so it is formed from pairs. g is small beside p and q only where
// h is not, and then decides nothing: there the digits of p and q will do.
TF_INLINE motion_at_t motion_at(const tf_compensated_t *k, const whole_t *x,
                                tf_real_t omega0) {
  const pair_t z = tidy(plus_number(x->w, -omega0));
  const pair_t p = tidy(difference(x->v, scaled(z, k->machine.d)));
  const pair_t q = product(x->r, z);
  const pair_t h =
      added(product(whole_sine(k), p), product(whole_cosine(k), q));
  const tf_real_t g = q.hi * k->machine.sin_gamma - p.hi * k->machine.cos_gamma;
  return (motion_at_t){{-(h.hi + h.lo), g}, p.hi, z.hi};
}

// The slip at the start of a step; p and z there are differences too.
TF_INLINE tf_slip_t start_slip(const digits_t *more, const tf_state_t *state,
                               tf_linear_t *l) {
  const whole_t x = whole(state, more->carry);
  const motion_at_t at = motion_at(more->constants, &x, l->omega0);
  l->p = at.p;
  l->z = at.z;
  return at.slip;
}

// The slip after a change of p and z: that at the start and its change, which
// keeps its digits however small h is.
TF_INLINE tf_slip_t slip_after(const tf_machine_t *k, const tf_state_t *x,
                               const tf_linear_t *l, tf_slip_t now,
                               tf_change_t c) {
  const tf_real_t dr = k->dt * x->v + k->theta_dt * (c.p + k->d * c.z);
  const tf_slip_t by = slip_from_pq(k, c.p, x->r * c.z + (l->z + c.z) * dr);
  return (tf_slip_t){now.h + by.h, now.g + by.g};
}

// What the change c of p and z lacks of solving (6), whose rows are here
//   m dp + a dv - e dz   = dt b,  b = Q_r + F sin gamma
//   J dz + e dp + d a dv = dt t,  t = Q_phi + d Q_r + F r_t cos gamma + M
// theta dt v, a and e are small beside r, m and J: the digits of tf_real_t do
// for them. M_low is what M leaves out.
TF_INLINE tf_change_t lacking(const tf_compensated_t *more, const whole_t *x,
                              const tf_input_t *u, const tf_linear_t *l,
                              tf_force_t f, tf_real_t M_low, tf_change_t c) {
  const tf_machine_t *k = &more->machine;
  const tf_real_t hv = k->theta_dt * x->v.hi;
  const pair_t rt = plus_number(x->r, hv), mr = scaled(rt, k->m);
  const pair_t mrw = product(mr, x->w), mrwv = product(mrw, x->v);
  const pair_t Q_r = radial_force_pair(k, u, rt, x->v, product(mrw, x->w));
  const pair_t Q_phi = disc_torque_pair(k, u, x->w, added(mrwv, mrwv));
  const pair_t arm = product(rt, whole_cosine(more));
  const pair_t moment = plus_number(scaled(arm, f.F), f.M);
  const pair_t b = added(Q_r, scaled(whole_sine(more), f.F));
  const pair_t t =
      added(added(Q_phi, scaled(Q_r, k->d)), plus_number(moment, M_low));
  const pair_t J = added((pair_t){k->inertia, more->low_inertia},
                         product(mr, plus_number(rt, 2 * hv)));
  const tf_real_t e = 2 * k->theta_dt * mrw.hi;
  const tf_real_t a_dv = k->a * (c.p + k->d * c.z);
  const pair_t rest_b = difference(
      scaled(b, k->dt), plus_number(two_product(k->m, c.p), a_dv - e * c.z));
  const pair_t rest_t = difference(
      scaled(t, k->dt), plus_number(scaled(J, c.z), e * c.p + k->d * a_dv));
  const tf_real_t lack_b = (rest_b.hi + rest_b.lo) / k->dt;
  const tf_real_t lack_t = (rest_t.hi + rest_t.lo) / k->dt;
  return answer(l, lack_b, lack_t, lack_t - k->d * lack_b);
}

// What M leaves out: in stick it is s kappa F, which has to be rounded to M.
TF_INLINE tf_real_t moment_rest(const tf_machine_t *k, unsigned mode,
                                tf_force_t f) {
  const pair_t M = two_product(k->stick_kappa, f.F);
  if (mode == TF_STICK_PLUS) return (M.hi - f.M) + M.lo;
  if (mode == TF_STICK_MINUS) return -(M.hi + f.M) - M.lo;
  return 0;
}

// x + change, however far apart.
TF_INLINE pair_t moved(pair_t x, pair_t change) {
  const pair_t s = two_sum(x.hi, change.hi);
  return fast_two_sum(s.hi, s.lo + (x.lo + change.lo));
}

// (7), (12): x + dt v + theta dt dv. dt v is formed exactly: its rounding would
// have the same sign for as long as v is the same.
TF_INLINE pair_t travelled(const tf_machine_t *k, pair_t x, pair_t v,
                           tf_real_t dv) {
  const pair_t way = two_product(k->dt, v.hi);
  return moved(x, (pair_t){way.hi, way.lo + (k->dt * v.lo + k->theta_dt * dv)});
}

// The end of a step under a force and the change that answers it.
TF_INLINE whole_t whole_end(const tf_compensated_t *more, const whole_t *x,
                            const tf_input_t *u, const tf_linear_t *l,
                            tf_force_t f, tf_real_t M_low, tf_change_t c) {
  const tf_machine_t *k = &more->machine;
  const tf_change_t rest = lacking(more, x, u, l, f, M_low, c);
  const pair_t dz = {c.z, rest.z};
  const pair_t dv = added((pair_t){c.p, rest.p}, scaled(dz, k->d));
  return (whole_t){travelled(k, x->r, x->v, dv.hi), moved(x->v, dv),
                   moved(x->w, dz)};
}

// The end of a pinned step: v = 0, w = omega0 without a rest.
TF_INLINE whole_t whole_rest(const tf_machine_t *k, const whole_t *x,
                             tf_real_t omega0) {
  const pair_t way = two_product(k->explicit_dt, x->v.hi);
  return (whole_t){moved(x->r, way), {0, 0}, {omega0, 0}};
}

// The carry of the new state and, where asked for, its angle.
TF_INLINE void carry_on(const tf_compensated_t *more, tf_state_t *state,
                        tf_compensation_t *carry, const whole_t *to) {
  const tf_machine_t *k = &more->machine;
  pair_t phi = {state->phi, carry->phi};
  if (k->with_angle) {
    const pair_t w = {state->w, carry->w};
    phi = travelled(k, phi, w, difference(to->w, w).hi);
  }
  state->phi = phi.hi;
  *carry = (tf_compensation_t){to->r.lo, to->v.lo, to->w.lo, phi.lo};
}

#endif
