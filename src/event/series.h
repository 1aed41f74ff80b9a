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

// With fewer terms than these a size cannot be predicted from two others.
#define MIN_ORDER 3

typedef struct {
  tf_real_t r, p, z;
} phase_point_t;

typedef struct {
  const tf_machine_t *machine;
  const tf_input_t *input;
  series_t r, p, z, w, q; // motion
  series_t rw, F, M;      // r w, force, moment
  int order;              // of the last terms of the motion
  tf_real_t time;         // for which the series are made [s]
  tf_real_t allowed;      // error over that time [m/s]
  tf_real_t inverse_m;
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2)) at the start
  tf_real_t arm;       // r cos(gamma) at the start
  tf_real_t gyration;  // sqrt(beta^2 + r^2) at the start
  // The sizes of the terms of the velocities at that time, as multiples of that
  // error, and the factor that makes them from those of the last terms.
  tf_real_t size[SERIES_ORDER + 1], power;
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

// Term n of a^2, where equal products are computed once.
TF_INLINE tf_real_t square_term(const series_t *a, int n) {
  tf_real_t sum = 0;
  for (int i = (n - 1) / 2; i > 0; i--) sum += a->c[i] * a->c[n - i];
  sum += sum;
  if (n % 2 == 0) sum += a->c[n / 2] * a->c[n / 2];
  return n == 0 ? sum : sum + 2 * a->c[0] * a->c[n];
}

// The size of the n-th terms of the velocities [m/s^(n+1)]. Times the radius of
// gyration rad/s become m/s, also where r is 0.
TF_INLINE tf_real_t term_size(const taylor_t *motion, int n) {
  return magnitude(motion->p.c[n]) +
         motion->gyration * magnitude(motion->z.c[n]);
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
  motion->rw.c[0] = at.r * motion->w.c[0];
  motion->inverse_m = 1 / k->m;
  const tf_real_t gyration2 = gyration2_at(k, at.r);
  motion->gyration = square_root(gyration2);
  motion->inverse_J = 1 / (k->m * gyration2);
  motion->arm = at.r * k->cos_gamma;
}

// Sums of products of the terms known before term n + 1, without the products
// that have a term 0 or, for r w, of r_n and w_1.
typedef struct {
  tf_real_t r_w;  // term n + 1 of r w, and of r z: from term 2 on z is w
  tf_real_t r_rw; // term n + 1 of r (r w)
  tf_real_t rw_w; // term n of (r w) w
  tf_real_t F_r;  // term n of F r
} motion_sums_t;

// One loop for all: they are so short that each would cost more than its sum.
TF_INLINE motion_sums_t motion_sums(const taylor_t *motion, int n) {
  const tf_real_t *r = motion->r.c, *w = motion->w.c, *rw = motion->rw.c;
  const tf_real_t *F = motion->F.c;
  motion_sums_t sum = {0, 0, 0, 0};
  for (int i = 1; i < n; i++) {
    sum.r_w += r[i] * w[n + 1 - i];
    sum.r_rw += r[i] * rw[n + 1 - i];
    sum.rw_w += rw[i] * w[n - i];
    sum.F_r += F[n - i] * r[i];
  }
  sum.r_rw += r[n] * rw[1];
  sum.F_r += F[0] * r[n];
  sum.rw_w += rw[n] * w[0];
  return sum;
}

// (13), (14): term n + 1 of the motion, but for the terms n of F and M, which
// add_friction_term() adds once the contact has given them. The products with
// the newest terms come last: the others are added while those are still being
// computed.
TF_INLINE void extend_motion(taylor_t *motion, int n) {
  const tf_machine_t *k = motion->machine;
  tf_real_t *r = motion->r.c, *w = motion->w.c, *z = motion->z.c;
  tf_real_t *rw = motion->rw.c;
  const tf_real_t v = slider_velocity(k, motion->p.c[n], z[n]);
  const tf_real_t over = reciprocal[n + 1];
  r[n + 1] = v * over;
  motion_sums_t sum = {0, 0, 0, 0};
  tf_real_t r_w = 0, r_z = 0; // term n + 1 without the term n + 1 of w and z
  if (n > 0) {
    sum = motion_sums(motion, n);
    r_w = sum.r_w + r[n] * w[1];
    r_z = sum.r_w + r[n] * z[1];
  }
  r_w += r[n + 1] * w[0];
  r_z += r[n + 1] * z[0];
  const tf_real_t r2_w = sum.r_rw + r[n + 1] * rw[0] + r[0] * r_w;
  const tf_real_t Q_r =
      radial_force_term(k, motion->input, n, r[n], v, sum.rw_w + rw[0] * w[n]);
  const tf_real_t torque = momentum_rate_term(k, motion->input, n, w[n], Q_r) +
                           sum.F_r * k->cos_gamma;
  motion->p.c[n + 1] = Q_r * (motion->inverse_m * over);
  w[n + 1] =
      torque * (motion->inverse_J * over) - r2_w * (k->m * motion->inverse_J);
  z[n + 1] = w[n + 1];
  if (n == 0) {
    motion->p.c[1] += k->d * motion->input->alpha;
    z[1] -= motion->input->alpha;
  }
  rw[n + 1] = r_w + r[0] * w[n + 1];
  motion->q.c[n + 1] = r_z + r[0] * z[n + 1];
}

// Notes the terms n, and returns whether the series may end with them: over the
// time of the series the last term is allowed as an error, and so is the one
// that would follow it. That one is predicted from the two before the last, so
// that a last term which happens to be 0 does not hide it.
TF_INLINE bool is_long_enough(taylor_t *motion, int n) {
  tf_real_t *size = motion->size;
  motion->order = n;
  motion->power *= motion->time;
  size[n] = term_size(motion, n) * motion->power;
  if (n == 1) {
    motion->allowed = motion->machine->tolerance * (size[0] + size[1]);
    const tf_real_t inverse =
        motion->allowed > 0 ? 1 / motion->allowed : TF_REAL_MAX;
    size[0] *= inverse;
    size[1] *= inverse;
    motion->power *= inverse;
  }
  return n >= MIN_ORDER && size[n] <= 1 &&
         size[n - 1] * size[n - 1] <= size[n - 3];
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
  motion->rw.c[n + 1] += motion->r.c[0] * dz;
  motion->q.c[n + 1] += motion->r.c[0] * dz;
}

#endif
