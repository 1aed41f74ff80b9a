// How far a force is from the law of slip at the slip that a step ends with.
// The residual of inclusion.h does not ask this: it reads the angle in stick
// alone.
#ifndef TF_SLIP_RESIDUAL_H
#define TF_SLIP_RESIDUAL_H

#include "tyre_law.h"

// |F - law| + |M - law|, and how far h is on the other side, with 1 m/s counted
// as 1 N and 1 N m as 1 N. At h = g = 0 the law holds every angle, and what is
// left to ask is the curve of F and M over the angles: M = 3 kappa (4/3 mu -
// |F|).
TF_INLINE tf_real_t slip_law_residual(const tf_tyre_t *tyre, sign_t side,
                                      tf_force_t force, tf_slip_t slip) {
  if (tyre->law == TF_TYRE_NONE) return magnitude(force.F) + magnitude(force.M);
  const tf_real_t beyond = with_sign(side, -slip.h);
  if (tyre->law == TF_TYRE_JUMP && slip.h == 0 && slip.g == 0) {
    const tf_real_t most = MAX_SLIP_FORCE(tyre->mu);
    const tf_real_t F = clip(with_sign(side, force.F), tyre->mu, most);
    const tf_real_t M = MOMENT_BY_FORCE * tyre->kappa * (most - F);
    return magnitude(force.F - with_sign(side, F)) +
           magnitude(magnitude(force.M) - M);
  }
  const tf_force_t expected = tf_tyre_force(tyre, unit(side), slip.h, slip.g);
  return magnitude(force.F - expected.F) + magnitude(force.M - expected.M) +
         (beyond > 0 ? beyond : 0);
}

#endif
