// The Taylor coefficients of a segment: each contact closes the recurrence of
// (13), (14) in its own form.
#include "../model/rates.h"
#include "trajectory.h"

// Each shortening takes a quarter off a segment, or, where the terms exceed the
// error so long_share that they still do then, leaves an eighth of it.
#define MAX_SHORTENINGS 64
#define SHORTENING TF_R(0.75)
#define MUCH_TOO_LARGE TF_R(0x1p30)
#define LONG_SHORTENING TF_R(0.125)

// Calls extend(..., n) for the terms from 1 on, until it returns that they are
// long enough. With a constant n the sums of a term have no loops: a fifth less
// time of a located run, but three times the code of a series. So that is for
// hosts, by their pointers. The operations and their order are the same.
#define EXTEND_BY_NEED(extend, motion, sizes, a, b)                            \
  if (sizeof(void *) > 4)                                                      \
    (void)(extend(motion, sizes, a, b, 1),                                     \
           extend(motion, sizes, a, b, 2) || extend(motion, sizes, a, b, 3) || \
               extend(motion, sizes, a, b, 4) ||                               \
               extend(motion, sizes, a, b, 5) ||                               \
               EXTEND_FURTHER(extend, motion, sizes, a, b));                   \
  else                                                                         \
    for (int n = 1;                                                            \
         n < highest_order(motion) && !extend(motion, sizes, a, b, n); n++) {  \
    }

#ifdef TF_REAL_FLOAT // no order above 6
#define EXTEND_FURTHER(extend, motion, sizes, a, b) true
#else
#define EXTEND_FURTHER(extend, motion, sizes, a, b)                   \
  extend(motion, sizes, a, b, 6) || extend(motion, sizes, a, b, 7) || \
      (highest_order(motion) > USUAL_ORDER &&                         \
       (extend(motion, sizes, a, b, 8) || extend(motion, sizes, a, b, 9)))
#endif

// (15). In slip the force goes with T(y) = tan(a atan y), y = |g/h|, and
// T' = a (1 + T^2) psi' with psi' = (g' h - g h')/(h^2 + g^2). That rate is the
// same in (p, q), because (h, g) is (p, q) turned by gamma. So the kernel of T
// is evaluated once a segment.
typedef struct {
  series_t T, psi_rate; // T and psi'
  series_t T2;          // T^2
  series_t R2;          // p^2 + q^2; from h = g = 0 that over t^2
  tf_real_t inverse_R2; // 1 over its term 0
  tf_real_t a;
  tf_real_t turn; // what one of p_n q_0 - p_0 q_n adds to T_n
} slip_angle_t;

// Term n of psi' where p and q begin with t.
TF_INLINE tf_real_t psi_rate_term(const taylor_t *motion,
                                  const slip_angle_t *angle, int n) {
  const tf_real_t *p = motion->p.c, *q = motion->q.c;
  tf_real_t sum = 0;
  for (int i = 1; i <= n + 2; i++)
    sum += (tf_real_t)(2 * i - (n + 3)) * p[i] * q[n + 3 - i];
  for (int i = 1; i <= n; i++) sum -= angle->R2.c[i] * angle->psi_rate.c[n - i];
  return sum * angle->inverse_R2;
}

// Term n >= 1 of T from T' = a (1 + T^2) psi'.
TF_INLINE tf_real_t T_term(const slip_angle_t *angle, int n) {
  tf_real_t sum = angle->psi_rate.c[n - 1];
  for (int i = 0; i < n; i++)
    sum += angle->T2.c[i] * angle->psi_rate.c[n - 1 - i];
  return angle->a * sum * reciprocal[n];
}

// (force), (moment): the series of T has the sign of g h, so that F1 goes by
// the sign of g and M1 by none.
TF_INLINE friction_t tyre_by_T(const taylor_t *motion,
                               const segment_t *segment) {
  const tf_tyre_t *tyre = &motion->machine->contact.tyre;
  return friction_of(motion, slip_F1(tyre, segment->sign_g),
                     slip_M1(tyre, PLUS));
}

// The terms 0 of F and M, which have more than T, and terms 1 of the motion.
static void begin_slip(taylor_t *motion, const segment_t *segment,
                       const friction_t *by_T, tf_real_t T) {
  const tf_real_t F0 = slip_F0(&motion->machine->contact.tyre, segment->sign_h);
  const friction_t friction =
      friction_of(motion, F0 + by_T->F * T, by_T->M * T);
  const next_terms_t next = next_terms(motion, 0);
  set_terms(motion, 0, &next, &friction, 1);
}

