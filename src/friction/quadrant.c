// All limit directions of a quadrant are bracketed, by anchors of T and by
// separators between which there is at most one; those that are sought are
// solved for.
#include "quadrant.h"

#define MAX_ITERATIONS 8
#define SEPARATORS 3
#define NO_SEPARATOR TF_REAL_MAX // above every T

// By (force), (moment) in multipliers.
TF_API quadrant_t tf_quadrant_of(const tf_tyre_t *tyre,
                                 const codim2_field_t *field, sign_t sign_g,
                                 sign_t sign_h) {
  const tf_real_t s_g = unit(sign_g), s_h = unit(sign_h);
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

// What lies next to one anchor of the angle kernel: directions (c - s x, s + c
// x) and T = (T_k + u)/(1 - T_k u), where |x| <= tan(pi/32) and u(x) = tan(a
// atan x). Times 1 - T_k u, which is positive, the angular rate is there
//   c0 + cu u + cx x + cux u x,
// which is next to a quadratic, as u is next to a x.
typedef struct {
  tf_real_t c0, cu, cx, cux;
} cell_t;

static cell_t cell_of(const quadrant_t *q, int anchor, tf_real_t T) {
  const tf_real_t c = anchor_cos[anchor], s = anchor_cos[8 - anchor];
  const tf_real_t g = q->g0 + q->g1 * T, h = q->h0 + q->h1 * T;
  const tf_real_t gu = q->g1 - q->g0 * T, hu = q->h1 - q->h0 * T;
  return (cell_t){g * c - h * s, gu * c - hu * s, -(g * s + h * c),
                  -(gu * s + hu * c)};
}

static direction_t direction_in(int anchor, tf_real_t x, tf_real_t T) {
  const tf_real_t c = anchor_cos[anchor], s = anchor_cos[8 - anchor];
  return (direction_t){c - s * x, s + c * x, T};
}

// A part of a cell, and whether the angular rate is positive at its lower end
// and negative at its upper one, or vice versa.
typedef struct {
  tf_real_t low, high;
  bool falls;
} bracket_t;

// The step to the zero of f + f1 d + f2 d^2/2 on one side; to its extremum
// where it has none.
static tf_real_t step_to_zero(tf_real_t f, tf_real_t f1, tf_real_t f2,
                              bool upwards) {
  const tf_real_t discriminant = f1 * f1 - 2 * f * f2;
  const tf_real_t root = discriminant > 0 ? square_root(discriminant) : 0;
  const tf_real_t sum = f1 < 0 ? root - f1 : -root - f1;
  const tf_real_t nearer = 2 * f / sum;
  return (nearer > 0) == upwards ? nearer : sum / f2;
}

typedef struct {
  tf_real_t x, u;
} cell_point_t;

// The zero in a bracket, by Euler's method: from point to point to the zero of
// the quadratic that has the same first two derivatives, or, where that lies
// outside, to the middle. With u' = a (1 + u^2)/(1 + x^2).
static cell_point_t zero_in(const tf_tyre_t *tyre, const cell_t *cell,
                            bracket_t in) {
  cell_point_t at = {clip(0, in.low, in.high), 0};
  for (int i = 0; i < MAX_ITERATIONS; i++) {
    const tf_real_t x = at.x, u = cot_psi_near_zero(tyre, x);
    at.u = u;
    const tf_real_t tu = cell->cu * u, tx = cell->cx * x;
    const tf_real_t tux = cell->cux * u * x, f = cell->c0 + tu + tx + tux;
    const tf_real_t size =
        magnitude(cell->c0) + magnitude(tu) + magnitude(tx) + magnitude(tux);
    if (!(magnitude(f) > 2 * TF_REAL_EPSILON * size)) break;
    const bool upwards = (f > 0) == in.falls;
    if (upwards)
      in.low = x;
    else
      in.high = x;
    const tf_real_t slant = 1 / (1 + x * x), a = tyre->T_series[0];
    const tf_real_t u1 = a * (1 + u * u) * slant;
    const tf_real_t u2 = 2 * u1 * (a * u - x) * slant;
    const tf_real_t by_u = cell->cu + cell->cux * x;
    const tf_real_t f1 = by_u * u1 + cell->cx + cell->cux * u;
    const tf_real_t f2 = by_u * u2 + 2 * cell->cux * u1;
    at.x += step_to_zero(f, f1, f2, upwards);
    if (!(at.x > in.low && at.x < in.high))
      at.x = in.low + (in.high - in.low) / 2;
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
// exactly where the angular rate changes its sign. It vanishes where
// (h0 + h1 T, g0 + g1 T) has the angle psi of the slip, T = tan(a psi), or that
// and pi. The difference of both angles has its extrema where
//   a (1 + T^2) (h0 g1 - g0 h1) = (h0 + h1 T)^2 + (g0 + g1 T)^2,
// a quadratic, and the line of these vectors turns by half of pi at most on
// either side of its point next to 0. So between these three, and within pi/16
// of psi, the difference changes in one sense and by less than pi.
static separators_t find_separators(const tf_tyre_t *tyre,
                                    const quadrant_t *q) {
  const tf_real_t slope = q->h1 * q->h1 + q->g1 * q->g1;
  const tf_real_t half = q->h0 * q->h1 + q->g0 * q->g1;
  const tf_real_t turning = tyre->T_series[0] * (q->h0 * q->g1 - q->g0 * q->h1);
  const tf_real_t constant = turning - q->h0 * q->h0 - q->g0 * q->g0;
  const tf_real_t discriminant = half * half - (turning - slope) * constant;
  separators_t out = {{-half / slope, NO_SEPARATOR, NO_SEPARATOR}};
  if (!(discriminant > 0)) return out;
  const tf_real_t root = square_root(discriminant);
  const tf_real_t sum = half < 0 ? half - root : half + root;
  tf_real_t *T = out.T;
  T[1] = sum / (turning - slope);
  T[2] = constant / sum;
  order_two(T);
  order_two(T + 1);
  order_two(T);
  return out;
}

static limit_direction_t limit_direction_in(const tf_tyre_t *tyre,
                                            const quadrant_t *q, int anchor,
                                            bracket_t in) {
  const cell_t cell = cell_of(q, anchor, tyre->T_anchor[anchor]);
  const cell_point_t zero = zero_in(tyre, &cell, in);
  const tf_real_t T = cot_psi_beyond(tyre->T_anchor[anchor], zero.u);
  const direction_t at = direction_in(anchor, zero.x, T);
  const tf_real_t length = square_root(at.C * at.C + at.S * at.S);
  // The acceleration along it, > 0 away from h = g = 0.
  const tf_real_t growth =
      ((q->g0 + q->g1 * at.T) * at.S + (q->h0 + q->h1 * at.T) * at.C) / length;
  return (limit_direction_t){T,        at.C / length, at.S / length, growth,
                             in.falls, true,          q->sign_g};
}

// Of two exits the one to which its neighbours turn, then the faster one. Of
// those that may_be_better() has left, which come by increasing T, the first
// from T upwards, or the last one up to T.
static bool is_better(const search_t *search, const limit_direction_t *next,
                      const limit_direction_t *best) {
  if (!search->leaves)
    return search->upwards ? next->T >= search->T : next->T <= search->T;
  if (!(next->growth > 0)) return false;
  return next->is_attractor == best->is_attractor ? next->growth > best->growth
                                                  : next->is_attractor;
}

// The part of the cell of an anchor that lies in the quadrant: T at its ends,
// and x there.
typedef struct {
  int anchor;
  tf_real_t T_low, T_high;
} cell_part_t;

static tf_real_t low_end(int anchor) { return anchor > 0 ? -border[0] : 0; }

static tf_real_t high_end(int anchor) {
  return anchor < TF_TYRE_ANCHORS - 1 ? border[0] : 0;
}

// Whether what is sought may lie in a cell. Both accelerations are affine in T.
static bool may_be_in(const search_t *search, const quadrant_t *q,
                      const cell_part_t *span) {
  const tf_real_t low = span->T_low, high = span->T_high;
  if (search->leaves)
    return (q->g0 + q->g1 * low > 0 || q->g0 + q->g1 * high > 0) &&
           (q->h0 + q->h1 * low > 0 || q->h0 + q->h1 * high > 0);
  return search->upwards ? high >= search->T : low <= search->T;
}

// Whether a limit direction there may be better, from what is known before it
// is solved for.
static bool may_be_better(const search_t *search, bool attracts,
                          const limit_direction_t *best) {
  if (search->leaves) return attracts || !best->is_attractor;
  return search->upwards ? attracts & (best->exists == false) : attracts;
}

// Whether the angular rate surely has this sign where T has a value in a cell:
// for one T it is linear in x.
static bool has_sign_at(const quadrant_t *q, const cell_part_t *span,
                        tf_real_t T, bool positive) {
  return (angular_rate(q, direction_in(span->anchor, low_end(span->anchor),
                                       T)) > 0) == positive &&
         (angular_rate(q, direction_in(span->anchor, high_end(span->anchor),
                                       T)) > 0) == positive;
}

// Where in a cell T has a value: u - u0 is a form of a cell as well.
static tf_real_t x_at_T(const tf_tyre_t *tyre, const cell_part_t *span,
                        tf_real_t T) {
  const tf_real_t T_anchor = tyre->T_anchor[span->anchor];
  const cell_t has_u = {-(T - T_anchor) / (1 + T * T_anchor), 1, 0, 0};
  return zero_in(
             tyre, &has_u,
             (bracket_t){low_end(span->anchor), high_end(span->anchor), false})
      .x;
}

// T at the border below a cell, which is that above the last one.
static tf_real_t T_below(const tf_tyre_t *tyre, int anchor, tf_real_t u) {
  return anchor > 0 ? cot_psi_beyond(tyre->T_anchor[anchor - 1], u) : 0;
}

static cell_part_t cell_part(const tf_tyre_t *tyre, int anchor, tf_real_t u) {
  const bool last = anchor == TF_TYRE_ANCHORS - 1;
  return (cell_part_t){
      anchor, T_below(tyre, anchor, u),
      last ? tyre->T_anchor[anchor] : T_below(tyre, anchor + 1, u)};
}

// A cell begins with the angular rate with which the one below it ends.
static bool begins_positive(const quadrant_t *q, const cell_part_t *span) {
  const direction_t at =
      span->anchor > 0 ? direction_in(span->anchor - 1, border[0], span->T_low)
                       : (direction_t){1, 0, 0};
  return angular_rate(q, at) > 0;
}

// Searches a cell. A separator at which the rate has the sign of its lower
// neighbour separates nothing.
static void search_cell(const tf_tyre_t *tyre, const quadrant_t *q,
                        const separators_t *separators, const cell_part_t *span,
                        const search_t *search, limit_direction_t *best) {
  const int anchor = span->anchor;
  bool positive = begins_positive(q, span);
  tf_real_t begin = low_end(span->anchor);
  for (int n = 0; n <= SEPARATORS; n++) {
    const bool last = n == SEPARATORS;
    const tf_real_t T = last ? span->T_high : separators->T[n];
    if (!last && (!(T > span->T_low && T < span->T_high) ||
                  has_sign_at(q, span, T, positive)))
      continue;
    const tf_real_t end = last ? high_end(span->anchor) : x_at_T(tyre, span, T);
    const bracket_t part = {begin, end, positive};
    begin = end;
    positive = angular_rate(q, direction_in(anchor, end, T)) > 0;
    if (positive == part.falls || !may_be_better(search, part.falls, best))
      continue;
    const limit_direction_t next = limit_direction_in(tyre, q, anchor, part);
    if (is_better(search, &next, best)) *best = next;
  }
}

// Limit directions lie where the angular rate changes its sign between two
// neighbours of the borders of the cells and the separators. Of those from T on
// the first is found in the first cell that has any, upwards or downwards.
TF_API void tf_search_quadrant(const tf_tyre_t *tyre, const quadrant_t *q,
                               const search_t *search,
                               limit_direction_t *best) {
  const separators_t separators = find_separators(tyre, q);
  const tf_real_t u_border = cot_psi_near_zero(tyre, border[0]);
  const bool down = !search->leaves && !search->upwards;
  for (int i = 0; i < TF_TYRE_ANCHORS; i++) {
    const int anchor = down ? TF_TYRE_ANCHORS - 1 - i : i;
    const cell_part_t span = cell_part(tyre, anchor, u_border);
    if (may_be_in(search, q, &span))
      search_cell(tyre, q, &separators, &span, search, best);
    if (!search->leaves && best->exists) break;
  }
}
