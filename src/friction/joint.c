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
#define MOST_SOFT 4u          // boxes of redundant contacts in which none holds
#define MOST_NEWTON_STEPS 32u // of Newton's method
#define SMALL_STEP TF_R(0x1p-6) // leaves the inverse of the slopes as it is

// The sign of g that the moment of a slip stands for: the present one, the
// other, 0. OPEN: any.
typedef enum { SAME_SIGN, OTHER_SIGN, ZERO, SHARES, OPEN } share_t;

static void pose_one(problem_t *p, unsigned a, equation_t equation,
                     sought_t sought, tf_real_t middle, tf_real_t half) {
  p->equation[a] = equation;
  p->sought[a] = sought;
  p->box.middle[a] = middle;
  p->box.half[a] = half;
}

// The equations of a contact in a mode. TF_NO_MODE: in any.
static void pose(const mechanism_t *k, unsigned i, unsigned mode, share_t share,
                 problem_t *p) {
  const unsigned x = 2 * i, y = 2 * i + 1;
  const sign_t s = sign_in(mode), now = (k->near_plus >> i) & 1u ? PLUS : MINUS;
  const sought_t side = s == PLUS ? ABOVE : BELOW;
  const bool moment = has_moment(k, i);
  pose_one(p, y, HELD, ANY, 0, 0);
  if (mode == TF_NO_MODE) {
    pose_one(p, x, HELD, ANY, 0, most_of(x));
    pose_one(p, y, HELD, ANY, 0, most_of(y));
  } else if (slips_by_law(k, i)) {
    pose_one(p, x, HELD, ANY, k->law[i].x, 0);
    pose_one(p, y, HELD, ANY, k->law[i].y, 0);
  } else if (mode == TF_PINNED) {
    pose_one(p, x, FORM, ANY, 0, rest_bounds(k->contacts[i].rest).x0);
    pose_one(p, y, FORM, ANY, 0, 1);
  } else if (is_stick(mode)) {
    pose_one(p, x, FORM, ANY, 0, 1);
    if (moment)
      pose_one(p, y, s == PLUS ? RAY_PLUS : RAY_MINUS, side, 0, 1);
    else // g = 0 counts as the present side
      p->sought[y] = s != now ? side : s == PLUS ? FROM_0 : TO_0;
  } else {
    const sign_t of_g = share == SAME_SIGN ? now : opposite(now);
    pose_one(p, x, HELD, side, unit(s), 0);
    if (moment && share >= ZERO)
      pose_one(p, y, share == OPEN ? HELD : FORM, ANY, 0, 1);
    else if (moment)
      pose_one(p, y, HELD, of_g == PLUS ? ABOVE : BELOW,
               with_sign(of_g, unit(s)), 0);
  }
}

// The inverse of the slopes by the equations that are forms; the others give
// their multiplier at once. Out of line: its room is free again behind it.
TF_RARE void invert_slopes(const mechanism_t *k, const problem_t *p,
                           outlook_t *at) {
  tf_real_t w[ROWS][ROWS + 1];
  unsigned row[MULTIPLIERS], rows = 0;
  for (unsigned e = 0; e < k->count; e++)
    if (p->equation[e] == FORM) row[rows++] = e;
  for (unsigned r = 0; r < rows; r++) {
    const unsigned e = row[r];
    for (unsigned a = 0, c = 0; a < k->count; a++) {
      const tf_real_t by = at->slope[e][a] - (e == a ? at->softness[e] : 0);
      w[r][rows + a] = p->equation[a] != FORM ? -by : e == a ? 1 : 0;
      if (p->equation[a] == FORM) w[r][c++] = by;
      if (p->equation[a] >= RAY_PLUS) w[r][c - 1] -= at->slope[a][a - 1] * by;
    }
  }
  eliminate(rows, rows + k->count, w);
  for (unsigned a = 0; a < k->count; a++)
    for (unsigned e = 0; e < k->count; e++)
      at->inverse[a][e] = (a == e ? TF_R(1.0) : TF_R(0.0));
  for (unsigned r = 0; r < rows; r++)
    for (unsigned e = 0; e < k->count; e++)
      at->inverse[row[r]][e] = w[r][rows + e];
  for (unsigned a = 0; a < k->count; a++)
    for (unsigned e = 0; e < k->count && p->equation[a] >= RAY_PLUS; e++)
      at->inverse[a][e] -= at->slope[a][a - 1] * at->inverse[a - 1][e];
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
    tf_real_t most = 0;
    for (unsigned a = 0; a < k->count; a++) {
      const tf_real_t step = newton_step(at, k->count, a);
      if (magnitude(step) > most) most = magnitude(step);
      point->middle[a] =
          clip(point->middle[a] + step, p->box.middle[a] - p->box.half[a],
               p->box.middle[a] + p->box.half[a]);
    }
    look(k, p, point, at);
    if (!k->is_affine && most > SMALL_STEP) invert_slopes(k, p, at);
    is_zero = k->is_affine || n > 0;
    for (unsigned f = 0; f < k->count; f++)
      is_zero = is_zero && within(at->missed[f], at->rounding[f]);
  }
  for (unsigned f = 0; f < k->count; f++)
    is_zero = is_zero && may_end(p->sought[f], at->value[f], 0);
  for (unsigned i = 0; i < k->count / 2; i++)
    is_zero =
        is_zero && (mode[i] != TF_PINNED ||
                    rests_under(k->contacts[i].rest, point->middle[X_OF(i)],
                                point->middle[Y_OF(i)]));
  if (is_zero && !k->is_affine) invert_slopes(k, p, at);
  return is_zero;
}

