// All limit directions of a quadrant are bracketed, by anchors of T and by
// separators between which there is at most one, and those that are asked for
// are solved for.
#include "quadrant.h"

#include <stddef.h>

#define MOST_ITERATIONS 32
#define SEPARATORS 3
#define NO_SEPARATOR TF_REAL_MAX // above every T

// By (force), (moment) in multipliers.
TF_API quadrant_t tf_quadrant_of(const tf_tyre_t *tyre,
                                 const codim2_field_t *field, int sign_g,
                                 int sign_h) {
  const tf_real_t s_g = (tf_real_t)sign_g, s_h = (tf_real_t)sign_h;
  const multipliers_t at0 = multipliers_at(tyre, 0);
  const tf_real_t x0 = s_h * at0.x, x1 = -s_h * tyre->inv_18_kappa;
  const tf_real_t y1 = s_h * s_g * tyre->inv_6_kappa;
  const affine_t h = field->h, g = field->g;
  return (quadrant_t){s_g * (g.c0 + x0 * g.cx),
                      s_g * (x1 * g.cx + y1 * g.cy),
                      s_h * (h.c0 + x0 * h.cx),
                      s_h * (x1 * h.cx + y1 * h.cy),
                      sign_g,
                      sign_h};
}

// Both accelerations are affine in T.
TF_API bool tf_may_leave(const quadrant_t *q, tf_real_t T_most) {
  tf_real_t low = 0, high = T_most;
  const tf_real_t value[2] = {q->g0, q->h0}, slope[2] = {q->g1, q->h1};
  for (int i = 0; i < 2; i++) {
    if (!(value[i] > 0) && !(value[i] + slope[i] * T_most > 0)) return false;
    const tf_real_t zero = slope[i] != 0 ? -value[i] / slope[i] : low;
    if (!(value[i] > 0) && zero > low) low = zero;
    if (value[i] > 0 && slope[i] < 0 && zero < high) high = zero;
  }
  return low <= high;
}

// The acceleration along a direction, > 0 away from h = g = 0.
static tf_real_t radial_rate(const quadrant_t *q, direction_t at) {
  return ((q->g0 + q->g1 * at.T) * at.S + (q->h0 + q->h1 * at.T) * at.C) /
         square_root(at.C * at.C + at.S * at.S);
}

// The direction at a share of the chord between an anchor of the angle kernel
// and the next one. T depends on the ratio of sine and cosine alone, so the
// chord serves as well as the arc.
static direction_t on_chord(const tf_tyre_t *tyre, int anchor,
                            tf_real_t share) {
  const tf_real_t C = anchor_cos[anchor] +
                      share * (anchor_cos[anchor + 1] - anchor_cos[anchor]);
  const tf_real_t S = anchor_cos[8 - anchor] +
                      share * (anchor_cos[7 - anchor] - anchor_cos[8 - anchor]);
  return (direction_t){C, S, cot_psi(tyre, S, C)};
}

// A part of a chord, by shares, and the values of a function at its ends, which
// have opposite signs.
typedef struct {
  tf_real_t low, high, f_low, f_high;
} bracket_t;

