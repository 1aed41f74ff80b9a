// The solution set of the inclusion (incl) of one step, by enumeration; inline,
// because it is a stage of the step.
//
// Existence is decided by the signs of h at x = +1 and x = -1 alone. For one s:
//   slip+ solves iff h(1, s) > 0, slip- iff h(-1, -s) < 0, and a stick lies
//   between iff both or neither do (intermediate value theorem):
// neither: one solution, the stick of a positive Delassus scalar; both: three,
// the stick with a negative one. No division by a scalar near 0 decides
// anything.
//
// Unknowns are the multipliers x = F / mu and y = M / (kappa mu) of the mean
// force and moment of the step. The slip speeds at its end are quadratic forms
// of them, because r+ moves with v+, and the law holds there:
//   h+ = h(x, y),  g+ = g(x, y),  y = s x
//   x in Sgn(h+),  s in Sgn(g+)                                       (incl)
// Up to five modes solve it, none is possible: friction is not associated.
#ifndef TF_INCLUSION_H
#define TF_INCLUSION_H

#include <stdint.h>

#include "../num/kernel.h"
#include "mode_set.h"
#include "rest_law.h"
#include "twofold/contact.h"
#include "tyre_law.h"

// The inclusion (incl) of one step.
typedef struct {
  tf_form_t h, g;
  tf_real_t g_now;        // g before the step: decides a tie of s [m/s],
                          // see is_nearer_plus()
  bool has_moment;        // false: cy, cxy, cyy are 0 and stick depends on no s
  tf_rest_law_t rest;     // the law at h = g = 0
  tf_real_t pin_x, pin_y; // the x, y that end the step at h = g = 0; read only
                          // where g+ can have both signs
} inclusion_t;

TF_INLINE tf_real_t form_value(const tf_form_t *f, tf_real_t x, tf_real_t y) {
  return f->c0 + x * (f->cx + x * f->cxx) +
         y * (f->cy + x * f->cxy + y * f->cyy);
}

// The form by the way from a point: its value and slopes there.
TF_INLINE tf_form_t form_about(const tf_form_t *f, multipliers_t at) {
  const tf_real_t x = at.x, y = at.y;
  return (tf_form_t){form_value(f, x, y),
                     f->cx + 2 * f->cxx * x + f->cxy * y,
                     f->cy + f->cxy * x + 2 * f->cyy * y,
                     f->cxx,
                     f->cxy,
                     f->cyy};
}

// The largest sum of its terms for x and y of these sizes.
TF_INLINE tf_real_t form_size(const tf_form_t *f, tf_real_t x, tf_real_t y) {
  return magnitude(f->c0) + x * (magnitude(f->cx) + x * magnitude(f->cxx)) +
         y * (magnitude(f->cy) + x * magnitude(f->cxy) + y * magnitude(f->cyy));
}

// Whether a form that is `now` at the start can come to 0 within the step: by
// how much it moves, free and under the forces of the law.
TF_INLINE bool may_vanish(const tf_form_t *f, tf_real_t now) {
  return within(now, magnitude(f->c0 - now) + MAX_SLIP_FORCE(magnitude(f->cx)) +
                         magnitude(f->cy));
}

// A form of x and y along y = s x, which stick is held to: c0 + c1 x + c2 x^2,
// and its values at the ends of x, 1 (upper) and -1 (lower).
typedef struct {
  tf_real_t c0, c1, c2, at_upper, at_lower;
} quadratic_t;

TF_INLINE quadratic_t along(const tf_form_t *f, sign_t s) {
  quadratic_t on = {f->c0, f->cx + with_sign(s, f->cy), 0, 0, 0};
  on.c2 = f->cxx + f->cyy + with_sign(s, f->cxy);
  on.at_upper = f->c0 + on.c2 + on.c1;
  on.at_lower = f->c0 + on.c2 - on.c1;
  return on;
}

TF_INLINE tf_real_t quadratic_at(const quadratic_t *f, tf_real_t x) {
  return f->c0 + x * (f->c1 + x * f->c2);
}

// What the signs of h at x = +1 and x = -1 decide, see above.
TF_INLINE bool slip_plus_solves(const quadratic_t *h) {
  return h->at_upper > 0;
}

TF_INLINE bool slip_minus_solves(const quadratic_t *h) {
  return h->at_lower < 0;
}

// Whether the Delassus scalar of this stick is positive.
TF_INLINE bool stick_attracts(const quadratic_t *h) { return h->c1 < 0; }

