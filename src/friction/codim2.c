// The consistent modes at h = g = 0. The force of a slip depends there on the
// direction of the slip in the (g, h) plane alone, and a slip can begin or end
// in h = g = 0 only along a limit direction: one whose acceleration has no
// component across it (Antali and Stepan 2018, for extended Filippov systems).
// All limit directions are found, quadrant by quadrant.
#include "codim2.h"

#include "../model/tyre_law.h"

#define MOST_ITERATIONS 32
#define SHARE_BITS 32
#define SEPARATORS 3
#define NO_SEPARATOR TF_REAL_MAX // above every T

// One quadrant of the (g, h) plane: the accelerations sign_g g' = g0 + g1 T and
// sign_h h' = h0 + h1 T, which are affine in T = cot(psi).
typedef struct {
  tf_real_t g0, g1, h0, h1;
} quadrant_t;

// By (force), (moment) and (h), (g).
static quadrant_t quadrant_of(const tf_machine_t *k, const rates_t *rates,
                              int sign_g, int sign_h) {
  const tf_real_t s_g = (tf_real_t)sign_g, s_h = (tf_real_t)sign_h;
  const tf_real_t F0 = slip_F0(&k->tyre, s_h), F1 = slip_F1(&k->tyre, s_h);
  const tf_real_t M1 = slip_M1(&k->tyre, (tf_real_t)(sign_h * sign_g));
  const tf_slip_t at0 =
      slip_from_pq(k, rates->p + F0 * rates->Fp, rates->q + F0 * rates->Fq);
  const tf_slip_t at1 =
      slip_from_pq(k, F1 * rates->Fp, F1 * rates->Fq + M1 * rates->Mq);
  return (quadrant_t){s_g * at0.g, s_g * at1.g, s_h * at0.h, s_h * at1.h};
}

// A direction by cosine and sine of its angle from the h axis, which need no
// common factor, and its T.
typedef struct {
  tf_real_t C, S, T;
} direction_t;

// The acceleration across a direction, > 0 towards larger |g/h|, times the
// length of (C, S): zero along a limit direction.
static tf_real_t angular_rate(const quadrant_t *q, direction_t at) {
  return (q->g0 + q->g1 * at.T) * at.C - (q->h0 + q->h1 * at.T) * at.S;
}

// The acceleration along a direction, > 0 away from h = g = 0.
static tf_real_t radial_rate(const quadrant_t *q, direction_t at) {
  return ((q->g0 + q->g1 * at.T) * at.S + (q->h0 + q->h1 * at.T) * at.C) /
         square_root(at.C * at.C + at.S * at.S);
}

// The direction at a share of the chord between an anchor of the angle kernel
// and the next one. T depends on the ratio of sine and cosine alone, so the
// chord serves as well as the arc.
static direction_t on_chord(const tf_machine_t *k, int anchor,
                            tf_real_t share) {
  const tf_real_t C = anchor_cos[anchor] +
                      share * (anchor_cos[anchor + 1] - anchor_cos[anchor]);
  const tf_real_t S = anchor_cos[8 - anchor] +
                      share * (anchor_cos[7 - anchor] - anchor_cos[8 - anchor]);
  return (direction_t){C, S, cot_psi(&k->tyre, S, C)};
}

typedef struct {
  tf_real_t T;       // its cot(psi)
  tf_real_t speed;   // outwards [m/s^2]
  bool is_attractor; // its neighbours turn to it as time runs on
} limit_direction_t;

// A part of a chord, by shares, and the angular rates at its ends, which have
// opposite signs.
typedef struct {
  tf_real_t low, high, f_low, f_high;
} bracket_t;