// Redundant contacts leave forces free. Of those that hold, one is sought that
// is far from every border: the largest distance t, by a barrier of all sides
//   side(m) >= t,  weight t + sum of log(side(m) - t) -> max,  equations = 0
// with Newton's method from anywhere, for a weight that grows.
#define MOST_SIDES (8 * TF_CONTACTS)
#define MOST_BARRIER_STEPS 64u

typedef struct {
  tf_real_t value, slope[MULTIPLIERS];
} side_t;

// constant + by_x x + by_y y of contact i.
static void add_side(side_t sides[], unsigned *count, unsigned i,
                     const tf_real_t m[], tf_real_t constant, tf_real_t by_x,
                     tf_real_t by_y) {
  side_t *side = &sides[(*count)++];
  *side = (side_t){.value = constant + by_x * m[X_OF(i)] + by_y * m[Y_OF(i)]};
  side->slope[X_OF(i)] = by_x;
  side->slope[Y_OF(i)] = by_y;
}

// All sides of the laws, and the forms that end with a sign, in units of their
// slopes. halves: the contacts that rest under x < 0 of a law that is not
// convex. Returns how many.
static unsigned sides_at(const mechanism_t *k, const problem_t *p,
                         const unsigned mode[], unsigned halves,
                         const joint_box_t *point, side_t sides[]) {
  const tf_real_t *m = point->middle;
  unsigned count = 0;
  for (unsigned a = 0; a < k->count; a++) {
    const rest_bounds_t of = rest_bounds(k->contacts[a / 2].rest);
    const bool is_y = a % 2 != 0, is_pinned = mode[a / 2] == TF_PINNED;
    const tf_real_t by_x = (halves >> (a / 2)) & 1u ? -of.y1 : of.y1;
    for (int s = -1; s <= 1; s += 2) {
      const tf_real_t sign = (tf_real_t)s;
      if (is_pinned && is_y) {
        add_side(sides, &count, a / 2, m, of.y0, by_x, sign);
      } else if (is_pinned) {
        add_side(sides, &count, a / 2, m, of.x0, sign, of.x1);
        add_side(sides, &count, a / 2, m, of.x0, sign, -of.x1);
      } else if (p->box.half[a] > 0) {
        add_side(sides, &count, a / 2, m, 1, is_y ? 0 : sign, is_y ? sign : 0);
      }
    }
    if (p->sought[a] == ANY) continue;
    side_t *side = &sides[count++];
    tf_real_t size = 0;
    (void)form_at(k, a, point, &side->value, side->slope);
    for (unsigned b = 0; b < k->count; b++) size += magnitude(side->slope[b]);
    size = (p->sought[a] == ABOVE || p->sought[a] == FROM_0 ? TF_R(1.0)
                                                            : TF_R(-1.0)) *
           (size > 0 ? 1 / size : 1);
    side->value *= size;
    for (unsigned b = 0; b < k->count; b++) side->slope[b] *= size;
  }
  return count;
}