// Signs that g+ can have under the forces of the law, which reach |x| = 4/3 in
// slip: one sign where no |x| <= 4/3, |y| <= 1 can bring the form to 0. Both
// where that is not certain, and for NaN.
#define PLUS_SIGN 1u
#define MINUS_SIGN 2u
#define BOTH_SIGNS 3u

TF_INLINE tf_real_t most_change(const tf_form_t *f) {
  const tf_real_t X = MAX_SLIP_FORCE(TF_R(1.0));
  return X * (magnitude(f->cx) + magnitude(f->cxy) + X * magnitude(f->cxx)) +
         (magnitude(f->cy) + magnitude(f->cyy));
}

TF_INLINE unsigned signs_of(const tf_form_t *g) {
  const tf_real_t most = most_change(g);
  if (g->c0 > most) return PLUS_SIGN;
  if (-g->c0 > most) return MINUS_SIGN;
  return BOTH_SIGNS;
}

// x1 y with q y^2 + y - 1 = 0, for |q| < 2^-12: the series of y to q^4 is exact
// to 42 q^5 = 4e-17 and saves a root and a division.
TF_INLINE tf_real_t perturbed_root(tf_real_t x1, tf_real_t q) {
  return x1 * (1 - q * (1 - q * (2 - q * (5 - 14 * q))));
}

TF_INLINE bool series_suffices(tf_real_t q) {
  return magnitude(q) < TF_R(0x1p-12);
}

// Whether c1 is too small to divide by.
TF_INLINE bool is_negligible(tf_real_t c1) {
  return magnitude(c1) < TF_REAL_MIN;
}

// x1 = -c0/c1, the root of c0 + c1 x, and q = c2 x1/c1: how far c2 moves it.
typedef struct {
  tf_real_t x1, q;
} linear_root_t;

TF_INLINE linear_root_t linear_root(tf_real_t c0, tf_real_t c1, tf_real_t c2) {
  const tf_real_t inverse = 1 / c1, x1 = -c0 * inverse;
  return (linear_root_t){x1, c2 * inverse * x1};
}

// The root of c0 + c1 x + c2 x^2 that x1 becomes where c2 is small; where only
// one root lies in [-1, 1], it is this one. It is x1 y, y = 2/(1 + sqrt(1 + 4
// q)): no squares of small numbers, no cancellation. q is of third order in dt.
// At c1 = 0 (the vertical line of a two-fold) any x solves; 0 is the smallest.
TF_INLINE tf_real_t root_within(tf_real_t c0, tf_real_t c1, tf_real_t c2) {
  if (is_negligible(c1)) return 0;
  const linear_root_t from = linear_root(c0, c1, c2);
  if (series_suffices(from.q))
    return clip(perturbed_root(from.x1, from.q), -1, 1);
  const tf_real_t discriminant = 1 + 4 * from.q;
  const tf_real_t root = discriminant > 0 ? square_root(discriminant) : 0;
  return clip(2 * from.x1 / (1 + root), -1, 1);
}

// Whether the quadratic is least or largest inside (-1, 1). For h that takes a
// step so long that the change of r bends it visibly.
TF_INLINE bool has_extremum_inside(const quadratic_t *f) {
  return magnitude(f->c1) < 2 * magnitude(f->c2);
}

// Where only one slip solves, h either keeps its sign from x = -1 to 1, or it
// passes 0 and comes back: then stick solves twice.
TF_INLINE bool has_two_roots(const quadratic_t *h, bool above) {
  return has_extremum_inside(h) && (h->c2 > 0) == above &&
         h->c1 * h->c1 > 4 * h->c0 * h->c2;
}

// Whether the side g > 0 is the present one: where g is 0, the side to which it
// would move without friction.
TF_INLINE bool is_nearer_plus(tf_real_t g_now, tf_real_t g_free) {
  return (g_now > 0) | ((g_now == 0) & (g_free >= 0));
}

// The stick on the present side of g, where g+ can have these signs.
TF_INLINE uint8_t nearer_stick(const inclusion_t *in, unsigned signs) {
  const bool at_plus = signs == BOTH_SIGNS ? is_nearer_plus(in->g_now, in->g.c0)
                                           : signs == PLUS_SIGN;
  return at_plus ? TF_STICK_PLUS : TF_STICK_MINUS;
}

// Whether a stick under y = s x ends with the sign of g that s stands for.
// Without a moment both s are one law: then the sign of g decides which stick
// it is called, and g = 0 counts as the present side.
TF_INLINE bool has_sign_of_g(tf_real_t g_end, sign_t s, bool counts_zero) {
  return (s == MINUS ? g_end < 0 : g_end > 0) || (g_end == 0 && counts_zero);
}

