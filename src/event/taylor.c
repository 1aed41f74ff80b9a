// The Taylor coefficients of a segment: each contact closes the recurrence of
// (13), (14) in its own form.
#include "../friction/rest_motion.h"
#include "segment.h"

// Each shortening takes a quarter off a segment.
#define MAX_SHORTENINGS 64
#define SHORTENING TF_R(0.75)

// (15). In slip the force goes with T(y) = tan(a atan y), y = |g/h|, and
// T' = a (1 + T^2) psi' with psi' = (g' h - g h')/(h^2 + g^2). That rate is the
// same in (p, q), because (h, g) is (p, q) turned by gamma. So the kernel of T
// is evaluated once a segment.
typedef struct {
  series_t T, psi_rate; // T and psi'
  series_t T2;          // T^2
  series_t R2;          // p^2 + q^2; from h = g = 0 that over t^2
  tf_real_t inverse_R2; // 1 over its term 0
} slip_angle_t;

// Term n of p' q - q' p where both begin with t.
TF_INLINE tf_real_t cross_term(const taylor_t *motion, int n) {
  tf_real_t sum = 0;
  for (int i = 1; i <= n; i++)
    sum +=
        (tf_real_t)(2 * i - (n + 1)) * motion->p.c[i] * motion->q.c[n + 1 - i];
  return sum;
}

// Term n of psi' from that term of its numerator.
TF_INLINE tf_real_t psi_rate_term(slip_angle_t *angle, int n,
                                  tf_real_t numerator) {
  for (int i = 1; i <= n; i++)
    numerator -= angle->R2.c[i] * angle->psi_rate.c[n - i];
  return numerator * angle->inverse_R2;
}

// Term n >= 1 of T from T' = a (1 + T^2) psi'.
TF_INLINE tf_real_t T_term(const slip_angle_t *angle, tf_real_t a, int n) {
  tf_real_t sum = angle->psi_rate.c[n - 1];
  for (int i = 0; i < n; i++)
    sum += angle->T2.c[i] * angle->psi_rate.c[n - 1 - i];
  return a * sum * reciprocal[n];
}

// (force), (moment): the series of T has the sign of g h, so that F1 goes by
// the sign of g and M1 by none.
TF_INLINE void add_tyre_term(taylor_t *motion, const segment_t *segment, int n,
                             tf_real_t T) {
  const tf_tyre_t *tyre = &motion->machine->tyre;
  tf_real_t F = slip_F1(tyre, (tf_real_t)segment->sign_g) * T;
  if (n == 0) F += slip_F0(tyre, (tf_real_t)segment->sign_h);
  add_friction_term(motion, n, F, slip_M1(tyre, 1) * T);
}

// Terms n - 1 of R^2, T^2 and psi' and the sum for T_n, in two loops: term by
// term as above, but the sums are so short that each loop would cost more.
static tf_real_t next_slip_angle(const taylor_t *motion, slip_angle_t *angle,
                                 tf_real_t a, int n) {
  const tf_real_t *p = motion->p.c, *q = motion->q.c, *T = angle->T.c;
  tf_real_t *psi_rate = angle->psi_rate.c;
  tf_real_t R2 = 0, T2 = 0, weight = (tf_real_t)n;
  tf_real_t cross = weight * p[n] * q[0]; // term n - 1 of p' q - q' p
  for (int i = 0; i < n; i++) {
    R2 += p[i] * p[n - 1 - i] + q[i] * q[n - 1 - i];
    T2 += T[i] * T[n - 1 - i];
    cross -= weight * p[i] * q[n - i];
    weight -= 2;
  }
  angle->R2.c[n - 1] = R2;
  angle->T2.c[n - 1] = T2;
  tf_real_t sum = 0;
  for (int i = 1; i < n; i++) {
    cross -= angle->R2.c[i] * psi_rate[n - 1 - i];
    sum += angle->T2.c[i] * psi_rate[n - 1 - i];
  }
  psi_rate[n - 1] = cross * angle->inverse_R2;
  sum += (1 + angle->T2.c[0]) * psi_rate[n - 1];
  return a * sum * reciprocal[n];
}

// (15) away from h = g = 0.
static void taylor_slip(taylor_t *motion, const segment_t *segment) {
  const tf_tyre_t *tyre = &motion->machine->tyre;
  const tf_slip_t slip =
      slip_from_pq(motion->machine, motion->p.c[0], motion->q.c[0]);
  const tf_real_t H = (tf_real_t)segment->sign_h * slip.h;
  const tf_real_t G = (tf_real_t)segment->sign_g * slip.g;
  slip_angle_t angle = {.inverse_R2 = 1 / (motion->p.c[0] * motion->p.c[0] +
                                           motion->q.c[0] * motion->q.c[0])};
  angle.T.c[0] = (tf_real_t)(segment->sign_h * segment->sign_g) *
                 cot_psi(tyre, G > 0 ? G : 0, H > 0 ? H : 0);
  extend_motion(motion, 0);
  add_tyre_term(motion, segment, 0, angle.T.c[0]);
  (void)is_long_enough(motion, 1);
  for (int n = 1; n < SERIES_ORDER; n++) {
    angle.T.c[n] = next_slip_angle(motion, &angle, tyre->T_series[0], n);
    extend_motion(motion, n);
    add_tyre_term(motion, segment, n, angle.T.c[n]);
    if (is_long_enough(motion, n + 1)) return;
  }
}