// Terms n of R^2 and T^2.
TF_INLINE void extend_squares(const taylor_t *motion, slip_angle_t *angle,
                              int n) {
  const tf_real_t *p = motion->p.c, *q = motion->q.c;
  angle->R2.c[n] = inner_square(&motion->p, n) + inner_square(&motion->q, n) +
                   2 * (p[0] * p[n] + q[0] * q[n]);
  angle->T2.c[n] = square_term(&angle->T, n);
}

// Terms n - 1 of R^2, T^2 and psi', and T_n. What hangs on the newest terms,
// p_n and q_n, comes last, and by a factor of its own, so that little has to
// wait for them. p_i q_(n-i) and p_(n-i) q_i have the same weight.
TF_INLINE tf_real_t next_slip_angle(const taylor_t *motion, slip_angle_t *angle,
                                    int n) {
  const tf_real_t *p = motion->p.c, *q = motion->q.c;
  // cppcheck-suppress [uninitvar, ctuuninitvar]
  const tf_real_t *R2 = angle->R2.c, *T2 = angle->T2.c;
  tf_real_t *psi_rate = angle->psi_rate.c;
  tf_real_t cross = NO_TERMS; // term n - 1 of p' q - q' p
  tf_real_t sum = NO_TERMS;   // for T_n
  if (n > 1) extend_squares(motion, angle, n - 1);
  const int first = (n - 1) / 2;
  if (first > 0)
    cross = (tf_real_t)(n - 2 * first) *
            (p[n - first] * q[first] - p[first] * q[n - first]);
  for (int i = first - 1; i > 0; i--)
    cross += (tf_real_t)(n - 2 * i) * (p[n - i] * q[i] - p[i] * q[n - i]);
  if (n > 1) {
    cross -= R2[n - 1] * psi_rate[0];
    sum = T2[n - 1] * psi_rate[0];
  }
  for (int i = n - 2; i > 0; i--) {
    cross -= R2[i] * psi_rate[n - 1 - i];
    sum += T2[i] * psi_rate[n - 1 - i];
  }
  const tf_real_t newest = p[n] * q[0] - p[0] * q[n];
  psi_rate[n - 1] = (cross + (tf_real_t)n * newest) * angle->inverse_R2;
  return (angle->a * sum + angle->turn * cross) * reciprocal[n] +
         angle->turn * newest;
}

// Term n of T and terms n + 1 of the motion. Returns is_long_enough().
TF_INLINE bool extend_slip(taylor_t *motion, sizes_t *sizes,
                           slip_angle_t *angle, const friction_t *by_T, int n) {
  const next_terms_t next = next_terms(motion, n);
  const tf_real_t T = next_slip_angle(motion, angle, n);
  angle->T.c[n] = T;
  set_terms(motion, n, &next, by_T, T);
  return is_long_enough(motion, sizes, n + 1);
}

// x with the sign of h g.
TF_INLINE tf_real_t with_signs_of(const segment_t *segment, tf_real_t x) {
  return with_sign(segment->sign_h, with_sign(segment->sign_g, x));
}

// (15) away from h = g = 0.
static void taylor_slip(taylor_t *motion, const segment_t *segment) {
  const tf_tyre_t *tyre = &motion->machine->contact.tyre;
  const friction_t by_T = tyre_by_T(motion, segment);
  const tf_real_t p = motion->p.c[0], q = motion->q.c[0];
  const tf_slip_t slip = slip_from_pq(motion->machine, p, q);
  const tf_real_t H = with_sign(segment->sign_h, slip.h);
  const tf_real_t G = with_sign(segment->sign_g, slip.g);
  const tf_real_t T =
      with_signs_of(segment, cot_psi(tyre, G > 0 ? G : 0, H > 0 ? H : 0));
  // Term by term: zeros would cost more than the rest, and none is read before
  // it is set, which cppcheck does not see.
  slip_angle_t angle;
  angle.a = tyre->T_series[0];
  angle.inverse_R2 = 1 / (p * p + q * q);
  angle.turn = angle.a * (1 + T * T) * angle.inverse_R2;
  angle.T.c[0] = T;
  begin_slip(motion, segment, &by_T, T);
  sizes_t sizes;
  (void)is_long_enough(motion, &sizes, 1);
  EXTEND_BY_NEED(extend_slip, motion, &sizes, &angle, &by_T);
}

