// Joint modes of several contacts: for each set of modes all zeros of its
// equations in a box. A contact has two: x held at +-1 in slip, h = 0 else; y
// held at +-1 or g = 0 in slip, y = +-x in stick, g = 0 where it is pinned. The
// forms are affine but for small products: one step of Newton's method from the
// middle of a box, with a bound of what the products add, leaves at most one
// zero in it, or the box is halved.
#include "joint.h"

#include "rest_law.h"

#define MOST_PARTS 512u       // for one set of modes and shares
#define MOST_HALVES 32u       // of the stack of boxes
#define MOST_NEWTON_STEPS 32u // of Newton's method
#define JOINT_ROUNDING (16 * TF_REAL_EPSILON)

// Share of its slopes that is added to the own one of an equation, so that
// those of redundant contacts have an inverse. Newton's method then ends next
// to the solution of the least sum of squares.
#define SOFTNESS (TF_R(0x1p10) * TF_REAL_EPSILON)

// The equation for a multiplier: its form (h for x, g for y) is 0, or it is
// held, or y = +-x.
typedef enum { FORM, HELD, RAY_PLUS, RAY_MINUS } equation_t;

// The sign that a form ends with.
typedef enum { ABOVE, BELOW, ANY } sought_t;

// The sign of g that the moment of a slip stands for. OPEN: any.
typedef enum { SHARE_PLUS, SHARE_MINUS, SHARE_ZERO, SHARES, OPEN } share_t;

typedef struct {
  tf_real_t middle[MULTIPLIERS], half[MULTIPLIERS];
} joint_box_t;

typedef struct {
  equation_t equation[MULTIPLIERS];
  sought_t sought[MULTIPLIERS];
  joint_box_t box;
} problem_t;

// Forms and equations about the middle of a box: values and their rounding,
// slopes by the multipliers, what products and the softness of an equation add
// in the box, and the inverse of the slopes.
typedef struct {
  tf_real_t value[MULTIPLIERS], missed[MULTIPLIERS], rounding[MULTIPLIERS],
      slope[MULTIPLIERS][MULTIPLIERS];
  tf_real_t bend[MULTIPLIERS], softness[MULTIPLIERS],
      inverse[MULTIPLIERS][MULTIPLIERS];
} outlook_t;

static void pose_one(problem_t *p, unsigned a, equation_t equation,
                     sought_t sought, tf_real_t middle, tf_real_t half) {
  p->equation[a] = equation;
  p->sought[a] = sought;
  p->box.middle[a] = middle;
  p->box.half[a] = half;
}

// The equations of a contact in a mode.
static void pose(const mechanism_t *k, unsigned i, unsigned mode, share_t share,
                 problem_t *p) {
  const unsigned x = 2 * i, y = 2 * i + 1;
  const sign_t s = sign_in(mode);
  const sought_t side = s == PLUS ? ABOVE : BELOW;
  const bool moment = has_moment(k, i);
  pose_one(p, y, HELD, ANY, 0, 0);
  if (slips_by_law(k, i)) {
    pose_one(p, x, HELD, ANY, k->law[i].x, 0);
    pose_one(p, y, HELD, ANY, k->law[i].y, 0);
  } else if (mode == TF_PINNED) {
    pose_one(p, x, FORM, ANY, 0, rest_bounds(k->contacts[i].rest).x0);
    pose_one(p, y, FORM, ANY, 0, 1);
  } else if (is_stick(mode)) {
    pose_one(p, x, FORM, ANY, 0, 1);
    if (moment) pose_one(p, y, s == PLUS ? RAY_PLUS : RAY_MINUS, side, 0, 1);
  } else {
    pose_one(p, x, HELD, side, unit(s), 0);
    if (moment && share >= SHARE_ZERO)
      pose_one(p, y, share == OPEN ? HELD : FORM, ANY, 0, 1);
    else if (moment)
      pose_one(p, y, HELD, share == SHARE_PLUS ? ABOVE : BELOW,
               share == SHARE_PLUS ? unit(s) : -unit(s), 0);
  }
}

