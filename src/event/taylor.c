// Series of a segment: each law of contact closes the recurrence its own way.
#include "segment.h"

#define MOST_SHORTENINGS 64

// Slip: T(y) = tan(a atan y) with y = g/h makes T' = a (1 + T^2) psi', psi' =
// (g' h - g h')/(h^2 + g^2), which is the same in (p, q): h, g are those
// turned by gamma. So T needs its kernel once a segment.
typedef struct {
  tf_series_t T, psi;   // T and psi'
  tf_series_t R2;       // h^2 + g^2, or the same over t^2
  tf_real_t inverse_R2; // of its first term
} angle_t;

// Term n of p' q - q' p from terms low to n + 1 - low of p and q: low is 1
// where both start with t.
TF_INLINE tf_real_t cross(const tf_taylor_t *s, int n, int low) {
  tf_real_t sum = 0;
  for (int i = low; i <= n + 1 - low; i++)
    sum += (tf_real_t)(2 * i - (n + 1)) * s->p.c[i] * s->q.c[n + 1 - i];
  return sum;
}

// Term n of psi' from term n + shift of the cross product.
TF_INLINE tf_real_t psi_term(angle_t *a, int n, tf_real_t crossed) {
  for (int i = 1; i <= n; i++) crossed -= a->R2.c[i] * a->psi.c[n - i];
  return crossed * a->inverse_R2;
}

// Term n >= 1 of T.
TF_INLINE tf_real_t T_term(const angle_t *a, const tf_series_t *square_T,
                           tf_real_t exponent, int n) {
  tf_real_t sum = a->psi.c[n - 1];
  for (int i = 0; i < n; i++) sum += square_T->c[i] * a->psi.c[n - 1 - i];
  return exponent * sum * tf_inverse[n];
}

TF_INLINE void apply_T(tf_taylor_t *s, const tf_segment_t *g, int n,
                       tf_real_t T) {
  const tf_tyre_t *tyre = &s->machine->tyre;
  tf_real_t F = -(tf_real_t)g->roll * tyre->mu * tyre->inv_18_kappa * T;
  if (n == 0) F += (tf_real_t)g->side * tyre->mu * 4 / 3;
  apply(s, n, F, tyre->mu / 6 * T);
}

static void taylor_slip(tf_taylor_t *s, const tf_segment_t *g) {
  const tf_tyre_t *tyre = &s->machine->tyre;
  const tf_slip_t slip = slip_from_pq(s->machine, s->p.c[0], s->q.c[0]);
  const tf_real_t H = (tf_real_t)g->side * slip.h;
  const tf_real_t G = (tf_real_t)g->roll * slip.g;
  angle_t a = {.inverse_R2 =
                   1 / (s->p.c[0] * s->p.c[0] + s->q.c[0] * s->q.c[0])};
  tf_series_t TT;
  a.T.c[0] = (tf_real_t)(g->side * g->roll) *
             cot_psi(tyre, G > 0 ? G : 0, H > 0 ? H : 0);
  extend(s, 0);
  apply_T(s, g, 0, a.T.c[0]);
  for (int n = 1; n < TF_ORDER; n++) {
    a.R2.c[n - 1] = series_square(&s->p, n - 1) + series_square(&s->q, n - 1);
    a.psi.c[n - 1] = psi_term(&a, n - 1, cross(s, n - 1, 0));
    TT.c[n - 1] = series_square(&a.T, n - 1);
    a.T.c[n] = T_term(&a, &TT, tyre->T_series[0], n);
    extend(s, n);
    apply_T(s, g, n, a.T.c[n]);
  }
}

