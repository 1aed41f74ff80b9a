// The consistent modes at h = g = 0. The force of a slip depends there on the
// direction of the slip in the (g, h) plane alone, and a slip can begin or end
// in h = g = 0 only along a limit direction: one whose acceleration has no
// component across it (Antali and Stepan 2018, for extended Filippov systems).
// All limit directions are found, quadrant by quadrant.
#include "codim2.h"

#include <stddef.h>

#include "../model/tyre_law.h"
#include "mode_set.h"
#include "rest_law.h"
#include "select.h"

#define MOST_ITERATIONS 32
#define SEPARATORS 3
#define NO_SEPARATOR TF_REAL_MAX // above every T
// A slip that meets no limit direction has come round after so many.
#define QUADRANTS 5

// One quadrant of the (g, h) plane: the accelerations sign_g g' = g0 + g1 T and
// sign_h h' = h0 + h1 T, which are affine in T = cot(psi).
typedef struct {
  tf_real_t g0, g1, h0, h1;
  int sign_g, sign_h;
} quadrant_t;

// By (force), (moment) in multipliers.
static quadrant_t quadrant_of(const tf_machine_t *k,
                              const codim2_field_t *field, int sign_g,
                              int sign_h) {
  const tf_real_t s_g = (tf_real_t)sign_g, s_h = (tf_real_t)sign_h;
  const multipliers_t at0 = multipliers_at(&k->tyre, 0);
  const tf_real_t x0 = s_h * at0.x, x1 = -s_h * k->tyre.inv_18_kappa;
  const tf_real_t y1 = s_h * s_g * k->tyre.inv_6_kappa;
  const affine_t h = field->h, g = field->g;
  return (quadrant_t){s_g * (g.c0 + x0 * g.cx),
                      s_g * (x1 * g.cx + y1 * g.cy),
                      s_h * (h.c0 + x0 * h.cx),
                      s_h * (x1 * h.cx + y1 * h.cy),
                      sign_g,
                      sign_h};
}

