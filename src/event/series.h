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
} phase_point_t;

typedef struct {
  const tf_machine_t *machine;
  const tf_input_t *input;
  series_t r, p, z, w, q; // motion
  series_t r2, w2, F, M;  // r^2, w^2, force, moment
  tf_real_t inverse_m;
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2)) at the start
  tf_real_t arm;       // r cos(gamma) at the start
  // For CONTACT_CODIM2_SLIP: a small distance of another slip from this one
  // changes as t^exponent.
  tf_real_t exponent;
} taylor_t;

// 1/1, 1/2 ... to 1/(SERIES_ORDER + 1): they save a division for each term.
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
TF_INLINE tf_real_t product_term(const series_t *a, const series_t *b, int k) {
  tf_real_t sum = 0;
  for (int i = k; i > 0; i--) sum += a->c[i] * b->c[k - i];
  return sum + a->c[0] * b->c[k];
}

// Term k of a^2, where equal products are computed once.
TF_INLINE tf_real_t square_term(const series_t *a, int k) {
  tf_real_t sum = 0;
  for (int i = (k - 1) / 2; i > 0; i--) sum += a->c[i] * a->c[k - i];
  sum += sum;
  if (k % 2 == 0) sum += a->c[k / 2] * a->c[k / 2];
  return k == 0 ? sum : sum + 2 * a->c[0] * a->c[k];
}

// The terms 0 of the motion.
TF_INLINE void begin_taylor(taylor_t *motion, const tf_machine_t *k,
                            const tf_input_t *input, tf_real_t omega,
                            phase_point_t at) {
  motion->machine = k;
  motion->input = input;
  motion->r.c[0] = at.r;
  motion->p.c[0] = at.p;
  motion->z.c[0] = at.z;
  motion->w.c[0] = at.z + omega;
  motion->q.c[0] = at.r * at.z;
  motion->r2.c[0] = at.r * at.r;
  motion->inverse_m = 1 / k->m;
  motion->inverse_J = 1 / inertia_at(k, at.r);
  motion->arm = at.r * k->cos_gamma;
}

// (13), (14): term n + 1 of the motion, but for the terms n of F and M, which
// add_friction_term() adds once the contact has given them.
TF_INLINE void extend_motion(taylor_t *motion, int n) {
  const tf_machine_t *k = motion->machine;
  const tf_real_t v = motion->p.c[n] + k->d * motion->z.c[n];
  const tf_real_t over = reciprocal[n + 1];
  motion->r.c[n + 1] = v * over;
  motion->w2.c[n] = square_term(&motion->w, n);
  const tf_real_t Q_r =
      radial_force_term(k, motion->input, n, motion->r.c[n], v,
                        product_term(&motion->r, &motion->w2, n));
  tf_real_t torque =
      momentum_rate_term(k, motion->input, n, motion->w.c[n], Q_r);
  tf_real_t F_r = 0; // term n of F r without F_n
  for (int i = 0; i < n; i++) F_r += motion->F.c[i] * motion->r.c[n - i];
  torque += F_r * k->cos_gamma;
  motion->r2.c[n + 1] = square_term(&motion->r, n + 1);
  tf_real_t r2_w = 0; // term n + 1 of r^2 w without w_(n+1)
  for (int i = 1; i <= n + 1; i++)
    r2_w += motion->r2.c[i] * motion->w.c[n + 1 - i];
  motion->p.c[n + 1] = Q_r * (motion->inverse_m * over);
  motion->w.c[n + 1] =
      torque * (motion->inverse_J * over) - r2_w * (k->m * motion->inverse_J);
  motion->z.c[n + 1] = motion->w.c[n + 1];
  if (n == 0) {
    motion->p.c[1] += k->d * motion->input->alpha;
    motion->z.c[1] -= motion->input->alpha;
  }
  motion->q.c[n + 1] = product_term(&motion->r, &motion->z, n + 1);
}

// Sets the terms n of F and M and adds what they do to term n + 1 of the
// motion.
TF_INLINE void add_friction_term(taylor_t *motion, int n, tf_real_t F,
                                 tf_real_t M) {
  const tf_machine_t *k = motion->machine;
  const tf_real_t over = reciprocal[n + 1];
  const tf_real_t dz = (F * motion->arm + M) * (motion->inverse_J * over);
  motion->F.c[n] = F;
  motion->M.c[n] = M;
  motion->p.c[n + 1] += F * (k->sin_gamma * motion->inverse_m * over);
  motion->w.c[n + 1] += dz;
  motion->z.c[n + 1] += dz;
  motion->q.c[n + 1] += motion->r.c[0] * dz;
}

#endif
