// The motion between two switches as Taylor series in time. With z = w -
// omega0, p = v - d z, q = r z, angular momentum m (beta^2 + r^2) w:
//   r' = p + d z
//   m p' = Q_r + F sin(gamma) + m d alpha
//   (m (beta^2 + r^2) w)' = torque - c1 w + d Q_r + F r cos(gamma) + M
//   Q_r = k2 (r0 - r) - c2 v + m r w^2 + force
// every product of two series costs one sum, and the k-th terms of F and M
// enter the next terms of p and z linearly: so each law of contact closes the
// recurrence in closed form.
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
  tf_series_t rr, w2, F, M;  // r^2, w^2, force, moment
  tf_real_t inverse_m;
  tf_real_t inverse_J; // 1 / (m (beta^2 + r^2)) at the start
  tf_real_t arm;       // r cos(gamma) at the start
  tf_real_t
      exponent; // of TF_CONTACT_CODIM2_SLIP: its neighbours go with t^exponent
} tf_taylor_t;

// 1/1, 1/2 ... to 1/(TF_ORDER + 1): a division less per term.
static const tf_real_t tf_inverse[] = {
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

// Sum of a_i b_(k-i), i = 0 to k. The newest term of b comes last: all before
// it is added while that is still being computed.
TF_INLINE tf_real_t series_product(const tf_series_t *a, const tf_series_t *b,
                                   int k) {
  tf_real_t sum = 0;
  for (int i = k; i > 0; i--) sum += a->c[i] * b->c[k - i];
  return sum + a->c[0] * b->c[k];
}

// The same for a = b.
TF_INLINE tf_real_t series_square(const tf_series_t *a, int k) {
  tf_real_t sum = 0;
  for (int i = (k - 1) / 2; i > 0; i--) sum += a->c[i] * a->c[k - i];
  sum += sum;
  if (k % 2 == 0) sum += a->c[k / 2] * a->c[k / 2];
  return k == 0 ? sum : sum + 2 * a->c[0] * a->c[k];
}

TF_INLINE void begin_taylor(tf_taylor_t *s, const tf_machine_t *k,
                            const tf_input_t *input, tf_real_t omega,
                            tf_phase_point_t at) {
  s->machine = k;
  s->input = input;
  s->r.c[0] = at.r;
  s->p.c[0] = at.p;
  s->z.c[0] = at.z;
  s->w.c[0] = at.z + omega;
  s->q.c[0] = at.r * at.z;
  s->rr.c[0] = at.r * at.r;
  s->inverse_m = 1 / k->m;
  s->inverse_J = 1 / inertia_at(k, at.r);
  s->arm = at.r * k->cos_gamma;
}

// Term n+1 of the motion without the n-th terms of F and M.
TF_INLINE void extend(tf_taylor_t *s, int n) {
  const tf_machine_t *k = s->machine;
  const tf_real_t v = s->p.c[n] + k->d * s->z.c[n];
  const tf_real_t over = tf_inverse[n + 1];
  s->r.c[n + 1] = v * over;
  s->w2.c[n] = series_square(&s->w, n);
  const tf_real_t Q_r = radial_force_term(k, s->input, n, s->r.c[n], v,
                                          series_product(&s->r, &s->w2, n));
  tf_real_t Q_phi = momentum_rate_term(k, s->input, n, s->w.c[n], Q_r);
  tf_real_t moved = 0; // F r beyond the n-th term of F
  for (int i = 0; i < n; i++) moved += s->F.c[i] * s->r.c[n - i];
  Q_phi += moved * k->cos_gamma;
  s->rr.c[n + 1] = series_square(&s->r, n + 1);
  tf_real_t carried = 0;
  for (int i = 1; i <= n + 1; i++) carried += s->rr.c[i] * s->w.c[n + 1 - i];
  s->p.c[n + 1] = Q_r * (s->inverse_m * over);
  s->w.c[n + 1] =
      Q_phi * (s->inverse_J * over) - carried * (k->m * s->inverse_J);
  s->z.c[n + 1] = s->w.c[n + 1];
  if (n == 0) {
    s->p.c[1] += k->d * s->input->alpha;
    s->z.c[1] -= s->input->alpha;
  }
  s->q.c[n + 1] = series_product(&s->r, &s->z, n + 1);
}

// Adds what the n-th terms of F and M do to term n+1.
TF_INLINE void apply(tf_taylor_t *s, int n, tf_real_t F, tf_real_t M) {
  const tf_machine_t *k = s->machine;
  const tf_real_t over = tf_inverse[n + 1];
  const tf_real_t dz = (F * s->arm + M) * (s->inverse_J * over);
  s->F.c[n] = F;
  s->M.c[n] = M;
  s->p.c[n + 1] += F * (k->sin_gamma * s->inverse_m * over);
  s->w.c[n + 1] += dz;
  s->z.c[n + 1] += dz;
  s->q.c[n + 1] += s->r.c[0] * dz;
}

#endif
