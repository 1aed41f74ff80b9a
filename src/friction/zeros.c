// The common zeros of two forms: two conics meet in up to four points. A
// resultant would degenerate where the forms are almost linear, as those of a
// step are; Newton's method alone finds one zero, or none. So a box is halved
// until a part is proven to have no zero, or at most one, which Newton's method
// then finds. Almost linear forms are settled by the first box.
#include "inclusion.h"

// The first box has every law of rest within.
#define REACH TF_R(1.5)
// Boxes are halved as often as this.
#define LEVELS 60
// Next to a double zero, where curves touch, rounding hides that a form is not
// 0: within LEAST always, within DOUBLE_REACH where they touch closely.
#ifdef TF_REAL_FLOAT
#define LEAST TF_R(2e-5)
#define DOUBLE_REACH TF_R(0.02)
#else
#define LEAST TF_R(1e-9)
#define DOUBLE_REACH TF_R(5e-5)
#endif
// Almost linear forms take one box, others 60, touching curves some hundred.
#define MOST_BOXES 4000

// A box by its centre and half its sides, and both forms by the way from there:
// values, slopes, and more than their rounding in the box.
typedef struct {
  multipliers_t centre, half;
  tf_form_t h, g;
  tf_real_t h_rounding, g_rounding;
} box_t;

// The forms, in units in which their coefficients are of size 1, and the zeros.
// Two conics touch at most twice, in double zeros.
typedef struct {
  tf_form_t h, g;
  multipliers_t *at;
  bool is_double[TF_MOST_ZEROS];
  unsigned count, doubles;
  bool are_one_curve;
} zeros_t;

// a f + b g.
static tf_form_t sum_of_forms(tf_real_t a, const tf_form_t *f, tf_real_t b,
                              const tf_form_t *g) {
  return (tf_form_t){a * f->c0 + b * g->c0,   a * f->cx + b * g->cx,
                     a * f->cy + b * g->cy,   a * f->cxx + b * g->cxx,
                     a * f->cxy + b * g->cxy, a * f->cyy + b * g->cyy};
}

// The unit is a power of two: the size of the form, rounded to one bit.
static tf_form_t in_own_unit(const tf_form_t *f) {
  const tf_real_t size = form_size(f, 1, 1);
  const tf_real_t last_bit = (size + size * TF_REAL_EPSILON) - size;
  return sum_of_forms(TF_REAL_EPSILON * inverse_or_0(last_bit), f, 0, f);
}

static tf_real_t form_rounding(const tf_form_t *f, tf_real_t x, tf_real_t y) {
  return 16 * TF_REAL_EPSILON * form_size(f, x, y);
}

static box_t box_about(const zeros_t *of, multipliers_t centre,
                       multipliers_t half) {
  const tf_real_t X = magnitude(centre.x) + half.x;
  const tf_real_t Y = magnitude(centre.y) + half.y;
  return (box_t){centre,
                 half,
                 form_about(&of->h, centre),
                 form_about(&of->g, centre),
                 form_rounding(&of->h, X, Y),
                 form_rounding(&of->g, X, Y)};
}

// How far a combination of both forms comes from its value at the centre, by
// each of its terms.
typedef struct {
  tf_real_t value, by_slope, by_xx, by_xy, by_yy, rounding;
} form_range_t;

static form_range_t form_range(const box_t *in, tf_real_t a, tf_real_t b) {
  const tf_form_t f = sum_of_forms(a, &in->h, b, &in->g);
  const tf_real_t x = in->half.x, y = in->half.y;
  return (form_range_t){
      magnitude(f.c0),
      magnitude(f.cx) * x + magnitude(f.cy) * y,
      magnitude(f.cxx) * x * x,
      magnitude(f.cxy) * x * y,
      magnitude(f.cyy) * y * y,
      magnitude(a) * in->h_rounding + magnitude(b) * in->g_rounding};
}

static tf_real_t by_bend(form_range_t f) { return f.by_xx + f.by_xy + f.by_yy; }

static bool misses_0(form_range_t f) {
  return f.value > f.by_slope + by_bend(f) + f.rounding;
}

// Whether the slopes change by less than half. side: that of which the value
// depends at the centre.
static bool has_steady_slope(form_range_t f, tf_real_t side) {
  return 4 * by_bend(f) + side * f.rounding < f.by_slope;
}

typedef enum { NO_ZERO, ONE_AT_MOST, HALVE_X, HALVE_Y } verdict_t;

// By h, by g, and by both combined such that one depends on x alone at the
// centre, the other on y. Where these are steady, their slopes change by less
// than all in a box twice as large: there no two points have the same h and g,
// and Newton's method, from the centre to a zero in the box, squares its error
// in each step: a quarter of the box, 4 %, 0.2 %, 1e-6, 1e-12, 1e-24. Else the
// side is halved after which the slopes change by less.
static verdict_t verdict_on(const box_t *in) {
  const tf_form_t *h = &in->h, *g = &in->g;
  const form_range_t u = form_range(in, g->cy, -h->cy);
  const form_range_t v = form_range(in, -g->cx, h->cx);
  if (misses_0(form_range(in, 1, 0)) || misses_0(form_range(in, 0, 1)) ||
      misses_0(u) || misses_0(v))
    return NO_ZERO;
  const tf_real_t x = in->half.x, y = in->half.y;
  if (has_steady_slope(u, x) && has_steady_slope(v, y)) return ONE_AT_MOST;
  const tf_real_t gain = y * (2 * u.by_xx - 2 * u.by_xy - 7 * u.by_yy) +
                         x * (7 * v.by_xx + 2 * v.by_xy - 2 * v.by_yy);
  return gain > 0 || (gain == 0 && x >= y) ? HALVE_X : HALVE_Y;
}