// The zero of the angular rate in a bracket, by regula falsi with the Illinois
// modification: an end that is kept twice has its value halved.
static limit_direction_t limit_direction_in(const tf_machine_t *k,
                                            const quadrant_t *q, int anchor,
                                            bracket_t in) {
  const bool attracts = in.f_low > 0;
  direction_t at = {1, 0, 0};
  int kept = 0;
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    const tf_real_t share =
        (in.f_low * in.high - in.f_high * in.low) / (in.f_low - in.f_high);
    at = on_chord(k, anchor, share);
    const tf_real_t f = angular_rate(q, at);
    if (!(in.high - in.low > 4 * TF_REAL_EPSILON)) break;
    if ((f > 0) == attracts) {
      if (!(share - in.low > TF_REAL_EPSILON * share)) break;
      in.low = share;
      in.f_low = f;
      if (kept == 1) in.f_high /= 2;
      kept = 1;
    } else {
      if (!(in.high - share > TF_REAL_EPSILON * share)) break;
      in.high = share;
      in.f_high = f;
      if (kept == -1) in.f_low /= 2;
      kept = -1;
    }
  }
  return (limit_direction_t){at.T, radial_rate(q, at), attracts};
}

// The share of the chord at which T has this value, to SHARE_BITS.
static tf_real_t share_of(const tf_machine_t *k, int anchor, tf_real_t T) {
  tf_real_t low = 0, high = 1;
  for (int n = 0; n < SHARE_BITS; n++) {
    const tf_real_t share = (low + high) / 2;
    if (on_chord(k, anchor, share).T < T)
      low = share;
    else
      high = share;
  }
  return high;
}

static void order_two(tf_real_t T[2]) {
  if (!(T[0] > T[1])) return;
  const tf_real_t larger = T[0];
  T[0] = T[1];
  T[1] = larger;
}

// Values of T, which is >= 0, in order.
typedef struct {
  tf_real_t T[SEPARATORS];
} separators_t;

// The values of T between which there is at most one limit direction, and one
// exactly where the angular rate changes its sign.
//
// The angular rate vanishes where (h0 + h1 T, g0 + g1 T) has the angle psi of
// the slip, T = tan(a psi), or that and pi. The difference of both angles grows
// where
//   a (1 + T^2) (h0 g1 - g0 h1) > (h0 + h1 T)^2 + (g0 + g1 T)^2
// and falls elsewhere, so it has its extrema at the roots of a quadratic. The
// line of these vectors turns by pi at most in all, by half of that on either
// side of its point next to 0. So between these three, and within pi/16 of psi,
// the difference changes in one sense and by less than pi.
static separators_t find_separators(const tf_machine_t *k,
                                    const quadrant_t *q) {
  const tf_real_t slope = q->h1 * q->h1 + q->g1 * q->g1;
  const tf_real_t half = q->h0 * q->h1 + q->g0 * q->g1;
  const tf_real_t swing = k->tyre.T_series[0] * (q->h0 * q->g1 - q->g0 * q->h1);
  const tf_real_t constant = swing - q->h0 * q->h0 - q->g0 * q->g0;
  const tf_real_t discriminant = half * half - (swing - slope) * constant;
  separators_t out = {{-half / slope, NO_SEPARATOR, NO_SEPARATOR}};
  if (!(discriminant > 0)) return out;
  const tf_real_t root = square_root(discriminant);
  const tf_real_t sum = half < 0 ? half - root : half + root;
  tf_real_t *T = out.T;
  T[1] = sum / (swing - slope);
  T[2] = constant / sum;
  order_two(T);
  order_two(T + 1);
  order_two(T);
  return out;
}

typedef enum { FOR_ATTRACTOR, FOR_EXIT } search_t;

// Of two exits the one to which its neighbours turn, then the faster one.
static bool is_better_exit(const limit_direction_t *next,
                           const limit_direction_t *best) {
  if (!(next->speed > 0)) return false;
  return next->is_attractor == best->is_attractor ? next->speed > best->speed
                                                  : next->is_attractor;
}