// A form about the middle of a box, in the order of form_value: value and
// slopes. Returns what its products add in the box.
static tf_real_t form_at(const tf_real_t form[], unsigned count,
                         const joint_box_t *box, tf_real_t *value,
                         tf_real_t slope[]) {
  const tf_real_t *m = box->middle, *product = form + 1 + count;
  tf_real_t bend = 0;
  *value = form[0];
  for (unsigned j = 0; j < count; j++) {
    tf_real_t column = form[1 + j];
    slope[j] = column;
    for (unsigned i = 0; i <= j; i++, product++) {
      column += m[i] * *product;
      slope[i] += *product * m[j];
      slope[j] += *product * m[i];
      bend += magnitude(*product) * box->half[i] * box->half[j];
    }
    *value += m[j] * column;
  }
  return bend;
}

static bool may_end(sought_t sought, tf_real_t value, tf_real_t reach) {
  return sought == ANY ||
         (sought == ABOVE ? value + reach > 0 : value - reach < 0);
}

// Looks at forms and equations about the middle of a box. Returns whether each
// may hold in it.
static bool look(const mechanism_t *k, const problem_t *p,
                 const joint_box_t *box, outlook_t *out) {
  bool may = true;
  for (unsigned f = 0; f < k->count; f++) {
    const tf_real_t *form = k->forms + f * k->terms;
    const tf_real_t ray = p->equation[f] == RAY_PLUS ? -1 : 1;
    tf_real_t *slope = out->slope[f], reach = 0, size = 0, sum = 0;
    out->bend[f] = form_at(form, k->count, box, &out->value[f], slope);
    for (unsigned a = 0; a < k->count; a++) {
      const tf_real_t by = magnitude(slope[a]);
      reach += by * box->half[a];
      sum += by;
      if (by > size) size = by;
    }
    out->rounding[f] = JOINT_ROUNDING * (magnitude(form[0]) + sum);
    reach += out->bend[f] + out->rounding[f];
    may = may && may_end(p->sought[f], out->value[f], reach) &&
          (p->equation[f] != FORM || within(out->value[f], reach));
    out->missed[f] = out->value[f];
    out->softness[f] = SOFTNESS * size;
    if (p->equation[f] == FORM) continue;
    for (unsigned a = 0; a < k->count; a++) slope[a] = a == f ? 1 : 0;
    out->missed[f] = out->bend[f] = out->softness[f] = out->rounding[f] = 0;
    if (p->equation[f] == HELD) continue;
    out->rounding[f] = JOINT_ROUNDING;
    slope[f - 1] = ray;
    out->missed[f] = box->middle[f] + ray * box->middle[f - 1];
  }
  return may;
}

// The inverse of the slopes, by Gauss and Jordan with partial pivoting.
static void invert_slopes(unsigned count, outlook_t *at) {
  tf_real_t left[MULTIPLIERS][MULTIPLIERS];
  for (unsigned e = 0; e < count; e++)
    for (unsigned a = 0; a < count; a++) {
      left[e][a] = at->slope[e][a] - (e == a ? at->softness[e] : 0);
      at->inverse[e][a] = e == a ? 1 : 0;
    }
  for (unsigned c = 0; c < count; c++) {
    unsigned best = c;
    for (unsigned e = c + 1; e < count; e++)
      if (magnitude(left[e][c]) > magnitude(left[best][c])) best = e;
    const tf_real_t pivot = left[best][c];
    for (unsigned a = 0; a < count; a++) {
      const tf_real_t l = left[best][a], i = at->inverse[best][a];
      left[best][a] = left[c][a];
      at->inverse[best][a] = at->inverse[c][a];
      left[c][a] = l / pivot;
      at->inverse[c][a] = i / pivot;
    }
    for (unsigned e = 0; e < count; e++) {
      const tf_real_t by = left[e][c];
      for (unsigned a = 0; a < count && e != c && by != 0; a++) {
        left[e][a] -= by * left[c][a];
        at->inverse[e][a] -= by * at->inverse[c][a];
      }
    }
  }
}

static tf_real_t newton_step(const outlook_t *at, unsigned count, unsigned a) {
  tf_real_t sum = 0;
  for (unsigned e = 0; e < count; e++) sum -= at->inverse[a][e] * at->missed[e];
  return sum;
}