// Newton's equations of the barrier for (m, t), and the multipliers of the
// equations behind them.
static void pose_middle(unsigned n, const outlook_t *at, const side_t sides[],
                        unsigned count, tf_real_t t, tf_real_t weight,
                        tf_real_t w[ROWS][ROWS + 1]) {
  const unsigned rows = 2 * n + 1;
  for (unsigned i = 0; i < rows; i++)
    for (unsigned j = 0; j <= rows; j++) w[i][j] = 0;
  w[n][rows] = weight;
  for (unsigned s = 0; s < count; s++) {
    const tf_real_t inverse = 1 / (sides[s].value - t);
    for (unsigned i = 0; i <= n; i++) {
      const tf_real_t by = inverse * (i < n ? sides[s].slope[i] : -1);
      for (unsigned j = 0; j <= n; j++)
        w[i][j] += by * inverse * (j < n ? sides[s].slope[j] : -1);
      w[i][rows] += by;
    }
  }
  for (unsigned e = 0; e < n; e++) {
    tf_real_t size = 0;
    for (unsigned a = 0; a < n; a++) size += magnitude(at->slope[e][a]);
    size = inverse_or_0(size);
    for (unsigned a = 0; a < n; a++)
      w[a][n + 1 + e] = w[n + 1 + e][a] = size * at->slope[e][a];
    w[n + 1 + e][n + 1 + e] = -TF_REAL_EPSILON;
    w[n + 1 + e][rows] = -size * at->missed[e];
  }
}

TF_RARE bool comes_to_middle(const mechanism_t *k, const problem_t *p,
                             const unsigned mode[], unsigned halves,
                             joint_box_t *point, outlook_t *at) {
  const unsigned n = k->count, last = 2 * n + 1;
  tf_real_t t = 0, weight = 1, gap = TF_REAL_MAX, share = 0, before = 0,
            first = 0;
  *point = (joint_box_t){{0}, {0}};
  for (unsigned a = 0; a < n; a++) point->middle[a] = p->box.middle[a];
  for (unsigned turn = 0; turn < MOST_BARRIER_STEPS; turn++) {
    side_t sides[MOST_SIDES];
    tf_real_t w[ROWS][ROWS + 1], least = TF_REAL_MAX, missed = 0, most = 0;
    tf_real_t rounding = 0;
    bool is_zero = true;
    look(k, p, point, at);
    const unsigned count = sides_at(k, p, mode, halves, point, sides);
    for (unsigned s = 0; s < count; s++)
      if (sides[s].value < least) least = sides[s].value;
    for (unsigned e = 0; e < n; e++) {
      missed += magnitude(at->missed[e]);
      rounding += at->rounding[e];
      is_zero = is_zero && within(at->missed[e], at->rounding[e]);
    }
    if (is_zero && least > 0) {
      invert_slopes(k, p, at);
      return true;
    }
    if (turn == 0) {
      first = missed + TF_R(0x1p14) * rounding; // may begin at 0
      t = least - 1;
    }
    const bool is_close = missed <= TF_R(0x1p-10) * first;
    const bool ends = is_close && least > 0;
    if (share == 1 && (t + gap < 0 || !(is_close || missed < before / 2)))
      return false;
    pose_middle(n, at, sides, ends ? 0 : count, t, weight, w);
    for (unsigned i = 0; i <= n && ends; i++) w[i][i] = 1;
    eliminate(last, last + 1, w);
    for (unsigned s = 0; s < count && !ends; s++) {
      tf_real_t by = -w[n][last];
      for (unsigned a = 0; a < n; a++) by += sides[s].slope[a] * w[a][last];
      by = magnitude(by) / (sides[s].value - t);
      if (by > most) most = by;
    }
    share = most > 1 ? TF_R(0.9) / most : 1;
    for (unsigned a = 0; a < n; a++)
      if (p->box.half[a] > 0) point->middle[a] += share * w[a][last];
    if (!ends) t += share * w[n][last];
    before = missed;
    gap = (tf_real_t)(2 * count) / weight;
    if (share == 1) weight *= 8;
  }
  return false;
}