// The stick of one s at a root of h, of two at that with this sign of g, if
// there is one.
TF_INLINE void place_stick(const quadratic_t *h, const quadratic_t *g, sign_t s,
                           tf_real_t x, bool two, bool counts_zero,
                           tf_contact_modes_t *out) {
  tf_real_t g_end = quadratic_at(g, x);
  if (two && with_sign(s, g_end) < 0) { // g = 0 belongs to the pinned wheel
    x = -h->c1 / h->c2 - x;
    g_end = quadratic_at(g, x);
  }
  out->x[s] = x;
  if (has_sign_of_g(g_end, s, counts_zero))
    out->set |= (uint8_t)TF_MODE_BIT(stick_with(s));
}

// The stick of one s, if there is one.
TF_INLINE void solve_stick(const quadratic_t *h, const quadratic_t *g, sign_t s,
                           tf_contact_modes_t *out) {
  const bool above = slip_plus_solves(h), one = above != slip_minus_solves(h);
  const bool two = one && has_two_roots(h, above);
  if (stick_attracts(h)) out->attracting |= (uint8_t)TF_MODE_BIT(stick_with(s));
  if (one && !two) return; // one slip, no stick
  place_stick(h, g, s, root_within(h->c0, h->c1, h->c2), two, false, out);
}

// g(s) in a slip at h -> 0: the quadratic through g_plus at 1 and g_minus at -1
// with leading term bend.
TF_INLINE quadratic_t over_share(tf_real_t g_plus, tf_real_t g_minus,
                                 tf_real_t bend) {
  return (quadratic_t){(g_plus + g_minus) / 2 - bend, (g_plus - g_minus) / 2,
                       bend, g_plus, g_minus};
}

// The share s of the moment in a slip at h -> 0. Where g+ is > 0 for s = +1 and
// < 0 for s = -1 both solve; then the present sign of g is kept unless it
// contradicts the slip. Where neither solves, the angle passes through g = 0 at
// an s between them.
TF_INLINE tf_real_t moment_share(tf_real_t g_plus, tf_real_t g_minus,
                                 tf_real_t bend, bool plus_slips,
                                 bool minus_slips, bool prefer_plus) {
  if (g_plus > 0 && g_minus < 0)
    return (prefer_plus ? plus_slips : !minus_slips) ? TF_R(1.0) : TF_R(-1.0);
  if (g_plus > 0) return 1;
  if (g_minus < 0) return -1;
  const quadratic_t g = over_share(g_plus, g_minus, bend);
  return root_within(g.c0, g.c1, g.c2);
}

// h at the end of a slip at h -> 0 with share tau of the moment: the quadratic
// through its values at shares 1 and -1 with leading term bend.
TF_INLINE tf_real_t slip_end_at(tf_real_t tau, tf_real_t h_plus,
                                tf_real_t h_minus, tf_real_t bend) {
  return ((1 + tau) * h_plus + (1 - tau) * h_minus) / 2 -
         (1 - tau * tau) * bend;
}

// h and g at the end of a slip at h -> 0, with s = +1 and with s = -1.
typedef struct {
  tf_real_t h_plus, h_minus, g_plus, g_minus;
} slip_ends_t;

// Whether such a quadratic turns between s = -1 and s = 1. Where neither h nor
// g does, no slip that ends at g = 0 adds a mode to those that end with a sign
// of g.
TF_INLINE bool bends(tf_real_t plus, tf_real_t minus, tf_real_t bend) {
  return magnitude(plus - minus) < 4 * magnitude(bend);
}

// A share at which g vanishes and the slip solves, or `none`. Its arguments are
// in registers, as those of all that a step calls.
TF_RARE tf_real_t share_at_g_zero(sign_t side, slip_ends_t at, tf_real_t h_bend,
                                  tf_real_t g_bend, tf_real_t none) {
  const tf_real_t c1 = (at.g_plus - at.g_minus) / 2;
  const tf_real_t c0 = (at.g_plus + at.g_minus) / 2 - g_bend;
  const tf_real_t discriminant = c1 * c1 - 4 * c0 * g_bend;
  const tf_real_t width = discriminant > 0 ? square_root(discriminant) : 0;
  const tf_real_t twice = c1 < 0 ? c1 - width : c1 + width;
  const tf_real_t roots[2] = {-twice / (2 * g_bend), -2 * c0 / twice};
  for (int i = 0; i < 2 && discriminant >= 0; i++)
    if (within(roots[i], 1) &&
        with_sign(side, slip_end_at(roots[i], at.h_plus, at.h_minus, h_bend)) >
            0)
      return roots[i];
  return none;
}

