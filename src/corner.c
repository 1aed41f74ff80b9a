// Futures of an instant, see corner.h.
#include "corner.h"

#include "tyre_core.h"

#define MOST_HALVINGS 24

TF_API void tf_surface_futures(const tf_machine_t *k, const tf_rates_t *a,
                               int s, tf_futures_t *out) {
  const tf_real_t Amu = a->A[s] * k->tyre.mu;
  const bool plus = a->N - Amu > 0, minus = a->N + Amu < 0;
  const unsigned stick = TF_STICK_PLUS + (unsigned)s;
  tf_solutions_t *set = &out->solutions;
  *out = (tf_futures_t){.roll = {s ? -1 : 1, s ? -1 : 1}};
  set->set = (uint8_t)(plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS);
  set->near_stick = (uint8_t)stick;
  set->h_limit[0] = a->N - Amu;
  set->h_limit[1] = a->N + Amu;
  if (a->A[s] > 0) set->attracting = (uint8_t)TF_MODE_BIT(stick);
  if (plus != minus) return;
  set->set |= (uint8_t)TF_MODE_BIT(stick);
  if (a->A[s] != 0) // the vertical line of a two-fold: any lambda, 0 the least
    out->lambda[s] = clip(a->N / a->A[s], -k->tyre.mu, k->tyre.mu);
}

// One quadrant of the (g, h) plane: accelerations along roll g and side h as
// affine functions of T = cot(psi).
typedef struct {
  tf_real_t g0, g1, h0, h1;
} quadrant_t;

static quadrant_t quadrant(const tf_machine_t *k, const tf_rates_t *a, int roll,
                           int side) {
  const tf_real_t s = (tf_real_t)side, both = (tf_real_t)(side * roll);
  const tf_real_t F0 = s * k->tyre.mu * 4 / 3;
  const tf_real_t F1 = -s * k->tyre.mu * k->tyre.inv_18_kappa;
  const tf_real_t M1 = both * k->tyre.mu / 6;
  const tf_slip_t at0 = turned(k, a->p + F0 * a->Fp, a->q + F0 * a->Fq);
  const tf_slip_t at1 = turned(k, F1 * a->Fp, F1 * a->Fq + M1 * a->Mq);
  const tf_real_t turn = (tf_real_t)roll;
  return (quadrant_t){turn * at0.g, turn * at1.g, s * at0.h, s * at1.h};
}

// Turning towards larger |g/h|, at an angle with cosine C and sine S from the
// h axis.
static tf_real_t turning(const quadrant_t *q, tf_real_t T, tf_real_t C,
                         tf_real_t S) {
  return (q->g0 + q->g1 * T) * C - (q->h0 + q->h1 * T) * S;
}

static tf_real_t leaving(const quadrant_t *q, tf_real_t T, tf_real_t C,
                         tf_real_t S) {
  return ((q->g0 + q->g1 * T) * S + (q->h0 + q->h1 * T) * C) /
         square_root(C * C + S * S);
}

// A limit direction between two anchors of the angle kernel, by halving and
// secants (Illinois), on the chord between them: T depends on G/H alone.
static tf_real_t direction(const tf_machine_t *k, const quadrant_t *q,
                           int anchor, tf_real_t f0, tf_real_t f1, tf_real_t *C,
                           tf_real_t *S) {
  tf_real_t low = 0, high = 1, T = 0;
  int kept = 0;
  for (int i = 0; i < MOST_HALVINGS; i++) {
    const tf_real_t x = (f0 * high - f1 * low) / (f0 - f1);
    *C = anchor_cos[anchor] + x * (anchor_cos[anchor + 1] - anchor_cos[anchor]);
    *S = anchor_cos[8 - anchor] +
         x * (anchor_cos[7 - anchor] - anchor_cos[8 - anchor]);
    T = cot_psi(&k->tyre, *S, *C);
    const tf_real_t f = turning(q, T, *C, *S);
    if (!(high - low > 4 * TF_REAL_EPSILON) || f == 0) break;
    if ((f > 0) == (f0 > 0)) {
      if (!(x - low > TF_REAL_EPSILON * x)) break;
      low = x;
      f0 = f;
      if (kept == 1) f1 /= 2;
      kept = 1;
    } else {
      if (!(high - x > TF_REAL_EPSILON * x)) break;
      high = x;
      f1 = f;
      if (kept == -1) f0 /= 2;
      kept = -1;
    }
  }
  return T;
}