// From h = g = 0: p and q start with t, so psi' is that of p/t and q/t, and its
// term n - 1 needs terms n + 1 of p and q, which T_n enters linearly: T_n is
// what it would be without, over 1 - gain. The gain is the pull of the limit
// direction; away from a resonance it is not 1.
static void taylor_codim2_slip(tf_taylor_t *s, const tf_segment_t *g) {
  const tf_tyre_t *tyre = &s->machine->tyre;
  angle_t a = {.inverse_R2 = 0};
  tf_series_t TT;
  a.T.c[0] = (tf_real_t)(g->side * g->roll) * g->T;
  extend(s, 0);
  apply_T(s, g, 0, a.T.c[0]);
  a.R2.c[0] = s->p.c[1] * s->p.c[1] + s->q.c[1] * s->q.c[1];
  a.inverse_R2 = 1 / a.R2.c[0];
  const tf_real_t F = -(tf_real_t)g->roll * tyre->mu * tyre->inv_18_kappa;
  const tf_real_t dp = F * s->machine->sin_gamma / s->machine->m;
  const tf_real_t dq = s->r.c[0] * (F * s->arm + tyre->mu / 6) * s->inverse_J;
  const tf_real_t gain = tyre->T_series[0] * (1 + a.T.c[0] * a.T.c[0]) *
                         (dp * s->q.c[1] - s->p.c[1] * dq) / a.R2.c[0];
  s->exponent = gain - 1;
  for (int n = 1; n < TF_ORDER; n++) {
    extend(s, n);
    a.psi.c[n - 1] = psi_term(&a, n - 1, cross(s, n + 1, 1));
    TT.c[n - 1] = series_square(&a.T, n - 1);
    const tf_real_t T =
        T_term(&a, &TT, tyre->T_series[0], n) / (1 - gain * tf_inverse[n + 1]);
    a.T.c[n] = T;
    apply_T(s, g, n, T);
    a.psi.c[n - 1] = psi_term(&a, n - 1, cross(s, n + 1, 1));
    tf_real_t R2 = 0;
    for (int i = 1; i <= n + 1; i++)
      R2 += s->p.c[i] * s->p.c[n + 2 - i] + s->q.c[i] * s->q.c[n + 2 - i];
    a.R2.c[n] = R2;
  }
}

// The lateral slip that term n of p and q holds.
TF_INLINE tf_real_t lateral(const tf_taylor_t *s, int n) {
  return slip_from_pq(s->machine, s->p.c[n], s->q.c[n]).h;
}

// Stick: term n + 1 of h is (n+1)^-1 (what it is without lambda_n - A
// lambda_n) and has to be 0.
TF_INLINE void apply_lambda(tf_taylor_t *s, const tf_segment_t *g, int n,
                            tf_real_t lambda) {
  apply(s, n, lambda, (tf_real_t)g->roll * s->machine->stick_kappa * lambda);
}

TF_INLINE tf_real_t delassus(const tf_taylor_t *s, int roll) {
  const tf_machine_t *k = s->machine;
  const tf_real_t turn = s->arm + (tf_real_t)roll * k->stick_kappa;
  return delassus_from(k, s->arm * turn * s->inverse_J);
}

static bool taylor_stick(tf_taylor_t *s, const tf_segment_t *g) {
  const tf_real_t A = delassus(s, g->roll);
  if (A == 0) return false;
  const tf_real_t inverse = 1 / A;
  for (int n = 0; n < TF_ORDER; n++) {
    extend(s, n);
    apply_lambda(s, g, n, lateral(s, n + 1) * (tf_real_t)(n + 1) * inverse);
  }
  return true;
}

// At a two-fold A = 0: term n + 1 of h no longer holds lambda_n but lambda_n-1,
// linearly, through term n of the motion. Two trials give the line.
static bool taylor_two_fold(tf_taylor_t *s, const tf_segment_t *g) {
  extend(s, 0);
  for (int n = 1; n < TF_ORDER; n++) {
    tf_real_t rest[2];
    for (int trial = 0; trial < 2; trial++) {
      extend(s, n - 1);
      apply_lambda(s, g, n - 1, (tf_real_t)trial);
      extend(s, n);
      rest[trial] = lateral(s, n + 1);
    }
    const tf_real_t slope = rest[0] - rest[1];
    if (slope == 0) return false;
    extend(s, n - 1);
    apply_lambda(s, g, n - 1, rest[0] / slope);
    extend(s, n);
  }
  // lambda_(N-1) would need term N + 1: it is left 0.
  apply_lambda(s, g, TF_ORDER - 1, 0);
  return true;
}