// The slip at h -> 0 on one side, whatever its share of the moment.
TF_INLINE void solve_slip(const inclusion_t *in, sign_t side, slip_ends_t at,
                          tf_contact_modes_t *out) {
  const tf_real_t h_bend = in->h.cyy, g_bend = in->g.cyy;
  tf_real_t tau = moment_share(
      at.g_plus, at.g_minus, g_bend, with_sign(side, at.h_plus) > 0,
      with_sign(side, at.h_minus) > 0, is_nearer_plus(in->g_now, in->g.c0));
  tf_real_t h_end = slip_end_at(tau, at.h_plus, at.h_minus, h_bend);
  if (!(with_sign(side, h_end) > 0) && (bends(at.g_plus, at.g_minus, g_bend) ||
                                        bends(at.h_plus, at.h_minus, h_bend))) {
    tau = share_at_g_zero(side, at, h_bend, g_bend, tau);
    h_end = slip_end_at(tau, at.h_plus, at.h_minus, h_bend);
  }
  out->tau[side] = tau;
  out->departure[side] = h_end;
  if (with_sign(side, h_end) > 0)
    out->set |= (uint8_t)TF_MODE_BIT(slip_with(side));
}

// Where one s holds: every g+ has its sign; or there is no moment, and the sign
// of g only names the stick.
TF_INLINE void enumerate_one_law(const inclusion_t *in, sign_t s,
                                 unsigned signs, tf_contact_modes_t *out) {
  const quadratic_t h = along(&in->h, s);
  const bool plus = slip_plus_solves(&h), minus = slip_minus_solves(&h);
  const bool one = plus != minus;
  out->set = (uint8_t)(plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS);
  out->attracting = (uint8_t)(stick_attracts(&h) ? signs << TF_STICK_PLUS : 0);
  out->tau[0] = out->tau[1] = unit(signs == MINUS_SIGN ? MINUS : PLUS);
  out->departure[0] = h.at_upper;
  out->departure[1] = h.at_lower;
  if (one && !has_two_roots(&h, plus)) return;
  const tf_real_t x = root_within(h.c0, h.c1, h.c2);
  if (!in->has_moment) {
    const quadratic_t g = along(&in->g, s);
    const bool at_plus = out->near_stick == TF_STICK_PLUS;
    place_stick(&h, &g, PLUS, x, one, at_plus, out);
    place_stick(&h, &g, MINUS, x, one, !at_plus, out);
  } else {
    out->x[s] = x;
    out->set |= (uint8_t)TF_MODE_BIT(stick_with(s));
  }
}

// g+ may have either sign under a law with a moment: codimension two is within
// reach of this step.
TF_INLINE void enumerate_both_signs(const inclusion_t *in,
                                    tf_contact_modes_t *out) {
  const quadratic_t h0 = along(&in->h, PLUS), h1 = along(&in->h, MINUS);
  const quadratic_t g0 = along(&in->g, PLUS), g1 = along(&in->g, MINUS);
  out->set = 0;
  out->attracting = 0;
  solve_stick(&h0, &g0, PLUS, out);
  solve_stick(&h1, &g1, MINUS, out);
  const slip_ends_t up = {h0.at_upper, h1.at_upper, g0.at_upper, g1.at_upper};
  const slip_ends_t down = {h0.at_lower, h1.at_lower, g0.at_lower, g1.at_lower};
  solve_slip(in, PLUS, up, out);
  solve_slip(in, MINUS, down, out);
  if (rests_under(in->rest, in->pin_x, in->pin_y))
    out->set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}

TF_INLINE void enumerate(const inclusion_t *in, unsigned signs,
                         tf_contact_modes_t *out) {
  out->near_stick = nearer_stick(in, signs);
  if (signs == BOTH_SIGNS && in->has_moment)
    enumerate_both_signs(in, out);
  else if (signs == MINUS_SIGN && in->has_moment)
    enumerate_one_law(in, MINUS, signs, out);
  else
    enumerate_one_law(in, PLUS, signs, out);
}

// The same as a function, to save code size.
#define tf_enumerate TF_LINK(tf_enumerate)
TF_API void tf_enumerate(const inclusion_t *in, unsigned signs,
                         tf_contact_modes_t *out);

// The multipliers that end a step at a slip, from a guess, by two steps of
// Newton's method; NaN where friction cannot steer both h and g.
#define tf_multipliers_to TF_LINK(tf_multipliers_to)
TF_API multipliers_t tf_multipliers_to(const tf_form_t *h, const tf_form_t *g,
                                       tf_slip_t to, multipliers_t guess);