// Whether somewhere in a quadrant h and g both grow in magnitude: only there
// can a slip leave along a limit direction. Both are affine in T.
static bool may_leave(const quadrant_t *q, tf_real_t T_most) {
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

// A part of a chord, by shares, and the values of a function at its ends, which
// have opposite signs.
typedef struct {
  tf_real_t low, high, f_low, f_high;
} bracket_t;

// The zero in a bracket of the angular rate of a quadrant or, without one, of
// T - T0, by regula falsi with the Illinois modification: an end that is kept
// twice has its value halved.
static direction_t zero_on_chord(const tf_machine_t *k, const quadrant_t *q,
                                 tf_real_t T0, int anchor, bracket_t in,
                                 tf_real_t *share) {
  const bool falls = in.f_low > 0;
  direction_t at = {1, 0, 0};
  int kept = 0;
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    *share = (in.f_low * in.high - in.f_high * in.low) / (in.f_low - in.f_high);
    at = on_chord(k, anchor, *share);
    const tf_real_t f = q ? angular_rate(q, at) : at.T - T0;
    if (!(in.high - in.low > 4 * TF_REAL_EPSILON)) break;
    if ((f > 0) == falls) {
      if (!(*share - in.low > TF_REAL_EPSILON * *share)) break;
      in.low = *share;
      in.f_low = f;
      if (kept == 1) in.f_high /= 2;
      kept = 1;
    } else {
      if (!(in.high - *share > TF_REAL_EPSILON * *share)) break;
      in.high = *share;
      in.f_high = f;
      if (kept == -1) in.f_low /= 2;
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

typedef struct {
  tf_real_t T;       // its cot(psi)
  tf_real_t C, S;    // cosine and sine of its angle from the h axis
  tf_real_t speed;   // outwards [m/s^2]
  bool is_attractor; // its neighbours turn to it as time runs on
  int sign_g;        // of its quadrant; 0: no direction
} limit_direction_t;

static const limit_direction_t no_direction = {0, 0, 0, 0, false, 0};

static limit_direction_t limit_direction_in(const tf_machine_t *k,
                                            const quadrant_t *q, int anchor,
                                            bracket_t in) {
  tf_real_t share;
  const direction_t at = zero_on_chord(k, q, 0, anchor, in, &share);
  const tf_real_t length = square_root(at.C * at.C + at.S * at.S);
  return (limit_direction_t){at.T,          at.C / length,
                             at.S / length, radial_rate(q, at),
                             in.f_low > 0,  q->sign_g};
}

// Which of the limit directions of a quadrant is asked for: the best exit, or
// the first one that a slip turns to from T towards larger or smaller ones.
typedef struct {
  bool leaves, upwards;
  tf_real_t T;
} search_t;

static const search_t exits = {true, false, 0};

// Of two exits the one to which its neighbours turn, then the faster one. The
// limit directions come by increasing T.
static bool is_better(const search_t *search, const limit_direction_t *next,
                      const limit_direction_t *best) {
  if (!search->leaves)
    return next->is_attractor &&
           (search->upwards ? next->T >= search->T && !best->sign_g
                            : next->T <= search->T);
  if (!(next->speed > 0)) return false;
  return next->is_attractor == best->is_attractor ? next->speed > best->speed
                                                  : next->is_attractor;
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
// its lower neighbour separates nothing. Returns what is asked for, or the best
// so far where none is better.
static limit_direction_t search_quadrant(const tf_machine_t *k,
                                         const quadrant_t *q,
                                         const search_t *search,
                                         limit_direction_t best) {
  const separators_t separators = find_separators(k, q);
  tf_real_t from = angular_rate(q, (direction_t){1, 0, 0});
  for (int i = 0; i < 8; i++) {
    const tf_real_t low = k->tyre.T_anchor[i], high = k->tyre.T_anchor[i + 1];
    tf_real_t begin = 0;
    for (int n = 0; n <= SEPARATORS; n++) {
      const tf_real_t T = n < SEPARATORS ? separators.T[n] : high;
      tf_real_t end = 1;
      direction_t at = {anchor_cos[i + 1], anchor_cos[7 - i], high};
      if (n < SEPARATORS) {
        if (!(T > low && T < high) || has_sign_at(q, i, T, from > 0)) continue;
        const bracket_t chord = {0, 1, low - T, high - T};
        at = zero_on_chord(k, NULL, T, i, chord, &end);
      }
      const tf_real_t to = angular_rate(q, at);
      const bracket_t part = {begin, end, from, to};
      begin = end;
      from = to;
      if ((part.f_low > 0) == (to > 0)) continue;
      const limit_direction_t next = limit_direction_in(k, q, i, part);
      if (is_better(search, &next, &best)) best = next;
    }
  }
  return best;
}

TF_API codim2_field_t tf_codim2_field_of(const tf_machine_t *k,
                                         const rates_t *rates) {
  const tf_slip_t free = slip_from_pq(k, rates->p, rates->q);
  const tf_slip_t F = slip_from_pq(k, rates->Fp, rates->Fq);
  const tf_slip_t M = slip_from_pq(k, 0, rates->Mq);
  const tf_real_t mu = k->tyre.mu;
  return (codim2_field_t){
      {free.h, mu * F.h, k->kappa_mu * M.h},
      {free.g, mu * F.g, k->kappa_mu * M.g},
      {rates->pinning.F * k->inv_mu, rates->pinning.M * k->inv_kappa_mu}};
}

TF_API bool tf_codim2_attractor(const tf_machine_t *k,
                                const codim2_field_t *field, int sign_g,
                                int sign_h, tf_real_t *T) {
  const quadrant_t q = quadrant_of(k, field, sign_g, sign_h);
  const search_t last = {false, false, TF_REAL_MAX};
  const limit_direction_t to = search_quadrant(k, &q, &last, no_direction);
  if (to.sign_g) *T = to.T;
  return to.sign_g != 0;
}

// The best exit into the side h > 0 or h < 0, from both of its quadrants.
static void add_exit(const tf_machine_t *k, const codim2_field_t *field,
                     int sign_h, consistent_modes_t *out) {
  const int slip = sign_h > 0 ? 0 : 1;
  limit_direction_t best = no_direction;
  for (int n = 0; n < 2; n++) {
    const quadrant_t q = quadrant_of(k, field, n ? 1 : -1, sign_h);
    if (may_leave(&q, k->tyre.T_anchor[TF_TYRE_ANCHORS - 1]))
      best = search_quadrant(k, &q, &exits, best);
  }
  if (!best.sign_g) return;
  const unsigned bit = TF_MODE_BIT(TF_SLIP_PLUS + slip);
  out->T[slip] = best.T;
  out->sign_g[slip] = best.sign_g;
  out->solutions.set |= (uint8_t)bit;
  if (best.is_attractor) out->solutions.attracting |= (uint8_t)bit;
  out->solutions.h_limit[slip] = (tf_real_t)sign_h * best.speed;
}

// How fast g grows in the stick with the sign s of g.
static tf_real_t stick_rate(const codim2_field_t *field, int s) {
  const tf_real_t sign = s ? TF_R(-1.0) : TF_R(1.0);
  const affine_t h = field->h, g = field->g;
  const tf_real_t x = -h.c0 / (h.cx + sign * h.cy);
  return sign * (g.c0 + x * (g.cx + sign * g.cy));
}

// The stick with the sign s of g, if the law has the force that keeps h at 0
// and g gets that sign under it. Returns how fast g grows, 0 where it does not.
static tf_real_t add_stick(const tf_machine_t *k, const codim2_field_t *field,
                           int s, consistent_modes_t *out) {
  solutions_t *solutions = &out->solutions;
  const tf_real_t sign = s ? TF_R(-1.0) : TF_R(1.0);
  const tf_real_t slope = field->h.cx + sign * field->h.cy;
  const tf_real_t x = -field->h.c0 / slope, rate = stick_rate(field, s);
  if (slope < 0)
    solutions->attracting |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
  if (!within(x, 1) || !(rate > 0)) return 0;
  solutions->set |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
  out->lambda[s] = x * k->tyre.mu;
  return rate;
}

TF_API void tf_codim2_modes(const tf_machine_t *k, const codim2_field_t *field,
                            consistent_modes_t *out) {
  *out = (consistent_modes_t){.solutions = {.set = 0}};
  add_exit(k, field, 1, out);
  add_exit(k, field, -1, out);
  const tf_real_t plus = add_stick(k, field, 0, out);
  const tf_real_t minus = add_stick(k, field, 1, out);
  out->solutions.near_stick = minus > plus ? TF_STICK_MINUS : TF_STICK_PLUS;
  if (rests_under(k->rest, field->pin.x, field->pin.y))
    out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}

TF_API unsigned tf_leave_codim2(const tf_machine_t *k,
                                const codim2_field_t *field, unsigned from,
                                bool arrives, const tf_state_t *state,
                                consistent_modes_t *out) {
  tf_codim2_modes(k, field, out);
  // Where the law of stick holds the wheel, a stick that arrives goes on.
  if (arrives && from > TF_SLIP_MINUS &&
      rests_under(TF_REST_BOW_TIE, field->pin.x, field->pin.y))
    out->solutions.attracting |= (uint8_t)TF_MODE_BIT(TF_PINNED);
  const bool lost =
      arrives || (from != TF_PINNED && !has(out->solutions.set, from));
  return tf_select(k->rule, k->exit_threshold, &out->solutions,
                   lost ? TF_NO_MODE : from, state->tick, state->seed);
}

static codim2_way_t way_of_slip(const tf_machine_t *k,
                                const limit_direction_t *to, int sign_h) {
  const tf_real_t s_h = (tf_real_t)sign_h, s_g = (tf_real_t)to->sign_g;
  const multipliers_t m = multipliers_at(&k->tyre, to->T);
  return (codim2_way_t){sign_h > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS,
                        {s_h * to->C, s_g * to->S},
                        {s_h * m.x, s_h * s_g * m.y},
                        to->speed};
}

static codim2_way_t way_of_stick(const codim2_field_t *field, int sign_g) {
  const tf_real_t s_g = (tf_real_t)sign_g;
  const tf_real_t x = -field->h.c0 / (field->h.cx + s_g * field->h.cy);
  return (codim2_way_t){sign_g > 0 ? TF_STICK_PLUS : TF_STICK_MINUS,
                        {0, s_g},
                        {x, s_g * x},
                        stick_rate(field, sign_g < 0)};
}

TF_API codim2_way_t tf_codim2_destination(const tf_machine_t *k,
                                          const codim2_field_t *field,
                                          tf_slip_t slip, int sign_h) {
  const direction_t steepest = {0, 1, k->tyre.T_anchor[TF_TYRE_ANCHORS - 1]};
  const direction_t flattest = {1, 0, 0};
  const tf_real_t H = (tf_real_t)sign_h * slip.h, C = H > 0 ? H : 0;
  const tf_real_t S = magnitude(slip.g);
  int sign_g = slip.g < 0 ? -1 : 1;
  direction_t at = {C, S, cot_psi(&k->tyre, S, C)};
  quadrant_t q = quadrant_of(k, field, sign_g, sign_h);
  bool upwards = angular_rate(&q, at) > 0;
  for (int turn = 0; turn < QUADRANTS; turn++) {
    const search_t next = {false, upwards, at.T};
    const limit_direction_t to = search_quadrant(k, &q, &next, no_direction);
    if (to.sign_g) return way_of_slip(k, &to, sign_h);
    if (upwards)
      sign_h = -sign_h;
    else
      sign_g = -sign_g;
    at = upwards ? steepest : flattest;
    q = quadrant_of(k, field, sign_g, sign_h);
    if (upwards && angular_rate(&q, at) > 0) return way_of_stick(field, sign_g);
    upwards = !upwards;
  }
  return (codim2_way_t){.mode = TF_NO_MODE};
}