// How much of a change of T at h = g = 0 comes back through psi'. The solution
// there is singular: p and q begin with t, so that psi' is that of p/t and q/t.
// A small distance from it changes as t^(gain - 1).
static tf_real_t limit_direction_gain(const taylor_t *motion,
                                      const segment_t *segment,
                                      const slip_angle_t *angle) {
  const tf_tyre_t *tyre = &motion->machine->tyre;
  const tf_real_t T = angle->T.c[0];
  const tf_real_t F1 = slip_F1(tyre, (tf_real_t)segment->sign_g);
  const tf_real_t dp = F1 * motion->machine->sin_gamma / motion->machine->m;
  const tf_real_t dq = motion->r.c[0] * (F1 * motion->arm + slip_M1(tyre, 1)) *
                       motion->inverse_J;
  return tyre->T_series[0] * (1 + T * T) *
         (dp * motion->q.c[1] - motion->p.c[1] * dq) / angle->R2.c[0];
}

// Out of a singular point the sizes of the terms do not predict the next ones.
static void take_all_terms(taylor_t *motion) {
  (void)is_long_enough(motion, 1);
  motion->order = SERIES_ORDER;
}

// (15) from h = g = 0. Term n - 1 of psi' needs the terms n + 1 of p and q,
// which T_n enters linearly: T_n is what it would be without itself, over
// 1 - gain/(n + 1). Away from a resonance that is not 0.
static void taylor_codim2_slip(taylor_t *motion, const segment_t *segment) {
  const tf_tyre_t *tyre = &motion->machine->tyre;
  slip_angle_t angle = {.inverse_R2 = 0};
  angle.T.c[0] = (tf_real_t)(segment->sign_h * segment->sign_g) * segment->T;
  extend_motion(motion, 0);
  add_tyre_term(motion, segment, 0, angle.T.c[0]);
  angle.R2.c[0] =
      motion->p.c[1] * motion->p.c[1] + motion->q.c[1] * motion->q.c[1];
  angle.inverse_R2 = 1 / angle.R2.c[0];
  const tf_real_t gain = limit_direction_gain(motion, segment, &angle);
  motion->exponent = gain - 1;
  for (int n = 1; n < SERIES_ORDER; n++) {
    extend_motion(motion, n);
    angle.psi_rate.c[n - 1] =
        psi_rate_term(&angle, n - 1, cross_term(motion, n + 1));
    angle.T2.c[n - 1] = square_term(&angle.T, n - 1);
    const tf_real_t T =
        T_term(&angle, tyre->T_series[0], n) / (1 - gain * reciprocal[n + 1]);
    angle.T.c[n] = T;
    add_tyre_term(motion, segment, n, T);
    angle.psi_rate.c[n - 1] =
        psi_rate_term(&angle, n - 1, cross_term(motion, n + 1));
    tf_real_t R2 = 0;
    for (int i = 1; i <= n + 1; i++)
      R2 += motion->p.c[i] * motion->p.c[n + 2 - i] +
            motion->q.c[i] * motion->q.c[n + 2 - i];
    angle.R2.c[n] = R2;
  }
  take_all_terms(motion);
}

TF_INLINE tf_real_t h_term(const taylor_t *motion, int n) {
  return slip_from_pq(motion->machine, motion->p.c[n], motion->q.c[n]).h;
}

// Stick: F = lambda, M = s kappa lambda.
TF_INLINE void add_lambda_term(taylor_t *motion, tf_real_t s_kappa, int n,
                               tf_real_t lambda) {
  add_friction_term(motion, n, lambda, s_kappa * lambda);
}

// (16). Term n + 1 of h has to be 0, and (n + 1) times it is what it would be
// without lambda_n, less A lambda_n.
static bool taylor_stick(taylor_t *motion, const segment_t *segment) {
  const tf_machine_t *k = motion->machine;
  const bool minus = segment->sign_g < 0;
  const tf_real_t s_kappa = signed_kappa(k, minus);
  const tf_real_t arm = stick_arm(k, motion->arm, minus);
  const tf_real_t A = delassus_from(k, motion->arm * arm * motion->inverse_J);
  if (A == 0) return false;
  const tf_real_t inverse_A = 1 / A;
  extend_motion(motion, 0);
  add_lambda_term(motion, s_kappa, 0, h_term(motion, 1) * inverse_A);
  (void)is_long_enough(motion, 1);
  for (int n = 1; n < SERIES_ORDER; n++) {
    extend_motion(motion, n);
    const tf_real_t h_rate = h_term(motion, n + 1) * (tf_real_t)(n + 1);
    add_lambda_term(motion, s_kappa, n, h_rate * inverse_A);
    if (is_long_enough(motion, n + 1)) break;
  }
  return true;
}

