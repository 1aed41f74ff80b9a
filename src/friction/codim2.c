// Futures of an instant, see corner.h.
#include "codim2.h"

#include "../model/tyre_law.h"

#define MOST_HALVINGS 32
#define SHARE_BITS 32
#define PLACES 3

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
  const tf_slip_t at0 = slip_from_pq(k, a->p + F0 * a->Fp, a->q + F0 * a->Fq);
  const tf_slip_t at1 = slip_from_pq(k, F1 * a->Fp, F1 * a->Fq + M1 * a->Mq);
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
    if (!(in.high - in.low > 4 * TF_REAL_EPSILON)) break;
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

// The share of the chord at which T is that given, to SHARE_BITS.
static tf_real_t share_at(const tf_machine_t *k, int anchor, tf_real_t T) {
  tf_real_t low = 0, high = 1;
  for (int n = 0; n < SHARE_BITS; n++) {
    const tf_real_t x = (low + high) / 2;
    tf_real_t C, S;
    if (on_chord(k, anchor, x, &C, &S) < T)
      low = x;
    else
      high = x;
  }
  return high;
}

// `turning` vanishes where (h0 + h1 T, g0 + g1 T) has the angle psi of the
// slip, T = tan(a psi), or that and pi. The difference of both grows where
//   a (1 + T^2) (h0 g1 - g0 h1) > (h0 + h1 T)^2 + (g0 + g1 T)^2
// and falls elsewhere; and the line of these vectors turns by pi at most in
// all, by half of that on either side of its point next to 0. So between the
// places found here, three at most, and within pi/16 of psi, the difference
// changes in one sense and by less than pi: `turning` has one zero where its
// sign changes, else none. In order; one that is none is -1.
static void find_places(const tf_machine_t *k, const quadrant_t *q,
                        tf_real_t T[PLACES]) {
  const tf_real_t slope = q->h1 * q->h1 + q->g1 * q->g1;
  const tf_real_t half = q->h0 * q->h1 + q->g0 * q->g1;
  const tf_real_t swing = k->tyre.T_series[0] * (q->h0 * q->g1 - q->g0 * q->h1);
  const tf_real_t constant = swing - q->h0 * q->h0 - q->g0 * q->g0;
  const tf_real_t discriminant = half * half - (swing - slope) * constant;
  T[0] = -half / slope;
  T[1] = T[2] = -1;
  if (!(discriminant > 0)) return;
  const tf_real_t root = square_root(discriminant);
  const tf_real_t sum = half < 0 ? half - root : half + root;
  T[1] = sum / (swing - slope);
  T[2] = constant / sum;
  for (int i = 0; i < PLACES; i++) {
    const int n = i == 1 ? 1 : 0; // pairs 0 1, 1 2, 0 1
    if (T[n] > T[n + 1]) {
      const tf_real_t larger = T[n];
      T[n] = T[n + 1];
      T[n + 1] = larger;
    }
  }
}

// Of two ways out that to which its neighbours turn, then the faster one.
static bool is_better(const limit_t *next, const limit_t *best) {
  if (!(next->speed > 0)) return false;
  return next->attracts == best->attracts ? next->speed > best->speed
                                          : next->attracts;
}

// Looks through the limit directions of one quadrant: for a better way out than
// the best one so far, or for the one that attracts. Returns whether there is
// one. They lie where `turning` changes its sign between two neighbours of the
// anchors and of the places above.
static bool look_for(const tf_machine_t *k, const quadrant_t *q, bool way_out,
                     limit_t *best) {
  tf_real_t at[PLACES];
  find_places(k, q, at);
  tf_real_t from = turning(q, 0, 1, 0);
  bool found = false;
  for (int i = 0; i < 8; i++) {
    const tf_real_t low = k->tyre.T_anchor[i], high = k->tyre.T_anchor[i + 1];
    tf_real_t begin = 0;
    for (int n = 0; n <= PLACES; n++) {
      tf_real_t end = 1, C = anchor_cos[i + 1], S = anchor_cos[7 - i], T = high;
      if (n < PLACES) {
        if (!(at[n] > low && at[n] < high)) continue;
        end = share_at(k, i, at[n]);
        T = on_chord(k, i, end, &C, &S);
      }
      const tf_real_t to = turning(q, T, C, S);
      const bracket_t part = {begin, end, from, to};
      begin = end;
      from = to;
      const bool attracts = part.f0 > 0;
      if (attracts == (to > 0) || !(way_out || attracts)) continue;
      const limit_t next = limit_in(k, q, i, part);
      if (way_out && !is_better(&next, best)) continue;
      *best = next;
      found = true;
    }
  }
  return found;
}

TF_API bool tf_codim2_attractor(const tf_machine_t *k, const tf_rates_t *a,
                                int roll, int side, tf_real_t *T) {
  const quadrant_t q = quadrant(k, a, roll, side);
  limit_t best = {.speed = 0};
  if (!look_for(k, &q, false, &best)) return false;
  *T = best.T;
  return true;
}

// The exit on one side of h = 0.
static void exit_on(const tf_machine_t *k, const tf_rates_t *a, int side,
                    tf_consistent_t *out) {
  const int slip = side > 0 ? 0 : 1;
  limit_t best = {.speed = 0};
  for (int roll = -1; roll <= 1; roll += 2) {
    const quadrant_t q = quadrant(k, a, roll, side);
    if (look_for(k, &q, true, &best)) out->sign_g[slip] = roll;
  }
  if (!(best.speed > 0)) return;
  out->T[slip] = best.T;
  out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_SLIP_PLUS + slip);
  out->solutions.h_limit[slip] = (tf_real_t)side * best.speed;
}

TF_API void tf_codim2_modes(const tf_machine_t *k, const tf_rates_t *a,
                            tf_consistent_t *out) {
  const tf_real_t mu = k->tyre.mu;
  *out = (tf_consistent_t){.solutions = {.near_stick = TF_STICK_PLUS}};
  tf_solutions_t *set = &out->solutions;
  exit_on(k, a, 1, out);
  exit_on(k, a, -1, out);
  for (int s = 0; s < 2; s++) {
    const tf_real_t sign = s ? TF_R(-1.0) : TF_R(1.0);
    const tf_real_t lambda = a->N / a->A[s];
    const tf_real_t moment = sign * k->stick_kappa * lambda;
    const tf_real_t g = slip_from_pq(k, a->p + lambda * a->Fp,
                                     a->q + lambda * a->Fq + moment * a->Mq)
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
