// The law at h = g = 0: which F and M let the wheel rest. In the multipliers
// x = F / mu and y = M / (kappa mu) every law is
//   |x| <= x0 - x1 |y|,  |y| <= y0 + y1 |x|.
// As the angle of slip turns, the limits of its force run along |x| = 4/3 -
// |y|/3, |y| <= 1. Their convex hull is a hexagon, which holds both segments of
// stick, y = x and y = -x with |x| <= 1.
#ifndef TF_REST_LAW_H
#define TF_REST_LAW_H

#include "twofold/contact.h"
#include "tyre_law.h"

typedef struct {
  tf_real_t x0, x1, y0, y1;
} rest_bounds_t;

TF_INLINE rest_bounds_t rest_bounds(tf_rest_law_t law) {
  static const rest_bounds_t bounds[TF_REST_LAWS] = {
      {MAX_SLIP_FORCE(TF_R(1.0)), 1 / MOMENT_BY_FORCE, 1, 0},
      {1, 0, 1, 0},
      {1, 0, 0, 1}};
  return bounds[law];
}

// Whether the wheel rests under these multipliers. NaN does not rest.
TF_INLINE bool rests_under(tf_rest_law_t law, tf_real_t x, tf_real_t y) {
  const rest_bounds_t at = rest_bounds(law);
  const tf_real_t X = magnitude(x), Y = magnitude(y);
  return (X <= at.x0 - at.x1 * Y) & (Y <= at.y0 + at.y1 * X);
}

// How far a force is from those under which the wheel rests, with 1 N m counted
// as 1 N; 0 for those alone.
TF_INLINE tf_real_t rest_residual(tf_rest_law_t law, tf_real_t mu,
                                  tf_real_t kappa, tf_force_t force) {
  const rest_bounds_t at = rest_bounds(law);
  const tf_real_t F = magnitude(force.F), M = magnitude(force.M);
  const tf_real_t most_M = kappa * (at.y0 * mu + at.y1 * F);
  const tf_real_t off_M = M <= most_M ? 0 : M - most_M;
  const tf_real_t most_F = at.x0 * mu - at.x1 * (M - off_M) / kappa;
  return off_M + (F <= most_F ? 0 : F - most_F);
}

// How far a force is from the law of slip at the slip that a step ends with,
// where the residual of inclusion.h reads the angle in stick alone: |F - law| +
// |M - law|, and how far h is on the other side, with 1 m/s counted as 1 N and
// 1 N m as 1 N. At h = g = 0 the law holds every angle, and what is left is the
// curve of F and M over the angles: M = 3 kappa (4/3 mu - |F|).
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