// At a two-fold A = 0: term n + 1 of h does not contain lambda_n but
// lambda_(n-1), linearly, through term n of the motion. Two trial values give
// the line, and its zero lambda_(n-1). The second trial is the force of
// 1 m/s^2: no unit of mass moves a bit.
static bool taylor_two_fold(taylor_t *motion, const segment_t *segment) {
  const tf_real_t s_kappa = signed_kappa(motion->machine, segment->sign_g < 0);
  const tf_real_t m = motion->machine->m;
  extend_motion(motion, 0);
  for (int n = 1; n < SERIES_ORDER; n++) {
    tf_real_t h[2];
    for (int trial = 0; trial < 2; trial++) {
      extend_motion(motion, n - 1);
      add_lambda_term(motion, s_kappa, n - 1, (tf_real_t)trial * m);
      extend_motion(motion, n);
      h[trial] = h_term(motion, n + 1);
    }
    const tf_real_t slope = h[0] - h[1];
    if (slope == 0) return false;
    extend_motion(motion, n - 1);
    add_lambda_term(motion, s_kappa, n - 1, h[0] / slope * m);
    extend_motion(motion, n);
  }
  // The last term of lambda would need term SERIES_ORDER + 1 of h: it is left
  // 0.
  add_lambda_term(motion, s_kappa, SERIES_ORDER - 1, 0);
  take_all_terms(motion);
  return true;
}

static void taylor_constant_force(taylor_t *motion, tf_real_t F) {
  extend_motion(motion, 0);
  add_friction_term(motion, 0, F, 0);
  (void)is_long_enough(motion, 1);
  for (int n = 1; n < SERIES_ORDER; n++) {
    extend_motion(motion, n);
    add_friction_term(motion, n, 0, 0);
    if (is_long_enough(motion, n + 1)) return;
  }
}

static void taylor_pinned(taylor_t *motion) {
  const rest_motion_t rest = tf_rest_motion(motion->machine, motion->input,
                                            motion->r.c[0], motion->w.c[0]);
  motion->order = REST_ORDER;
  motion->allowed = 0;
  for (int n = 0; n <= REST_ORDER; n++) {
    motion->r.c[n] = motion->p.c[n] = motion->z.c[n] = motion->w.c[n] =
        motion->q.c[n] = 0;
    motion->F.c[n] = rest.F[n];
    motion->M.c[n] = rest.M[n];
  }
  motion->r.c[0] = rest.r;
  motion->w.c[0] = rest.omega;
  motion->w.c[1] = motion->input->alpha;
}

static bool close_recurrence(taylor_t *motion, const segment_t *segment) {
  switch (segment->contact) {
    case CONTACT_NONE:
      taylor_constant_force(motion, 0);
      return true;
    case CONTACT_SLIP:
      if (motion->machine->tyre.law == TF_TYRE_COULOMB)
        taylor_constant_force(
            motion, (tf_real_t)segment->sign_h * motion->machine->tyre.mu);
      else
        taylor_slip(motion, segment);
      return true;
    case CONTACT_CODIM2_SLIP:
      taylor_codim2_slip(motion, segment);
      return true;
    case CONTACT_STICK:
      return taylor_stick(motion, segment);
    case CONTACT_TWO_FOLD_STICK:
      return taylor_two_fold(motion, segment);
    case CONTACT_PINNED:
    default:
      break;
  }
  taylor_pinned(motion);
  return true;
}

TF_API bool tf_taylor_coefficients(taylor_t *motion, const segment_t *segment,
                                   tf_real_t time) {
  motion->time = time;
  motion->power = 1;
  motion->size[0] = term_size(motion, 0);
  if (!close_recurrence(motion, segment)) return false;
  if (segment->contact != CONTACT_PINNED)
    motion->F.c[motion->order] = motion->M.c[motion->order] = 0;
  return true;
}

TF_API tf_real_t tf_angle_change(const taylor_t *motion, tf_real_t t) {
  tf_real_t sum = 0;
  for (int n = motion->order; n >= 0; n--)
    sum = (sum + motion->w.c[n] * reciprocal[n + 1]) * t;
  return sum;
}

TF_API tf_real_t tf_segment_length(const taylor_t *motion, tf_real_t time,
                                   tf_real_t allowed) {
  const tf_real_t size = magnitude(time);
  tf_real_t power = 1,
            share = 1; // of the time, and of what a shortening leaves
  for (int n = 1; n < SERIES_ORDER; n++) {
    power *= size;
    share *= SHORTENING;
  }
  tf_real_t last_but_one = term_size(motion, SERIES_ORDER - 1) * power;
  tf_real_t last = term_size(motion, SERIES_ORDER) * power * size;
  for (int i = 0; i < MAX_SHORTENINGS; i++) {
    if (last_but_one + last <= allowed) return time;
    time *= SHORTENING;
    last_but_one *= share;
    last *= share * SHORTENING;
  }
  return 0;
}