// The zero in a bracket of the angular rate of a quadrant or, without one, of
// T - T0, and its share of the chord, by regula falsi with the Illinois
// modification: an end that is kept twice has its value halved.
static direction_t zero_on_chord(const tf_tyre_t *tyre, const quadrant_t *q,
                                 tf_real_t T0, int anchor, bracket_t in,
                                 tf_real_t *share) {
  const bool falls = in.f_low > 0;
  direction_t at = {1, 0, 0};
  int kept = 0; // > 0: the upper end, < 0: the lower one
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    *share = (in.f_low * in.high - in.f_high * in.low) / (in.f_low - in.f_high);
    at = on_chord(tyre, anchor, *share);
    const tf_real_t f = q ? angular_rate(q, at) : at.T - T0;
    if (!(in.high - in.low > 4 * TF_REAL_EPSILON)) break;
    if ((f > 0) == falls) {
      if (!(*share - in.low > TF_REAL_EPSILON * *share)) break;
      if (kept > 0) in.f_high /= 2;
      in.low = *share;
      in.f_low = f;
      kept = 1;
    } else {
      if (!(in.high - *share > TF_REAL_EPSILON * *share)) break;
      if (kept < 0) in.f_low /= 2;
      in.high = *share;
      in.f_high = f;
      kept = -1;
    }
  }
  return at;
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
static separators_t find_separators(const tf_tyre_t *tyre,
                                    const quadrant_t *q) {
  const tf_real_t slope = q->h1 * q->h1 + q->g1 * q->g1;
  const tf_real_t half = q->h0 * q->h1 + q->g0 * q->g1;
  const tf_real_t swing = tyre->T_series[0] * (q->h0 * q->g1 - q->g0 * q->h1);
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

static limit_direction_t limit_direction_in(const tf_tyre_t *tyre,
                                            const quadrant_t *q, int anchor,
                                            bracket_t in) {
  tf_real_t share;
  const direction_t at = zero_on_chord(tyre, q, 0, anchor, in, &share);
  const tf_real_t length = square_root(at.C * at.C + at.S * at.S);
  return (limit_direction_t){at.T,          at.C / length,
                             at.S / length, radial_rate(q, at),
                             in.f_low > 0,  q->sign_g};
}

// Of two exits the one to which its neighbours turn, then the faster one. Of
// those that may_be_better() has left, which come by increasing T, the first
// from T upwards, or the last one up to T.
static bool is_better(const search_t *search, const limit_direction_t *next,
                      const limit_direction_t *best) {
  if (!search->leaves)
    return search->upwards ? next->T >= search->T : next->T <= search->T;
  if (!(next->speed > 0)) return false;
  return next->is_attractor == best->is_attractor ? next->speed > best->speed
                                                  : next->is_attractor;
}

// Whether a limit direction between two values of T may be better, from what is
// known before it is solved for. Both accelerations are affine in T.
static bool may_be_better(const search_t *search, const quadrant_t *q,
                          bool attracts, tf_real_t low, tf_real_t high,
                          const limit_direction_t *best) {
  if (search->leaves)
    return (q->g0 + q->g1 * low > 0 || q->g0 + q->g1 * high > 0) &&
           (q->h0 + q->h1 * low > 0 || q->h0 + q->h1 * high > 0);
  return attracts &&
         (search->upwards ? (high >= search->T) & (best->sign_g == 0)
                          : low <= search->T);
}

// Whether the angular rate surely has this sign where T has a value on a chord:
// for one T it is linear along it.
static bool has_sign_at(const quadrant_t *q, int anchor, tf_real_t T,
                        bool positive) {
  const direction_t low = {anchor_cos[anchor], anchor_cos[8 - anchor], T};
  const direction_t high = {anchor_cos[anchor + 1], anchor_cos[7 - anchor], T};
  return (angular_rate(q, low) > 0) == positive &&
         (angular_rate(q, high) > 0) == positive;
}

// They lie where the angular rate changes its sign between two neighbours of
// the anchors and the separators. A separator at which the rate has the sign of
// its lower neighbour separates nothing.
TF_API limit_direction_t tf_search_quadrant(const tf_tyre_t *tyre,
                                            const quadrant_t *q,
                                            const search_t *search,
                                            limit_direction_t best) {
  const separators_t separators = find_separators(tyre, q);
  tf_real_t from = angular_rate(q, (direction_t){1, 0, 0});
  for (int i = 0; i < 8; i++) {
    const tf_real_t low = tyre->T_anchor[i], high = tyre->T_anchor[i + 1];
    tf_real_t begin = 0;
    for (int n = 0; n <= SEPARATORS; n++) {
      const tf_real_t T = n < SEPARATORS ? separators.T[n] : high;
      tf_real_t end = 1;
      direction_t at = {anchor_cos[i + 1], anchor_cos[7 - i], high};
      if (n < SEPARATORS) {
        if (!(T > low && T < high) || has_sign_at(q, i, T, from > 0)) continue;
        const bracket_t chord = {0, 1, low - T, high - T};
        at = zero_on_chord(tyre, NULL, T, i, chord, &end);
      }
      const tf_real_t to = angular_rate(q, at);
      const bracket_t part = {begin, end, from, to};
      begin = end;
      from = to;
      if ((part.f_low > 0) == (to > 0) ||
          !may_be_better(search, q, part.f_low > 0, low, high, &best))
        continue;
      const limit_direction_t next = limit_direction_in(tyre, q, i, part);
      if (is_better(search, &next, &best)) best = next;
    }
  }
  return best;
}
