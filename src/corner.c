// Futures of an instant, see corner.h.
#include "corner.h"

#include "tyre_core.h"

#define MOST_HALVINGS 24

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

// How fast `turning` rises with the angle, of which T' = a (1 + T^2).
static tf_real_t rising(const tf_machine_t *k, const quadrant_t *q, tf_real_t T,
                        tf_real_t C, tf_real_t S) {
  const tf_real_t dT = k->tyre.T_series[0] * (1 + T * T);
  return (q->g1 * dT - q->h0 - q->h1 * T) * C -
         (q->h1 * dT + q->g0 + q->g1 * T) * S;
}

// At a share of the chord between an anchor of the angle kernel and the next:
// T, which depends on G/H alone, and the chord's own cosine and sine.
static tf_real_t on_chord(const tf_machine_t *k, int anchor, tf_real_t x,
                          tf_real_t *C, tf_real_t *S) {
  *C = anchor_cos[anchor] + x * (anchor_cos[anchor + 1] - anchor_cos[anchor]);
  *S = anchor_cos[8 - anchor] +
       x * (anchor_cos[7 - anchor] - anchor_cos[8 - anchor]);
  return cot_psi(&k->tyre, *S, *C);
}

// A limit direction of a quadrant.
typedef struct {
  tf_real_t T;     // its cot(psi)
  tf_real_t speed; // outwards [m/s^2]
  bool attracts;   // its neighbours turn to it as time runs on
} limit_t;

// A part of a chord, by shares, and `turning` at its ends: of opposite signs.
typedef struct {
  tf_real_t low, high, f0, f1;
} bracket_t;

// By halving and secants (Illinois).
static limit_t limit_in(const tf_machine_t *k, const quadrant_t *q, int anchor,
                        bracket_t in) {
  const bool attracts = in.f0 > 0;
  tf_real_t T = 0, C = 1, S = 0;
  int kept = 0;
  for (int i = 0; i < MOST_HALVINGS; i++) {
    const tf_real_t x = (in.f0 * in.high - in.f1 * in.low) / (in.f0 - in.f1);
    T = on_chord(k, anchor, x, &C, &S);
    const tf_real_t f = turning(q, T, C, S);
    if (!(in.high - in.low > 4 * TF_REAL_EPSILON) || f == 0) break;
    if ((f > 0) == attracts) {
      if (!(x - in.low > TF_REAL_EPSILON * x)) break;
      in.low = x;
      in.f0 = f;
      if (kept == 1) in.f1 /= 2;
      kept = 1;
    } else {
      if (!(in.high - x > TF_REAL_EPSILON * x)) break;
      in.high = x;
      in.f1 = f;
      if (kept == -1) in.f0 /= 2;
      kept = -1;
    }
  }
  return (limit_t){T, leaving(q, T, C, S), attracts};
}

// Between anchors where `turning` has one sign and falls to 0 from both: a
// share of the chord where it has the other sign, and its value there. Where
// there is none, any value of the same sign.
static tf_real_t beyond_0(const tf_machine_t *k, const quadrant_t *q,
                          int anchor, bool above, tf_real_t *f) {
  tf_real_t low = 0, high = 1, x = 1;
  for (int i = 0; i < MOST_HALVINGS; i++) {
    tf_real_t C, S;
    x = (low + high) / 2;
    const tf_real_t T = on_chord(k, anchor, x, &C, &S);
    *f = turning(q, T, C, S);
    if ((*f > 0) != above) break;
    if ((rising(k, q, T, C, S) > 0) == above)
      high = x;
    else
      low = x;
  }
  return x;
}

// Of two ways out that to which its neighbours turn, then the faster one.
static bool is_better(const limit_t *next, const limit_t *best) {
  if (!(next->speed > 0)) return false;
  return next->attracts == best->attracts ? next->speed > best->speed
                                          : next->attracts;
}

// Looks through the limit directions of one quadrant: for a better way out than
// the best one so far, or for the one that attracts. Returns whether there is
// one. There are three at most in a quadrant: with T = tan(a psi), a < 1,
// cos(a psi) `turning` is a sum of cosines and sines of (1 + a) psi and
// (1 - a) psi. So there is one between two anchors where the sign changes, and
// none or two where it does not; two only where `turning` falls to 0 from both.
static bool look_for(const tf_machine_t *k, const quadrant_t *q, bool way_out,
                     limit_t *best) {
  tf_real_t f0 = turning(q, 0, 1, 0), up0 = rising(k, q, 0, 1, 0);
  bool found = false;
  for (int i = 0; i < 8; i++) {
    const tf_real_t T = k->tyre.T_anchor[i + 1];
    const tf_real_t C = anchor_cos[i + 1], S = anchor_cos[7 - i];
    const tf_real_t f1 = turning(q, T, C, S), up1 = rising(k, q, T, C, S);
    const bool above = f0 > 0;
    tf_real_t x = 1, f = f1;
    if ((f1 > 0) == above && (up0 > 0) != above && (up1 > 0) == above)
      x = beyond_0(k, q, i, above, &f);
    const bracket_t parts[2] = {{0, x, f0, f}, {x, 1, f, f1}};
    for (int n = 0; n < 2; n++) {
      const bool attracts = parts[n].f0 > 0;
      if (attracts == (parts[n].f1 > 0)) continue;
      if (!way_out && !attracts) continue;
      const limit_t next = limit_in(k, q, i, parts[n]);
      if (way_out && !is_better(&next, best)) continue;
      *best = next;
      found = true;
    }
    f0 = f1;
    up0 = up1;
  }
  return found;
}

TF_API bool tf_corner_attractor(const tf_machine_t *k, const tf_rates_t *a,
                                int roll, int side, tf_real_t *T) {
  const quadrant_t q = quadrant(k, a, roll, side);
  limit_t best = {.speed = 0};
  if (!look_for(k, &q, false, &best)) return false;
  *T = best.T;
  return true;
}

// The exit on one side of h = 0.
static void exit_on(const tf_machine_t *k, const tf_rates_t *a, int side,
                    tf_futures_t *out) {
  const int slip = side > 0 ? 0 : 1;
  limit_t best = {.speed = 0};
  for (int roll = -1; roll <= 1; roll += 2) {
    const quadrant_t q = quadrant(k, a, roll, side);
    if (look_for(k, &q, true, &best)) out->roll[slip] = roll;
  }
  if (!(best.speed > 0)) return;
  out->T[slip] = best.T;
  out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_SLIP_PLUS + slip);
  out->solutions.h_limit[slip] = (tf_real_t)side * best.speed;
}

TF_API void tf_corner_futures(const tf_machine_t *k, const tf_rates_t *a,
                              tf_futures_t *out) {
  const tf_real_t mu = k->tyre.mu;
  *out = (tf_futures_t){.solutions = {.near_stick = TF_STICK_PLUS}};
  tf_solutions_t *set = &out->solutions;
  exit_on(k, a, 1, out);
  exit_on(k, a, -1, out);
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
