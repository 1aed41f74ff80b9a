// The solution set of one step's inclusion (incl), by enumeration. Inline: the
// step has it within itself.
//
// Existence is decided by the signs of h_s(+mu) and h_s(-mu) alone. For one s:
//   slip+ solves iff h_s(mu) > 0, slip- iff h_s(-mu) < 0, and a stick lies
//   between iff both or neither do (intermediate value theorem):
// neither: one solution, the stick of a positive Delassus scalar; both: three,
// the stick of a negative one. A division by a scalar near 0 decides nothing.
#ifndef TF_FRICTION_CORE_H
#define TF_FRICTION_CORE_H

#include "kernel.h"
#include "twofold/friction.h"

// h or g at lambda = +mu and -mu.
typedef struct {
  tf_real_t plus, minus;
} ends_t;

TF_INLINE ends_t at_ends(tf_real_t c0, tf_real_t c1, tf_real_t c2,
                         tf_real_t mu) {
  const tf_real_t middle = c0 + mu * mu * c2, span = mu * c1;
  return (ends_t){middle + span, middle - span};
}

// The root of c0 + c1 x + c2 x^2 that is the perturbed -c0/c1; it is the one
// in [-mu, mu] where just one is. With x1 = -c0/c1 and q = c2 x1/c1 the root
// is x1 y, q y^2 + y - 1 = 0, y = 2/(1 + sqrt(1 + 4 q)): no squares of small
// numbers, no cancellation. At c1 = 0 (the vertical line of a two-fold) any x
// solves; 0 is the one of least norm.
TF_INLINE tf_real_t root_within(tf_real_t c0, tf_real_t c1, tf_real_t c2,
                                tf_real_t mu) {
  if (magnitude(c1) < TF_REAL_MIN) return 0;
  const tf_real_t x1 = -c0 / c1;
  const tf_real_t discriminant = 1 + 4 * (c2 / c1) * x1;
  const tf_real_t root = discriminant > 0 ? square_root(discriminant) : 0;
  return clip(2 * x1 / (1 + root), -mu, mu);
}

// Where just one slip solves, h keeps its sign from -mu to mu or dips through 0
// and back: then stick solves twice. It takes a step so long that the change
// of r bends h(lambda) inside [-mu, mu].
TF_INLINE bool dips(tf_real_t c0, tf_real_t c1, tf_real_t c2, tf_real_t mu,
                    bool above) {
  return magnitude(c1) < 2 * mu * magnitude(c2) && (c2 > 0) == above &&
         c1 * c1 > 4 * c0 * c2;
}

// All g+ have the sign of one s: three candidates, at most.
TF_INLINE unsigned solve_one_sign(tf_real_t mu, tf_real_t c0, tf_real_t c1,
                                  tf_real_t c2, unsigned s,
                                  tf_solutions_t *out) {
  const ends_t h = at_ends(c0, c1, c2, mu);
  const unsigned plus = h.plus > 0, minus = h.minus < 0;
  const unsigned stick = TF_MODE_BIT(TF_STICK_PLUS + s);
  out->attracting = (uint8_t)(c1 < 0 ? stick : 0);
  out->tau[0] = out->tau[1] = s ? TF_R(-1.0) : TF_R(1.0);
  out->h_limit[0] = h.plus;
  out->h_limit[1] = h.minus;
  if (plus != minus && !dips(c0, c1, c2, mu, plus))
    return plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS;
  out->lambda[s] = root_within(c0, c1, c2, mu);
  return plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS | stick;
}

// The share s of the moment in a slip at h -> 0, where g(s) is the quadratic
// through g_plus at 1 and g_minus at -1 with leading term bend. Where g+ is > 0
// for s = +1 and < 0 for s = -1 both solve; then the present sign of g is kept
// unless it contradicts the slip. Where neither solves, the angle passes
// through g = 0 at an s between them.
TF_INLINE tf_real_t moment_share(tf_real_t g_plus, tf_real_t g_minus,
                                 tf_real_t bend, bool plus_slips,
                                 bool minus_slips, bool prefer_plus) {
  if (g_plus > 0 && g_minus < 0)
    return (prefer_plus ? plus_slips : !minus_slips) ? TF_R(1.0) : TF_R(-1.0);
  if (g_plus > 0) return 1;
  if (g_minus < 0) return -1;
  return root_within((g_plus + g_minus) / 2 - bend, (g_plus - g_minus) / 2,
                     bend, 1);
}