// Newton's method from a point on, within the law. Returns whether it comes to
// a zero that holds.
static bool comes_to_zero(const mechanism_t *k, const problem_t *p,
                          const unsigned mode[], joint_box_t *point,
                          outlook_t *at) {
  bool is_zero = false;
  for (unsigned a = 0; a < k->count; a++) point->half[a] = 0;
  for (unsigned n = 0; n < MOST_NEWTON_STEPS && !is_zero; n++) {
    for (unsigned a = 0; a < k->count; a++)
      point->middle[a] = clip(point->middle[a] + newton_step(at, k->count, a),
                              p->box.middle[a] - p->box.half[a],
                              p->box.middle[a] + p->box.half[a]);
    look(k, p, point, at);
    invert_slopes(k->count, at);
    is_zero = n > 0;
    for (unsigned f = 0; f < k->count; f++)
      is_zero = is_zero && within(at->missed[f], at->rounding[f]);
  }
  for (unsigned f = 0; f < k->count; f++)
    is_zero = is_zero && may_end(p->sought[f], at->value[f], 0);
  for (unsigned i = 0; i < k->count / 2; i++)
    is_zero = is_zero && (mode[i] != TF_PINNED ||
                          rests_under(k->contacts[i].rest, point->middle[2 * i],
                                      point->middle[2 * i + 1]));
  return is_zero;
}

// Writes a zero into the joint mode unless that has one that is smaller.
static void take_zero(const mechanism_t *k, const unsigned mode[],
                      const problem_t *p, const tf_real_t m[],
                      const outlook_t *at, tf_real_t *least,
                      tf_joint_mode_t *joint) {
  tf_real_t size = 0;
  for (unsigned a = 0; a < k->count; a++) size += magnitude(m[a]);
  if (!(size < *least)) return;
  *least = size;
  joint->attracting = 0;
  joint->near_plus = (uint8_t)k->near_plus;
  for (unsigned i = 0; i < k->count / 2; i++) {
    const unsigned x = 2 * i, y = 2 * i + 1;
    joint->mode[i] = (uint8_t)mode[i];
    joint->x[i] = m[x];
    joint->y[i] = m[y];
    joint->h[i] = p->equation[x] == FORM ? 0 : at->value[x];
    joint->g[i] = p->equation[y] == FORM ? 0 : at->value[y];
    if (mode[i] == TF_STICK_PLUS && !has_moment(k, i) &&
        !has_sign_of_g(joint->g[i], PLUS, (k->near_plus >> i) & 1u))
      joint->mode[i] = TF_STICK_MINUS;
    if (is_stick(mode[i]) && at->inverse[x][x] < 0)
      joint->attracting |= (uint8_t)(1u << i);
  }
}

// All zeros of a problem, each once. Returns false where it ran out of boxes.
static bool add_zeros(const mechanism_t *k, const unsigned mode[],
                      const problem_t *p, tf_joint_mode_t *joint) {
  tf_real_t least = joint->points > 0 ? 0 : TF_REAL_MAX;
  joint_box_t stack[MOST_HALVES];
  unsigned depth = 1, looked = 0;
  stack[0] = p->box;
  for (; depth > 0 && looked < MOST_PARTS && depth + 2 <= MOST_HALVES;
       looked++) {
    const joint_box_t box = stack[--depth];
    joint_box_t point = box;
    outlook_t at;
    if (!look(k, p, &box, &at)) continue;
    invert_slopes(k->count, &at);
    bool misses = false, alone = true, soft = false, inside = true;
    unsigned widest = 0;
    for (unsigned a = 0; a < k->count; a++) {
      tf_real_t bent = 0, softened = 0, rounded = JOINT_ROUNDING;
      for (unsigned f = 0; f < k->count; f++) {
        const tf_real_t by = magnitude(at.inverse[a][f]);
        bent += by * at.bend[f];
        softened += by * at.softness[f] * box.half[f];
        rounded += by * at.rounding[f];
      }
      misses = misses || magnitude(newton_step(&at, k->count, a)) >
                             box.half[a] + bent + softened + rounded;
      alone = alone && 4 * bent <= box.half[a] + JOINT_ROUNDING;
      soft = soft || !(4 * softened <= box.half[a] + JOINT_ROUNDING);
      if (box.half[a] > box.half[widest]) widest = a;
    }
    if (misses) continue;
    const bool holds = comes_to_zero(k, p, mode, &point, &at);
    for (unsigned a = 0; a < k->count; a++)
      inside = inside && within(point.middle[a] - box.middle[a],
                                box.half[a] + JOINT_ROUNDING);
    if (holds && inside) {
      take_zero(k, mode, p, point.middle, &at, &least, joint);
      if (joint->points < UINT8_MAX) joint->points++;
    }
    if ((alone && !soft) || (soft && holds)) continue;
    for (unsigned n = 0; n < 2; n++, depth++) {
      stack[depth] = box;
      stack[depth].half[widest] /= 2;
      stack[depth].middle[widest] +=
          n == 0 ? stack[depth].half[widest] : -stack[depth].half[widest];
    }
  }
  return depth == 0;
}