// One limit direction of a quadrant.
typedef struct {
  tf_real_t T, speed; // outwards [m/s^2]
  bool attracts;      // its neighbours turn to it as time runs on
} limit_t;

// The limit directions of one quadrant, one between two anchors at most;
// returns how many.
static int limits(const tf_machine_t *k, const tf_rates_t *a, int roll,
                  int side, limit_t found[8]) {
  const quadrant_t q = quadrant(k, a, roll, side);
  tf_real_t before = turning(&q, 0, 1, 0);
  int n = 0;
  for (int i = 0; i < 8; i++) {
    const tf_real_t after = turning(&q, k->tyre.T_anchor[i + 1],
                                    anchor_cos[i + 1], anchor_cos[7 - i]);
    const bool rising = after > 0;
    if ((before > 0) != rising) {
      tf_real_t C, S;
      const tf_real_t T = direction(k, &q, i, before, after, &C, &S);
      found[n++] = (limit_t){T, leaving(&q, T, C, S), !rising};
    }
    before = after;
  }
  return n;
}

TF_API bool tf_corner_attractor(const tf_machine_t *k, const tf_rates_t *a,
                                int roll, int side, tf_real_t *T) {
  limit_t found[8];
  const int n = limits(k, a, roll, side, found);
  for (int i = 0; i < n; i++)
    if (found[i].attracts) {
      *T = found[i].T;
      return true;
    }
  return false;
}

// The exits through one quadrant. Of several on one side of h = 0 that is kept
// to which its neighbours turn, then the fastest.
static void scan(const tf_machine_t *k, const tf_rates_t *a, int roll, int side,
                 bool *settled, tf_futures_t *out) {
  const int slip = side > 0 ? 0 : 1;
  tf_solutions_t *set = &out->solutions;
  limit_t found[8];
  const int n = limits(k, a, roll, side, found);
  for (int i = 0; i < n; i++) {
    const bool better = found[i].attracts == settled[slip]
                            ? found[i].speed > magnitude(set->h_limit[slip])
                            : found[i].attracts;
    if (!(found[i].speed > 0 && better)) continue;
    set->set |= (uint8_t)TF_MODE_BIT(TF_SLIP_PLUS + slip);
    set->h_limit[slip] = (tf_real_t)side * found[i].speed;
    settled[slip] = found[i].attracts;
    out->T[slip] = found[i].T;
    out->roll[slip] = roll;
  }
}

TF_API void tf_corner_futures(const tf_machine_t *k, const tf_rates_t *a,
                              tf_futures_t *out) {
  const tf_real_t mu = k->tyre.mu;
  bool settled[2] = {false, false};
  *out = (tf_futures_t){.solutions = {.near_stick = TF_STICK_PLUS}};
  tf_solutions_t *set = &out->solutions;
  for (int roll = -1; roll <= 1; roll += 2)
    for (int side = -1; side <= 1; side += 2)
      scan(k, a, roll, side, settled, out);
  for (int s = 0; s < 2; s++) {
    const tf_real_t sign = s ? TF_R(-1.0) : TF_R(1.0);
    const tf_real_t lambda = a->N / a->A[s];
    const tf_real_t moment = sign * k->stick_kappa * lambda;
    const tf_real_t g =
        turned(k, a->p + lambda * a->Fp, a->q + lambda * a->Fq + moment * a->Mq)
            .g;
    if (a->A[s] > 0) set->attracting |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
    if (!within(lambda, mu) || !(sign * g > 0)) continue;
    set->set |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
    out->lambda[s] = lambda;
  }
  if (within(a->pinning.F, mu) &&
      within(a->pinning.M, k->stick_kappa * magnitude(a->pinning.F)))
    set->set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}