// The same for each half of the laws that are not convex.
static bool comes_to_a_middle(const mechanism_t *k, const problem_t *p,
                              const unsigned mode[], joint_box_t *point,
                              outlook_t *at) {
  unsigned may = 0;
  bool holds = false;
  for (unsigned i = 0; i < k->count / 2; i++)
    if (mode[i] == TF_PINNED && rest_bounds(k->contacts[i].rest).y1 > 0)
      may |= 1u << i;
  for (unsigned halves = 0; halves <= may && !holds; halves++)
    holds =
        (halves & ~may) == 0 && comes_to_middle(k, p, mode, halves, point, at);
  return holds;
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
    if (is_stick(mode[i]) && at->inverse[x][x] < 0)
      joint->attracting |= (uint8_t)(1u << i);
  }
}

// All zeros of a problem, each once. Returns false where it ran out of boxes.
static bool add_zeros(const mechanism_t *k, const unsigned mode[],
                      const problem_t *p, tf_joint_mode_t *joint) {
  tf_real_t least = TF_REAL_MAX;
  joint_box_t stack[MOST_HALVES];
  unsigned depth = 1, looked = 0, softs = 0;
  stack[0] = p->box;
  for (; depth > 0 && looked < MOST_PARTS && depth + 2 <= MOST_HALVES;
       looked++) {
    const joint_box_t box = stack[--depth];
    joint_box_t point = box;
    outlook_t at;
    look(k, p, &box, &at);
    invert_slopes(k, p, &at);
    problem_t rest_of_box = *p; // what Newton's step leaves of the box
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
      const tf_real_t step = newton_step(&at, k->count, a);
      const tf_real_t off = bent + softened + 2 * rounded;
      const tf_real_t low = clip(step - off, -box.half[a], box.half[a]);
      const tf_real_t high = -clip(-step - off, -box.half[a], box.half[a]);
      misses = misses || magnitude(step) > box.half[a] + off;
      rest_of_box.box.middle[a] = box.middle[a] + (low + high) / 2;
      rest_of_box.box.half[a] = (high - low) / 2;
      alone = alone && 4 * bent <= box.half[a] + JOINT_ROUNDING;
      soft = soft || !(4 * softened <= box.half[a] + JOINT_ROUNDING);
      if (rest_of_box.box.half[a] > rest_of_box.box.half[widest]) widest = a;
    }
    if (misses || !may_hold(k, &rest_of_box)) continue;
    bool holds = comes_to_zero(k, p, mode, &point, &at);
    if (soft && !holds) holds = comes_to_a_middle(k, p, mode, &point, &at);
    for (unsigned a = 0; a < k->count; a++)
      inside = inside && within(point.middle[a] - box.middle[a],
                                box.half[a] + JOINT_ROUNDING);
    const bool is_last = soft ? k->is_affine : alone;
    if (holds && inside) {
      take_zero(k, mode, p, point.middle, &at, &least, joint);
      if (is_last) joint->points++;
    }
    if (is_last) continue;
    if (soft && ++softs == MOST_SOFT) return false;
    for (unsigned n = 0; n < 2; n++, depth++) {
      stack[depth] = rest_of_box.box;
      stack[depth].half[widest] /= 2;
      stack[depth].middle[widest] +=
          n == 0 ? stack[depth].half[widest] : -stack[depth].half[widest];
    }
  }
  if (joint->points == 0 && least < TF_REAL_MAX) joint->points = 1;
  return depth == 0;
}

static bool is_0(const mechanism_t *k, size_t f, tf_real_t value) {
  return within(value, 16 * k->bend[f]);
}

// Whether a motion without products rests but for rounding: h = g = 0, or h = 0
// and a stick attracts, else a slip is another future. p: in, of the motion.
static bool rests_too(const mechanism_t *k, const tf_joint_mode_t *motion,
                      problem_t p) {
  unsigned mode[TF_CONTACTS] = {0};
  tf_joint_mode_t rest = {.points = 0};
  bool same = false;
  for (unsigned i = 0; i < k->count / 2; i++) {
    mode[i] = motion->mode[i];
    if (slips_by_law(k, i) || !is_0(k, X_OF(i), motion->h[i])) continue;
    mode[i] = stick_with(sign_of(motion->g[i]));
    if (has_moment(k, i) && is_0(k, Y_OF(i), motion->g[i])) mode[i] = TF_PINNED;
    if (mode[i] == motion->mode[i]) continue;
    pose(k, i, mode[i], OPEN, &p);
    same = k->is_affine;
  }
  if (same) (void)add_zeros(k, mode, &p, &rest);
  same = rest.points > 0;
  for (unsigned f = 0; f < k->count; f++) {
    const unsigned i = f / 2;
    const tf_real_t off =
        f == X_OF(i) ? rest.h[i] - motion->h[i] : rest.g[i] - motion->g[i];
    same = same && is_0(k, f, off) &&
           (mode[i] == motion->mode[i] || mode[i] == TF_PINNED ||
            (rest.attracting >> i) & 1u);
  }
  return same;
}