static bool is_in_box(multipliers_t m, const box_t *in, tf_real_t halves) {
  return within(m.x - in->centre.x, halves * in->half.x) &&
         within(m.y - in->centre.y, halves * in->half.y);
}

static bool are_next(multipliers_t a, multipliers_t b, tf_real_t reach) {
  return within(a.x - b.x, reach) && within(a.y - b.y, reach);
}

// Whether rounding, of the form and of the point, hides that it is not 0 there.
static bool form_vanishes(const tf_form_t *f, multipliers_t m) {
  const tf_form_t at = form_about(f, m);
  return within(at.c0, 2 * (form_rounding(f, magnitude(m.x), magnitude(m.y)) +
                            16 * TF_REAL_EPSILON *
                                (magnitude(at.cx) + magnitude(at.cy))));
}

static bool is_zero_in(const box_t *in, multipliers_t m, const zeros_t *of) {
  return is_in_box(m, in, TF_R(1.0625)) && form_vanishes(&of->h, m) &&
         form_vanishes(&of->g, m);
}

static void add_zero(multipliers_t m, bool is_double, zeros_t *to) {
  to->is_double[to->count] = is_double;
  to->at[to->count++] = m;
  to->doubles += is_double;
}

// A zero that is within twice the box is the same, of another box.
static void add_simple(const box_t *in, zeros_t *to) {
  for (unsigned i = 0; i < to->count; i++)
    if (is_in_box(to->at[i], in, 2)) return;
  multipliers_t m = in->centre;
  for (int i = 0; i < 3; i++)
    m = tf_multipliers_to(&to->h, &to->g, (tf_slip_t){0, 0}, m);
  if (is_zero_in(in, m, to)) add_zero(m, false, to);
}

// Newton's method for both has no slope at a double zero: the point of a curve
// that is next to the centre, if the other form is 0 there as well and the
// smallest box about it is undecided. Where that is so at a third place, the
// forms vanish along one curve, and the search is over.
static void add_double(const box_t *in, zeros_t *to) {
  const tf_form_t *h = &in->h, *g = &in->g;
  const bool by_h =
      h->cx * h->cx + h->cy * h->cy > g->cx * g->cx + g->cy * g->cy;
  multipliers_t m = in->centre;
  for (int i = 0; i < 4; i++) {
    const tf_form_t f = form_about(by_h ? &to->h : &to->g, m);
    const tf_real_t way = f.c0 / (f.cx * f.cx + f.cy * f.cy);
    m = (multipliers_t){m.x - way * f.cx, m.y - way * f.cy};
  }
  if (!is_zero_in(in, m, to)) return;
  const box_t last = box_about(to, m, (multipliers_t){LEAST, LEAST});
  if (verdict_on(&last) <= ONE_AT_MOST) return;
  bool is_elsewhere = true;
  for (unsigned i = 0; i < to->count; i++) {
    is_elsewhere = is_elsewhere && !are_next(to->at[i], m, TF_R(0.1));
    if (!are_next(to->at[i], m, to->is_double[i] ? 0 : DOUBLE_REACH)) continue;
    to->doubles += !to->is_double[i];
    to->is_double[i] = true;
    return;
  }
  if (to->doubles < 2)
    add_zero(m, true, to);
  else if (is_elsewhere)
    to->are_one_curve = true;
}

static bool is_at_double(const box_t *in, const zeros_t *zeros) {
  const tf_real_t half = in->half.x > in->half.y ? in->half.x : in->half.y;
  for (unsigned i = 0; i < zeros->count; i++)
    if (zeros->is_double[i] &&
        are_next(in->centre, zeros->at[i], DOUBLE_REACH - half))
      return true;
  return false;
}

// Adds what a box holds. Returns how to halve it where it may hold more.
static verdict_t search_box(const box_t *in, zeros_t *zeros) {
  const verdict_t verdict = verdict_on(in);
  if (verdict == NO_ZERO || is_at_double(in, zeros)) return NO_ZERO;
  if (verdict == ONE_AT_MOST)
    add_simple(in, zeros);
  else
    add_double(in, zeros);
  return verdict;
}

// Boxes one after another, each before its halves. By level, from the last bit
// on: whether y was halved, and whether this is the second half.
TF_API unsigned tf_common_zeros(const tf_form_t *h, const tf_form_t *g,
                                multipliers_t at[TF_MOST_ZEROS]) {
  zeros_t zeros = {.h = in_own_unit(h), .g = in_own_unit(g), .at = at};
  tf_real_t centre[2] = {0, 0}, half[2] = {REACH, REACH};
  uint64_t of_y = 0, second = 0;
  unsigned level = 0;
  for (int n = 0;
       n < MOST_BOXES && zeros.count < TF_MOST_ZEROS && !zeros.are_one_curve;
       n++) {
    const box_t in = box_about(&zeros, (multipliers_t){centre[0], centre[1]},
                               (multipliers_t){half[0], half[1]});
    const verdict_t verdict = search_box(&in, &zeros);
    if (verdict > ONE_AT_MOST && level < LEVELS) {
      const unsigned side = verdict == HALVE_Y;
      half[side] /= 2;
      centre[side] -= half[side];
      of_y = of_y << 1 | side;
      second <<= 1;
      level++;
      continue;
    }
    for (; level > 0 && second & 1; level--) {
      centre[of_y & 1] -= half[of_y & 1];
      half[of_y & 1] *= 2;
      of_y >>= 1;
      second >>= 1;
    }
    if (level == 0) break;
    centre[of_y & 1] += 2 * half[of_y & 1];
    second |= 1;
  }
  return zeros.count;
}