// Whether a contact that slips may do so with g of either sign.
static bool has_shares(const mechanism_t *k, const unsigned mode[],
                       unsigned i) {
  return is_slip(mode[i]) && has_moment(k, i) && !slips_by_law(k, i);
}

TF_API bool tf_solve_modes(const mechanism_t *k, const unsigned mode[],
                           tf_joint_mode_t *joint) {
  problem_t p;
  outlook_t at;
  unsigned shares = 1;
  bool all = true;
  for (unsigned i = 0; i < k->count / 2; i++) {
    const bool by_law = slips_by_law(k, i);
    if (by_law ? mode[i] != (k->law[i].x > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS)
               : !has_moment(k, i) && mode[i] > TF_STICK_PLUS)
      return true;
    pose(k, i, mode[i], OPEN, &p);
    if (has_shares(k, mode, i)) shares *= SHARES;
  }
  if (!look(k, &p, &p.box, &at)) return true;
  for (unsigned n = 0; n < shares; n++) {
    for (unsigned i = 0, rest = n; i < k->count / 2; i++) {
      unsigned share = SHARE_PLUS;
      if (has_shares(k, mode, i)) {
        share = rest % SHARES;
        rest /= SHARES;
        if (share != SHARE_ZERO && !((k->near_plus >> i) & 1u))
          share = share == SHARE_PLUS ? SHARE_MINUS : SHARE_PLUS;
      }
      pose(k, i, mode[i], (share_t)share, &p);
    }
    all = add_zeros(k, mode, &p, joint) && all;
  }
  return all;
}

TF_API bool tf_comes_to_h_0(const mechanism_t *k, unsigned i, tf_real_t now) {
  joint_box_t most = {{0}, {0}};
  tf_real_t value, slope[MULTIPLIERS];
  for (unsigned a = 0; a < k->count; a++)
    most.half[a] = a % 2 == 0 ? MAX_SLIP_FORCE(TF_R(1.0)) : 1;
  tf_real_t reach =
      form_at(k->forms + 2 * i * k->terms, k->count, &most, &value, slope);
  for (unsigned a = 0; a < k->count; a++)
    reach += magnitude(slope[a]) * most.half[a];
  return within(now, magnitude(value - now) + reach);
}

TF_API bool tf_balance_contacts(const mechanism_t *k, const unsigned mode[],
                                tf_real_t m[MULTIPLIERS],
                                tf_real_t h[TF_CONTACTS]) {
  problem_t p = {.box = {{0}, {0}}};
  joint_box_t point = {{0}, {0}};
  outlook_t at;
  for (unsigned i = 0; i < k->count / 2; i++) {
    pose(k, i, mode[i], OPEN, &p);
    for (unsigned a = 2 * i; a < 2 * i + 2; a++)
      point.middle[a] = slips_by_law(k, i) ? p.box.middle[a] : m[a];
  }
  (void)look(k, &p, &point, &at);
  invert_slopes(k->count, &at);
  if (!comes_to_zero(k, &p, mode, &point, &at)) return false;
  for (unsigned a = 0; a < k->count; a++) m[a] = point.middle[a];
  for (unsigned i = 0; i < k->count / 2; i++) h[i] = at.value[2 * i];
  return true;
}