// How much of a change of T at h = g = 0 comes back through psi'. The solution
// there is singular: p and q begin with t, so that psi' is that of p/t and q/t.
// A small distance from it changes as t^(gain - 1).
static tf_real_t limit_direction_gain(const taylor_t *motion,
                                      const friction_t *by_T,
                                      const slip_angle_t *angle) {
  const tf_real_t T = angle->T.c[0], dq = motion->r.c[0] * by_T->z;
  return angle->a * (1 + T * T) *
         (by_T->p * motion->q.c[1] - motion->p.c[1] * dq) / angle->R2.c[0];
}

// Out of a singular point the sizes of the terms do not predict the next ones.
static void take_all_terms(taylor_t *motion) {
  sizes_t sizes;
  (void)is_long_enough(motion, &sizes, 1);
  motion->order = highest_order(motion);
}

// (15) from h = g = 0. Term n - 1 of psi' needs the terms n + 1 of p and q,
// which T_n enters linearly: T_n is what it would be without itself, over
// 1 - gain/(n + 1). Away from a resonance that is not 0.
static void taylor_codim2_slip(taylor_t *motion, const segment_t *segment) {
  const tf_tyre_t *tyre = &motion->machine->contact.tyre;
  const friction_t by_T = tyre_by_T(motion, segment);
  slip_angle_t angle = {.a = tyre->T_series[0]};
  angle.T.c[0] = with_signs_of(segment, segment->T);
  begin_slip(motion, segment, &by_T, angle.T.c[0]);
  angle.R2.c[0] =
      motion->p.c[1] * motion->p.c[1] + motion->q.c[1] * motion->q.c[1];
  angle.inverse_R2 = 1 / angle.R2.c[0];
  const tf_real_t gain = limit_direction_gain(motion, &by_T, &angle);
  motion->exponent = gain - 1;
  const friction_t none = {0, 0, 0, 0};
  for (int n = 1; n < highest_order(motion); n++) {
    const next_terms_t next = next_terms(motion, n);
    set_terms(motion, n, &next, &none, 0);
    angle.psi_rate.c[n - 1] = psi_rate_term(motion, &angle, n - 1);
    angle.T2.c[n - 1] = square_term(&angle.T, n - 1);
    const tf_real_t T = T_term(&angle, n) / (1 - gain * reciprocal[n + 1]);
    angle.T.c[n] = T;
    set_terms(motion, n, &next, &by_T, T);
    angle.psi_rate.c[n - 1] = psi_rate_term(motion, &angle, n - 1);
    tf_real_t R2 = 0;
    for (int i = 1; i <= n + 1; i++)
      R2 += motion->p.c[i] * motion->p.c[n + 2 - i] +
            motion->q.c[i] * motion->q.c[n + 2 - i];
    angle.R2.c[n] = R2;
  }
  take_all_terms(motion);
}

// Stick: F = lambda, M = s kappa lambda.
TF_INLINE friction_t friction_by_lambda(const taylor_t *motion,
                                        const segment_t *segment) {
  return friction_of(motion, 1, signed_kappa(motion->machine, segment->sign_g));
}

// Term n + 1 of h without friction.
TF_INLINE tf_real_t next_h(const taylor_t *motion, int n,
                           const next_terms_t *next) {
  const tf_real_t z = n == 0 ? next->w - motion->input->alpha : next->w;
  return slip_from_pq(motion->machine, next->p, next->r_z + motion->r.c[0] * z)
      .h;
}

// (16). Term n + 1 of h has to be 0, and (n + 1) times it is what it would be
// without lambda_n, less A lambda_n.
TF_INLINE bool extend_stick(taylor_t *motion, sizes_t *sizes,
                            const friction_t *by_lambda, tf_real_t inverse_A,
                            int n) {
  const next_terms_t next = next_terms(motion, n);
  const tf_real_t h_rate = next_h(motion, n, &next) * (tf_real_t)(n + 1);
  set_terms(motion, n, &next, by_lambda, h_rate * inverse_A);
  return is_long_enough(motion, sizes, n + 1);
}

static bool taylor_stick(taylor_t *motion, const segment_t *segment) {
  const tf_machine_t *k = motion->machine;
  const friction_t by_lambda = friction_by_lambda(motion, segment);
  const tf_real_t arm = motion->r.c[0] * k->cos_gamma;
  const tf_real_t A = delassus_from(
      k, arm * stick_arm(k, arm, segment->sign_g) * motion->inverse_J);
  if (A == 0) return false;
  const tf_real_t inverse_A = 1 / A;
  sizes_t sizes;
  (void)extend_stick(motion, &sizes, &by_lambda, inverse_A, 0);
  EXTEND_BY_NEED(extend_stick, motion, &sizes, &by_lambda, inverse_A);
  return true;
}