// How many shares a contact tries in a mode; 0: it cannot be in that mode.
static unsigned share_count(const mechanism_t *k, unsigned i, unsigned mode) {
  if (slips_by_law(k, i)) return mode == slip_with(sign_of(k->law[i].x));
  if (!has_moment(k, i)) return mode != TF_PINNED;
  return is_slip(mode) ? SHARES : 1;
}

// A tree: a mode for each contact from the last to the first, levels 2 n - 1 to
// n, then a share for each, levels n - 1 to 0. A branch is left where the
// contacts that have a mode cannot have it, whatever the others do.
TF_API bool tf_joint_modes(const mechanism_t *k, tf_joint_mode_t found[],
                           unsigned room, unsigned *count) {
  const unsigned n = k->count / 2;
  unsigned mode[TF_CONTACTS] = {0}, tried[2 * TF_CONTACTS + 1] = {0};
  tf_joint_mode_t joint = {.points = 0};
  problem_t p;
  bool is_sure = true;
  for (unsigned i = 0; i < n; i++) pose(k, i, TF_NO_MODE, OPEN, &p);
  *count = 0;
  for (unsigned level = 2 * n - 1; level < 2 * n;) {
    const bool of_mode = level >= n;
    const unsigned i = of_mode ? level - n : level, next = tried[level];
    if (next == (of_mode ? TF_MODES : share_count(k, i, mode[i]))) {
      pose(k, i, of_mode ? TF_NO_MODE : mode[i], OPEN, &p);
      if (level == n - 1) {
        if (joint.points > 0 && (*count)++ < room) found[*count - 1] = joint;
        joint.points = 0;
      }
      tried[++level]++;
      continue;
    }
    if (of_mode) mode[i] = next;
    const unsigned shares = share_count(k, i, mode[i]);
    bool may = shares > 0;
    if (of_mode ? may : shares > 1) {
      pose(k, i, mode[i], of_mode ? OPEN : (share_t)next, &p);
      may = may_hold(k, &p);
    }
    if (may && level > 0) {
      tried[--level] = 0;
    } else {
      tf_joint_mode_t one = {.points = 0};
      is_sure = (!may || add_zeros(k, mode, &p, &one)) && is_sure;
      if (one.points > 0 && rests_too(k, &one, p)) one.points = 0;
      one.points = (uint16_t)(one.points + joint.points);
      if (joint.points == 0) joint = one;
      joint.points = one.points;
      tried[level]++;
    }
  }
  return is_sure;
}

TF_API void tf_bound_products(mechanism_t *k) {
  joint_box_t most = {{0}, {0}};
  tf_real_t slope[MULTIPLIERS], value, products = 0;
  for (unsigned a = 0; a < k->count; a++) most.half[a] = most_of(a);
  for (unsigned f = 0; f < k->count; f++) {
    tf_real_t size = magnitude(numbers_of_form(k, f)[0]);
    k->bend[f] = form_at(k, f, &most, &value, slope);
    products += k->bend[f];
    for (unsigned a = 0; a < k->count; a++) size += magnitude(slope[a]);
    k->bend[f] += JOINT_ROUNDING * (size + k->bend[f]);
  }
  k->is_affine = products == 0;
}

TF_API bool tf_comes_to_h_0(const mechanism_t *k, unsigned i, tf_real_t now) {
  const tf_real_t *form = numbers_of_form(k, 2 * i);
  tf_real_t reach = k->bend[2 * (size_t)i];
  for (unsigned a = 0; a < k->count; a++)
    reach += magnitude(form[1 + a]) * most_of(a);
  return within(now, magnitude(form[0] - now) + reach);
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
  look(k, &p, &point, &at);
  invert_slopes(k, &p, &at);
  if (!comes_to_zero(k, &p, mode, &point, &at)) return false;
  for (unsigned a = 0; a < k->count; a++) m[a] = point.middle[a];
  for (unsigned i = 0; i < k->count / 2; i++) h[i] = at.value[X_OF(i)];
  return true;
}
