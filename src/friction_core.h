// The solution set of one step's inclusion (incl), where g+ can have one sign
// only; friction.c has the rest.
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