// At a two-fold A = 0: term n + 1 of h does not contain lambda_n but, linearly,
// lambda_(n-1). Two trials give it: 0, and the force of 1 m/s^2 to one side of
// h, so that no unit of mass and no mirror moves a bit.
static bool taylor_two_fold(taylor_t *motion, const segment_t *segment) {
  const friction_t by_lambda = friction_by_lambda(motion, segment);
  tf_real_t m = motion->machine->m;
  next_terms_t before = next_terms(motion, 0);
  for (int n = 1; n < highest_order(motion); n++) {
    tf_real_t h[2];
    for (int trial = 0; trial < 2; trial++) {
      set_terms(motion, n - 1, &before, &by_lambda, (tf_real_t)trial * m);
      const next_terms_t next = next_terms(motion, n);
      h[trial] = next_h(motion, n, &next);
      if (n == 1 && trial == 0 && h[0] < 0) m = -m;
    }
    const tf_real_t slope = h[0] - h[1];
    if (slope == 0) return false;
    set_terms(motion, n - 1, &before, &by_lambda, h[0] / slope * m);
    before = next_terms(motion, n);
  }
  // The last term of lambda would need one more of h: it is left 0.
  set_terms(motion, highest_order(motion) - 1, &before, &by_lambda, 0);
  take_all_terms(motion);
  return true;
}

static void taylor_constant_force(taylor_t *motion, tf_real_t F) {
  const friction_t friction = friction_of(motion, F, 0);
  sizes_t sizes;
  for (int n = 0; n < highest_order(motion); n++) {
    const next_terms_t next = next_terms(motion, n);
    set_terms(motion, n, &next, &friction, n == 0 ? 1 : 0);
    if (is_long_enough(motion, &sizes, n + 1)) return;
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
  switch (segment->kind) {
    case SEGMENT_FREE:
      taylor_constant_force(motion, 0);
      return true;
    case SEGMENT_SLIP:
      if (motion->machine->contact.tyre.law == TF_TYRE_COULOMB)
        taylor_constant_force(
            motion,
            with_sign(segment->sign_h, motion->machine->contact.tyre.mu));
      else
        taylor_slip(motion, segment);
      return true;
    case SEGMENT_CODIM2_SLIP:
      taylor_codim2_slip(motion, segment);
      return true;
    case SEGMENT_STICK:
      return taylor_stick(motion, segment);
    case SEGMENT_TWO_FOLD_STICK:
      return taylor_two_fold(motion, segment);
    case SEGMENT_PINNED:
    default:
      break;
  }
  taylor_pinned(motion);
  return true;
}

TF_API bool tf_taylor_coefficients(taylor_t *motion, const segment_t *segment,
                                   tf_real_t time) {
  motion->time = time;
  if (!close_recurrence(motion, segment)) return false;
  if (segment->kind != SEGMENT_PINNED)
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
                                   series_error_t allowed) {
  const int highest = highest_order(motion);
  const tf_real_t size = magnitude(time);
  tf_real_t power = 1;
  tf_real_t short_share = 1,
            long_share = 1; // what the shortenings leave of that
  for (int n = 1; n < SERIES_ORDER && n < highest; n++) {
    power *= size;
    short_share *= SHORTENING;
    long_share *= LONG_SHORTENING;
  }
  tf_real_t last_but_one = term_size(motion, highest - 1) * power;
  tf_real_t last = term_size(motion, highest) * power * size;
  tf_real_t by_change = allowed.by_change;
  tf_real_t error = allowed.at_once + by_change;
  int left = MAX_SHORTENINGS;
  for (; left > 0 && last_but_one + last > MUCH_TOO_LARGE * error; left--) {
    time *= LONG_SHORTENING;
    by_change *= LONG_SHORTENING;
    last_but_one *= long_share;
    last *= long_share * LONG_SHORTENING;
    error = allowed.at_once + by_change;
  }
  for (; left > 0 && !(last_but_one + last <= error); left--) {
    time *= SHORTENING;
    by_change *= SHORTENING;
    last_but_one *= short_share;
    last *= short_share * SHORTENING;
    error = allowed.at_once + by_change;
  }
  return left > 0 ? time : 0;
}