// Whether a stick with s and lambda = x ends with that sign of g. Without a
// moment both s are one solution; it goes by the sign of g, and g = 0 has to
// go somewhere.
TF_INLINE bool rolls_as(const tf_inclusion_t *in, int s, tf_real_t x) {
  const tf_real_t g = in->g_free + x * (in->g1[s] + x * in->g2[s]);
  return s ? g < 0 : g > 0 || (g == 0 && in->kappa == 0);
}

// One s: h+ and g+ of its slips at h -> 0, and its stick.
typedef struct {
  ends_t h, g;
} corners_t;

TF_INLINE corners_t solve_sign(const tf_inclusion_t *in, int s,
                               tf_solutions_t *out) {
  const tf_real_t mu = in->mu, h1 = in->h1[s], h2 = in->h2[s];
  const corners_t c = {at_ends(in->h_free, h1, h2, mu),
                       at_ends(in->g_free, in->g1[s], in->g2[s], mu)};
  const bool above = c.h.plus > 0, one = above != (c.h.minus < 0);
  const bool two = one && dips(in->h_free, h1, h2, mu, above);
  if (h1 < 0) out->attracting |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
  if (one && !two) return c; // one slip, no stick
  tf_real_t x = root_within(in->h_free, h1, h2, mu);
  if (two && !rolls_as(in, s, x)) x = -h1 / h2 - x;
  out->lambda[s] = x;
  if (rolls_as(in, s, x)) out->set |= (uint8_t)TF_MODE_BIT(TF_STICK_PLUS + s);
  return c;
}

// One side: the slip at h -> 0, whatever its share of the moment.
TF_INLINE void solve_side(const tf_inclusion_t *in, int slip, tf_real_t side,
                          tf_real_t h_plus, tf_real_t h_minus, tf_real_t g_plus,
                          tf_real_t g_minus, tf_solutions_t *out) {
  const tf_real_t M = in->kappa * in->mu;
  const tf_real_t tau =
      moment_share(g_plus, g_minus, M * M * in->g_MM, side * h_plus > 0,
                   side * h_minus > 0, in->g_now >= 0);
  const tf_real_t h_end = ((1 + tau) * h_plus + (1 - tau) * h_minus) / 2 -
                          (1 - tau * tau) * (M * M * in->h_MM);
  out->tau[slip] = tau;
  out->h_limit[slip] = h_end;
  if (side * h_end > 0) out->set |= (uint8_t)TF_MODE_BIT(TF_SLIP_PLUS + slip);
}

// g+ may have either sign: codimension two is within reach of this step.
TF_INLINE void solve_both_signs(const tf_inclusion_t *in, tf_solutions_t *out) {
  const corners_t a = solve_sign(in, 0, out), b = solve_sign(in, 1, out);
  solve_side(in, 0, 1, a.h.plus, b.h.plus, a.g.plus, b.g.plus, out);
  solve_side(in, 1, -1, a.h.minus, b.h.minus, a.g.minus, b.g.minus, out);
  // Without a moment a pinned wheel is a stick with g+ = 0: not a sixth mode.
  if (in->kappa > 0 && within(in->pin.F, in->mu) &&
      within(in->pin.M, in->kappa * magnitude(in->pin.F)))
    out->set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}

// See tf_law_residual.
TF_INLINE tf_real_t law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g) {
  const tf_real_t M = kappa * force.F; // that goes with g > 0
  const tf_real_t rest = magnitude(force.F - clip(force.F + h, -mu, mu));
  if (g > 0) return rest + magnitude(force.M - M);
  if (g < 0) return rest + magnitude(force.M + M);
  return rest + magnitude(force.M - clip(force.M, -magnitude(M), magnitude(M)));
}

#endif
