// The motion between two events as Taylor series in time. With z = w - omega0,
// p = v - d z, q = r z and the angular momentum m (beta^2 + r^2) w:
//   r' = p + d z,   m p' = Q_r + F sin(gamma) + m d alpha              (13)
//   (m (beta^2 + r^2) w)' = torque - c1 w + d Q_r + F r cos(gamma) + M (14)
// As in every Taylor series method (Jorba and Zou 2005) each term follows from
// those before it, and a product of two series costs one sum per term. Term n
// of F and M enters term n + 1 of p and z linearly, so each contact closes the
// recurrence in closed form (taylor.c).
#ifndef TF_SERIES_H
#define TF_SERIES_H

#include "../model/mechanics.h"
#include "../model/tyre_law.h"
#include "../num/polynomial.h"

typedef struct {
  tf_real_t r, p, z;
} tf_phase_point_t;

typedef struct {
  const tf_machine_t *machine;
  const tf_input_t *input;
  tf_series_t r, p, z, w, q; // motion
  tf_series_t r2, w2, F, M;  // r^2, w^2, force, moment
  tf_real_t inverse_m;
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2)) at the start
  tf_real_t arm;       // r cos(gamma) at the start
  // For TF_CONTACT_CODIM2_SLIP: a small distance of another slip from this one
  // changes as t^exponent.
  tf_real_t exponent;
} tf_taylor_t;

// 1/1, 1/2 ... to 1/(TF_ORDER + 1): they save a division for each term.
static const tf_real_t reciprocal[] = {
    0,
    TF_R(1.0) / 1,
    TF_R(1.0) / 2,
    TF_R(1.0) / 3,
    TF_R(1.0) / 4,
    TF_R(1.0) / 5,
    TF_R(1.0) / 6,
    TF_R(1.0) / 7,
    TF_R(1.0) / 8,
    TF_R(1.0) / 9,
};

// Term k of a b, the sum of a_i b_(k-i) for i = 0 to k. The newest term of b
// comes last: all others are added while that one is still being computed.
TF_INLINE tf_real_t product_term(const tf_series_t *a, const tf_series_t *b,
                                 int k) {
  tf_real_t sum = 0;
  for (int i = k; i > 0; i--) sum += a->c[i] * b->c[k - i];
  return sum + a->c[0] * b->c[k];
}

// Term k of a^2, where equal products are computed once.
TF_INLINE tf_real_t square_term(const tf_series_t *a, int k) {
  tf_real_t sum = 0;
  for (int i = (k - 1) / 2; i > 0; i--) sum += a->c[i] * a->c[k - i];
  sum += sum;
  if (k % 2 == 0) sum += a->c[k / 2] * a->c[k / 2];
  return k == 0 ? sum : sum + 2 * a->c[0] * a->c[k];
}

// The terms 0 of the motion.
TF_INLINE void begin_taylor(tf_taylor_t *x, const tf_machine_t *k,
                            const tf_input_t *input, tf_real_t omega,
                            tf_phase_point_t at) {
  x->machine = k;
  x->input = input;
  x->r.c[0] = at.r;
  x->p.c[0] = at.p;
  x->z.c[0] = at.z;
  x->w.c[0] = at.z + omega;
  x->q.c[0] = at.r * at.z;
  x->r2.c[0] = at.r * at.r;
  x->inverse_m = 1 / k->m;
  x->inverse_J = 1 / inertia_at(k, at.r);
  x->arm = at.r * k->cos_gamma;
}

// (13), (14): term n + 1 of the motion, but for the terms n of F and M, which
// add_friction_term() adds once the contact has given them.
TF_INLINE void extend_motion(tf_taylor_t *x, int n) {
  const tf_machine_t *k = x->machine;
  const tf_real_t v = x->p.c[n] + k->d * x->z.c[n];
  const tf_real_t over = reciprocal[n + 1];
  x->r.c[n + 1] = v * over;
  x->w2.c[n] = square_term(&x->w, n);
  const tf_real_t Q_r = radial_force_term(k, x->input, n, x->r.c[n], v,
                                          product_term(&x->r, &x->w2, n));
  tf_real_t torque = momentum_rate_term(k, x->input, n, x->w.c[n], Q_r);
  tf_real_t F_r = 0; // term n of F r without F_n
  for (int i = 0; i < n; i++) F_r += x->F.c[i] * x->r.c[n - i];
  torque += F_r * k->cos_gamma;
  x->r2.c[n + 1] = square_term(&x->r, n + 1);
  tf_real_t r2_w = 0; // term n + 1 of r^2 w without w_(n+1)
  for (int i = 1; i <= n + 1; i++) r2_w += x->r2.c[i] * x->w.c[n + 1 - i];
  x->p.c[n + 1] = Q_r * (x->inverse_m * over);
  x->w.c[n + 1] = torque * (x->inverse_J * over) - r2_w * (k->m * x->inverse_J);
  x->z.c[n + 1] = x->w.c[n + 1];
  if (n == 0) {
    x->p.c[1] += k->d * x->input->alpha;
    x->z.c[1] -= x->input->alpha;
  }
  x->q.c[n + 1] = product_term(&x->r, &x->z, n + 1);
}

// Sets the terms n of F and M and adds what they do to term n + 1 of the
// motion.
TF_INLINE void add_friction_term(tf_taylor_t *x, int n, tf_real_t F,
                                 tf_real_t M) {
  const tf_machine_t *k = x->machine;
  const tf_real_t over = reciprocal[n + 1];
  const tf_real_t dz = (F * x->arm + M) * (x->inverse_J * over);
  x->F.c[n] = F;
  x->M.c[n] = M;
  x->p.c[n + 1] += F * (k->sin_gamma * x->inverse_m * over);
  x->w.c[n + 1] += dz;
  x->z.c[n + 1] += dz;
  x->q.c[n + 1] += x->r.c[0] * dz;
}

#endif