// All points of |x|, |y| <= 3/2 at which two forms are 0, once each. Returns
// how many. Curves that touch count as one zero if a change of the coefficients
// by 64 epsilon makes it one. Of forms that are 0 along a whole curve some
// points are returned, none where both are 0 everywhere. A form whose largest
// coefficient is below TF_REAL_MIN / epsilon counts as 0.
#define TF_MOST_ZEROS 4
#define tf_common_zeros TF_LINK(tf_common_zeros)
TF_API unsigned tf_common_zeros(const tf_form_t *h, const tf_form_t *g,
                                multipliers_t at[TF_MOST_ZEROS]);

// Whether a step that does not begin at rest has h = g = 0 within reach: a slip
// that is so near, or a stick whose g changes its sign.
TF_INLINE bool slip_reaches_codim2(const tf_form_t *h, const tf_form_t *g,
                                   tf_slip_t now) {
  return may_vanish(h, now.h) && may_vanish(g, now.g);
}

TF_INLINE bool stick_reaches_codim2(unsigned mode, unsigned signs,
                                    unsigned set) {
  const unsigned own = sign_in(mode) == PLUS ? PLUS_SIGN : MINUS_SIGN;
  return signs != own && !has(set, mode);
}

// The multipliers of a stick, of a slip at the slip `at`, and of one at h -> 0.
TF_INLINE multipliers_t stick_multipliers(tf_real_t x, sign_t s) {
  return (multipliers_t){x, with_sign(s, x)};
}

// rare: out of line, to save code size.
TF_INLINE multipliers_t slip_multipliers(const tf_tyre_t *tyre, sign_t side,
                                         tf_slip_t at, bool rare) {
  if (tyre->law == TF_TYRE_COULOMB) return (multipliers_t){unit(side), 0};
  return rare ? tf_jump_multipliers(tyre, side, at)
              : jump_multipliers(tyre, side, at);
}

TF_INLINE multipliers_t limit_multipliers(sign_t side, tf_real_t tau) {
  return (multipliers_t){unit(side), with_sign(side, tau)};
}

// Those under which a step ends in a mode: in slip at h -> 0, pinned in the
// point that tf_contact_force takes.
#define tf_mode_multipliers TF_LINK(tf_mode_multipliers)
TF_API multipliers_t tf_mode_multipliers(const tf_contact_t *contact,
                                         const tf_form_t *h, const tf_form_t *g,
                                         const tf_contact_modes_t *modes,
                                         unsigned mode);

// Whether a form of h is not one of a contact without a moment, whose force
// lowers h: of the wrong sign, or the force of x stands in the place of y.
TF_INLINE bool drives_itself(const tf_contact_t *contact, tf_real_t by_x,
                             tf_real_t by_y) {
  return contact->tyre.law == TF_TYRE_COULOMB &&
         (by_x > 0 || (by_x == 0 && by_y != 0));
}

// The force under multipliers.
TF_INLINE tf_force_t force_under(const tf_contact_t *contact, multipliers_t m) {
  return (tf_force_t){m.x * contact->tyre.mu, m.y * contact->kappa_mu};
}

// Natural map of F in mu Sgn(h).
TF_INLINE tf_real_t force_residual(tf_real_t mu, tf_real_t F, tf_real_t h) {
  return magnitude(F - clip(F + h, -mu, mu));
}

// From a moment to the segment between -M and M, which is the law at g = 0.
TF_INLINE tf_real_t distance_to_segment(tf_real_t moment, tf_real_t M) {
  return magnitude(moment - clip(moment, -magnitude(M), magnitude(M)));
}

// How far a contact force is from the law at slip (h, g), without a tolerance
// and without the enumeration: its zeros are the graph of the law. Natural map
// of F in mu Sgn(h), and the distance of M from kappa F Sgn(g),
//   |F - clip(F + h, -mu, mu)| + |M - kappa F sign(g)|,
// with 1 m/s counted as 1 N and 1 N m as 1 N; at g = 0 the nearest point of the
// segment. kappa is 0 where no moment depends on sign(g).
TF_INLINE tf_real_t law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g) {
  const tf_real_t M = kappa * force.F; // that goes with g > 0
  const tf_real_t natural = force_residual(mu, force.F, h);
  if (g > 0) return natural + magnitude(force.M - M);
  if (g < 0) return natural + magnitude(force.M + M);
  return natural + distance_to_segment(force.M, M);
}

#endif
