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

#include "../friction/tyre_law.h"
#include "../model/mechanics.h"
#include "../num/polynomial.h"

// With fewer terms than these a size cannot be predicted from two others.
#define MIN_ORDER 3

typedef struct {
  tf_real_t r, p, z;
} phase_point_t;

typedef struct {
  const tf_machine_t *machine;
  const tf_input_t *input;
  series_t r, p, z, w, q;   // motion
  series_t rw, F, M;        // r w, force, moment
  int order;                // of the last terms of the motion
  tf_real_t time;           // for which the series are made [s]
  tf_real_t allowed;        // error over that time [m/s]
  tf_real_t at_once;        // that part of it which does not grow with the time
  tf_real_t free_p, free_z; // p' and z' without friction, without sign
  tf_real_t speed; // largest velocities at the start of a segment of the step
  tf_real_t inverse_m;
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2)) at the start
  tf_real_t m_over_J;
  tf_real_t length; // that makes rad/s comparable with m/s
  // For SEGMENT_CODIM2_SLIP: a small distance of another slip from this one
  // changes as t^exponent.
  tf_real_t exponent;
} taylor_t;

// The order at which a segment is cut if it needs more.
TF_INLINE int highest_order(const taylor_t *motion) {
  const int is_fine = motion->machine->tolerance < FINE_TOLERANCE;
  return USUAL_ORDER + (SERIES_ORDER - USUAL_ORDER) * is_fine;
}

// An empty sum. What is added to it keeps every bit, so that no addition is
// left where the first summand is known; 0 + x is not x where x is -0.
#define NO_TERMS TF_R(-0.0)

// The sum of a_i a_(n-i) over 0 < i < n, or a_0^2 for n = 0. Equal products are
// computed once.
TF_INLINE tf_real_t inner_square(const series_t *a, int n) {
  const int first = (n - 1) / 2;
  const tf_real_t middle = n % 2 == 0 ? a->c[n / 2] * a->c[n / 2] : NO_TERMS;
  if (first < 1) return middle;
  tf_real_t sum = a->c[first] * a->c[n - first];
  for (int i = first - 1; i > 0; i--) sum += a->c[i] * a->c[n - i];
  sum += sum;
  return n % 2 == 0 ? sum + middle : sum;
}

// Term n of a^2.
TF_INLINE tf_real_t square_term(const series_t *a, int n) {
  const tf_real_t sum = inner_square(a, n);
  return n == 0 ? sum : sum + 2 * (a->c[0] * a->c[n]);
}

// The size of the n-th terms of the velocities [m/s^(n+1)].
TF_INLINE tf_real_t term_size(const taylor_t *motion, int n) {
  return magnitude(motion->p.c[n]) + motion->length * magnitude(motion->z.c[n]);
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
  motion->length = square_root(gyration2);
  motion->m_over_J = 1 / gyration2;
  motion->inverse_J = motion->m_over_J * motion->inverse_m;
}

// Terms n + 1 of p and w without friction, and those of r w and r z without the
// terms n + 1 of w and z.
typedef struct {
  tf_real_t p, w, r_w, r_z;
} next_terms_t;

// (13), (14) without friction, and term n + 1 of r. The products with the
// newest terms come last: the others are added while those are still being
// computed. One loop for all sums: they are so short that each would cost more
// than its sum.
TF_INLINE next_terms_t next_terms(taylor_t *motion, int n) {
  const tf_machine_t *k = motion->machine;
  const tf_real_t *w = motion->w.c, *z = motion->z.c, *rw = motion->rw.c;
  const tf_real_t *F = motion->F.c;
  tf_real_t *r = motion->r.c;
  // Terms n + 1 of r w, which from term 2 on is r z, and of r (r w), and terms
  // n of (r w) w and F r.
  tf_real_t r_w = NO_TERMS, r_z = NO_TERMS, r_rw = NO_TERMS, rw_w = NO_TERMS;
  tf_real_t F_r = NO_TERMS;
  if (n > 0) {
    F_r = F[0] * r[n];
    if (n > 1) {
      r_w = r[n - 1] * w[2];
      r_rw = r[n - 1] * rw[2];
      rw_w = rw[n - 1] * w[1];
      F_r += r[n - 1] * F[1];
    }
    for (int i = n - 2; i > 0; i--) {
      r_w += r[i] * w[n + 1 - i];
      r_rw += r[i] * rw[n + 1 - i];
      rw_w += rw[i] * w[n - i];
      F_r += r[i] * F[n - i];
    }
    r_rw += r[n] * rw[1];
    rw_w += rw[n] * w[0];
    r_z = r_w + r[n] * z[1];
    r_w += r[n] * w[1];
  }
  const tf_real_t v = slider_velocity(k, motion->p.c[n], z[n]);
  const tf_real_t over = reciprocal[n + 1], r_next = v * over;
  r[n + 1] = r_next;
  r_w += r_next * w[0];
  r_z += r_next * z[0];
  const tf_real_t r2_w = r_rw + r[0] * r_w + r_next * rw[0];
  const tf_real_t Q_r =
      radial_force_term(k, motion->input, n, r[n], v, rw_w + rw[0] * w[n]);
  const tf_real_t torque =
      momentum_rate_term(k, motion->input, n, w[n], Q_r) + F_r * k->cos_gamma;
  const tf_real_t p = Q_r * (motion->inverse_m * over);
  return (next_terms_t){
      n == 0 ? p + k->d * motion->input->alpha : p,
      torque * (motion->inverse_J * over) - r2_w * motion->m_over_J, r_w, r_z};
}