static void taylor_constant(tf_taylor_t *s, tf_real_t F) {
  for (int n = 0; n < TF_ORDER; n++) {
    extend(s, n);
    apply(s, n, n == 0 ? F : 0, 0);
  }
}

// Pinned: r rests, w goes with the turntable, and F and M are whatever keeps
// them there: F = -(Q_r + m d alpha)/sin gamma, M from the balance of torques.
// With sin gamma = 0 nothing is pinned (rates.h).
static void taylor_pinned(tf_taylor_t *s) {
  const tf_machine_t *k = s->machine;
  const tf_real_t r = s->r.c[0], w = s->w.c[0], alpha = s->input->alpha;
  for (int n = 0; n <= TF_ORDER; n++)
    s->r.c[n] = s->p.c[n] = s->z.c[n] = s->w.c[n] = s->q.c[n] = s->F.c[n] =
        s->M.c[n] = 0;
  s->r.c[0] = r;
  s->w.c[0] = w;
  s->w.c[1] = alpha;
  const tf_real_t centrifugal[3] = {w * w, 2 * w * alpha, alpha * alpha};
  for (int n = 0; n < 3; n++) {
    tf_real_t Q_r = k->m * r * centrifugal[n];
    if (n == 0) Q_r += k->k2 * (s->input->r0 - r) + s->input->force;
    tf_real_t F = -Q_r, Q_phi = -k->c1 * s->w.c[n] + k->d * Q_r;
    if (n == 0) {
      F -= k->m * k->d * alpha;
      Q_phi += s->input->torque - alpha / s->inverse_J;
    }
    s->F.c[n] = F / k->sin_gamma;
    s->M.c[n] = -Q_phi - s->F.c[n] * s->arm;
  }
}

TF_API bool tf_taylor_coefficients(tf_taylor_t *s, const tf_segment_t *g) {
  s->F.c[TF_ORDER] = s->M.c[TF_ORDER] = 0;
  switch (g->closure) {
    case TF_CONTACT_NONE:
      taylor_constant(s, 0);
      return true;
    case TF_CONTACT_SLIP:
      if (s->machine->tyre.law == TF_TYRE_COULOMB)
        taylor_constant(s, (tf_real_t)g->side * s->machine->tyre.mu);
      else
        taylor_slip(s, g);
      return true;
    case TF_CONTACT_CODIM2_SLIP:
      taylor_codim2_slip(s, g);
      return true;
    case TF_CONTACT_STICK:
      return taylor_stick(s, g);
    case TF_CONTACT_TWO_FOLD_STICK:
      return taylor_two_fold(s, g);
    case TF_CONTACT_PINNED:
    default:
      taylor_pinned(s);
      return true;
  }
}

TF_API tf_real_t tf_angle_change(const tf_taylor_t *s, tf_real_t t) {
  tf_real_t sum = 0;
  for (int n = TF_ORDER; n >= 0; n--)
    sum = (sum + s->w.c[n] * tf_inverse[n + 1]) * t;
  return sum;
}

// The radius of gyration turns rad/s into m/s where r is 0.
TF_API tf_real_t tf_term_size(const tf_taylor_t *s, int n) {
  const tf_real_t gyration = square_root(s->machine->beta2 + s->rr.c[0]);
  return magnitude(s->p.c[n]) + gyration * magnitude(s->z.c[n]);
}

TF_API tf_real_t tf_segment_length(const tf_taylor_t *s, tf_real_t time,
                                   tf_real_t allowed) {
  const tf_real_t last = tf_term_size(s, TF_ORDER);
  const tf_real_t before = tf_term_size(s, TF_ORDER - 1);
  for (int i = 0; i < MOST_SHORTENINGS; i++) {
    tf_real_t tail = before + last * magnitude(time);
    for (int n = 1; n < TF_ORDER; n++) tail *= magnitude(time);
    if (tail <= allowed) return time;
    time *= TF_R(0.75);
  }
  return 0;
}