// Looks for the attractor of a quadrant, or for a better exit than the best one
// so far. Limit directions lie where the angular rate changes its sign between
// two neighbours of the anchors and the separators. Returns whether there is
// one.
static bool search_quadrant(const tf_machine_t *k, const quadrant_t *q,
                            search_t search, limit_direction_t *best) {
  const separators_t separators = find_separators(k, q);
  const tf_real_t *separator = separators.T;
  tf_real_t from = angular_rate(q, (direction_t){1, 0, 0});
  bool found = false;
  for (int i = 0; i < 8; i++) {
    const tf_real_t low = k->tyre.T_anchor[i], high = k->tyre.T_anchor[i + 1];
    tf_real_t begin = 0;
    for (int n = 0; n <= SEPARATORS; n++) {
      tf_real_t end = 1;
      direction_t at = {anchor_cos[i + 1], anchor_cos[7 - i], high};
      if (n < SEPARATORS) {
        if (!(separator[n] > low && separator[n] < high)) continue;
        end = share_of(k, i, separator[n]);
        at = on_chord(k, i, end);
      }
      const tf_real_t to = angular_rate(q, at);
      const bracket_t part = {begin, end, from, to};
      begin = end;
      from = to;
      const bool attracts = part.f_low > 0;
      if (attracts == (to > 0) || !(search == FOR_EXIT || attracts)) continue;
      const limit_direction_t next = limit_direction_in(k, q, i, part);
      if (search == FOR_EXIT && !is_better_exit(&next, best)) continue;
      *best = next;
      found = true;
    }
  }
  return found;
}

TF_API bool tf_codim2_attractor(const tf_machine_t *k, const rates_t *rates,
                                int sign_g, int sign_h, tf_real_t *T) {
  const quadrant_t q = quadrant_of(k, rates, sign_g, sign_h);
  limit_direction_t attractor = {.speed = 0};
  if (!search_quadrant(k, &q, FOR_ATTRACTOR, &attractor)) return false;
  *T = attractor.T;
  return true;
}

// The best exit into the side h > 0 or h < 0, from both of its quadrants.
static void add_exit(const tf_machine_t *k, const rates_t *rates, int sign_h,
                     consistent_modes_t *out) {
  const int slip = sign_h > 0 ? 0 : 1;
  limit_direction_t best = {.speed = 0};
  for (int sign_g = -1; sign_g <= 1; sign_g += 2) {
    const quadrant_t q = quadrant_of(k, rates, sign_g, sign_h);
    if (search_quadrant(k, &q, FOR_EXIT, &best)) out->sign_g[slip] = sign_g;
  }
  if (!(best.speed > 0)) return;
  out->T[slip] = best.T;
  out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_SLIP_PLUS + slip);
  out->solutions.h_limit[slip] = (tf_real_t)sign_h * best.speed;
}

// The stick with the sign s of g, if lambda = N/A is one of the law and g gets
// that sign under it.
static void add_stick(const tf_machine_t *k, const rates_t *rates, int s,
                      consistent_modes_t *out) {
  solutions_t *solutions = &out->solutions;
  const tf_real_t sign = s ? TF_R(-1.0) : TF_R(1.0);
  const tf_real_t lambda = rates->N / rates->A[s];
  const tf_real_t g = g_rate_in_stick(k, rates, s, lambda);
  if (rates->A[s] > 0)
    solutions->attracting |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
  if (!within(lambda, k->tyre.mu) || !(sign * g > 0)) return;
  solutions->set |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
  out->lambda[s] = lambda;
}

TF_API void tf_codim2_modes(const tf_machine_t *k, const rates_t *rates,
                            consistent_modes_t *out) {
  *out = (consistent_modes_t){.solutions = {.near_stick = TF_STICK_PLUS}};
  add_exit(k, rates, 1, out);
  add_exit(k, rates, -1, out);
  add_stick(k, rates, 0, out);
  add_stick(k, rates, 1, out);
  if (within(rates->pinning.F, k->tyre.mu) &&
      within(rates->pinning.M, k->stick_kappa * magnitude(rates->pinning.F)))
    out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}