// What one unit of what a contact gives, T or lambda, is as F and M, and what
// they add to p' and to w' and z'.
typedef struct {
  tf_real_t F, M, p, z;
} friction_t;

TF_INLINE friction_t friction_of(const taylor_t *motion, tf_real_t F,
                                 tf_real_t M) {
  const tf_machine_t *k = motion->machine;
  const tf_real_t arm = motion->r.c[0] * k->cos_gamma;
  return (friction_t){F, M, F * k->sin_gamma * motion->inverse_m,
                      (F * arm + M) * motion->inverse_J};
}

// Sets the terms n of F and M, from term n of what the contact gives, and with
// them the terms n + 1 of the motion.
TF_INLINE void set_terms(taylor_t *motion, int n, const next_terms_t *next,
                         const friction_t *by, tf_real_t given) {
  const tf_real_t share = given * reciprocal[n + 1], r = motion->r.c[0];
  const tf_real_t w = next->w + by->z * share;
  const tf_real_t z = n == 0 ? w - motion->input->alpha : w;
  if (n == 0) {
    motion->free_p = magnitude(next->p);
    motion->free_z = magnitude(next->w - motion->input->alpha);
  }
  motion->F.c[n] = by->F * given;
  motion->M.c[n] = by->M * given;
  motion->p.c[n + 1] = next->p + by->p * share;
  motion->w.c[n + 1] = w;
  motion->z.c[n + 1] = z;
  motion->rw.c[n + 1] = next->r_w + r * w;
  motion->q.c[n + 1] = next->r_z + r * z;
}

// Times the radius of gyration rad/s become m/s in the norm of the kinetic
// energy, also where r is 0. But a heavy disc has so much of that, that p could
// be off by itself and more: p counts in what z gives v and q as well, whose
// lengths are d and r. So z counts by both: where p and z are off by a share of
// P and Z, by no more than that share of either sum.
TF_INLINE void weigh_heavy_disc(taylor_t *motion) {
  const tf_real_t time = magnitude(motion->time);
  const tf_real_t arm = magnitude(motion->machine->d) +
                        magnitude(motion->r.c[0]) +
                        magnitude(motion->r.c[1]) * time;
  if (!(arm < motion->length)) return;
  const tf_real_t P =
      magnitude(motion->p.c[0]) + magnitude(motion->p.c[1]) * time;
  const tf_real_t Z =
      magnitude(motion->z.c[0]) + magnitude(motion->z.c[1]) * time;
  if (Z > 0) motion->length *= (P + arm * Z) / (P + motion->length * Z);
}

// The sizes of the terms of the velocities at the time of a series, as shares
// of the error allowed, and the factor that makes them from those of the last
// terms.
typedef struct {
  tf_real_t of[SERIES_ORDER + 1], power;
} sizes_t;

// Notes the terms n, and returns whether the series may end with them: over the
// time of the series the last term is allowed as an error, and so is the one
// that would follow it. That one is predicted from the two before the last, so
// that a last term which happens to be 0 does not hide it.
TF_INLINE bool is_long_enough(taylor_t *motion, sizes_t *sizes, int n) {
  // The first call has n = 1, which sets what the others read.
  // cppcheck-suppress ctuuninitvar
  tf_real_t *size = sizes->of;
  motion->order = n;
  if (n == 1) {
    sizes->power = 1;
    weigh_heavy_disc(motion);
  }
  sizes->power *= motion->time;
  size[n] = term_size(motion, n) * sizes->power;
  if (n == 1) {
    size[0] = term_size(motion, 0);
    if (size[0] > motion->speed) motion->speed = size[0];
    // Friction may end the slip at once, the other forces go on.
    const tf_real_t tolerance = motion->machine->tolerance;
    const tf_real_t free =
        (motion->free_p + motion->length * motion->free_z) * sizes->power;
    motion->at_once =
        tolerance * (motion->speed + (free < size[1] ? free : size[1]));
    motion->allowed = tolerance * (motion->speed + size[1]);
    const tf_real_t inverse =
        motion->allowed > 0 ? 1 / motion->allowed : TF_REAL_MAX;
    size[0] *= inverse;
    size[1] *= inverse;
    sizes->power *= inverse;
  }
  return n >= MIN_ORDER && size[n] <= 1 &&
         size[n - 1] * size[n - 1] <= size[n - 3];
}

#endif
