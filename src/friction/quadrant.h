// One quadrant of the (g, h) plane near h = g = 0, and its limit directions.
#ifndef TF_QUADRANT_H
#define TF_QUADRANT_H

#include "tyre_law.h"

// c0 + cx x + cy y in the multipliers of force and moment.
typedef struct {
  tf_real_t c0, cx, cy;
} affine_t;

// How h and g change at h = g = 0, at an instant [m/s^2] or over a step [m/s],
// and the multipliers that keep the wheel at rest, too large where none do.
typedef struct {
  affine_t h, g;
  multipliers_t pin;
} codim2_field_t;

// One quadrant of the (g, h) plane: the accelerations sign_g g' = g0 + g1 T and
// sign_h h' = h0 + h1 T, which are affine in T = cot(psi).
typedef struct {
  tf_real_t g0, g1, h0, h1;
  sign_t sign_g, sign_h;
} quadrant_t;

#define tf_quadrant_of TF_LINK(tf_quadrant_of)
TF_API quadrant_t tf_quadrant_of(const tf_tyre_t *tyre,
                                 const codim2_field_t *field, sign_t sign_g,
                                 sign_t sign_h);

// Whether somewhere in a quadrant h and g both grow in magnitude: only there
// can a slip leave along a limit direction.
#define tf_may_leave TF_LINK(tf_may_leave)
TF_API bool tf_may_leave(const quadrant_t *q, tf_real_t T_most);

// A direction by cosine and sine of its angle from the h axis, which need no
// common factor, and its T.
typedef struct {
  tf_real_t C, S, T;
} direction_t;

// The acceleration across a direction, > 0 towards larger |g/h|, times the
// length of (C, S): zero along a limit direction.
TF_INLINE tf_real_t angular_rate(const quadrant_t *q, direction_t at) {
  return (q->g0 + q->g1 * at.T) * at.C - (q->h0 + q->h1 * at.T) * at.S;
}

typedef struct {
  tf_real_t T;       // its cot(psi)
  tf_real_t C, S;    // cosine and sine of its angle from the h axis
  tf_real_t growth;  // of its slips, outwards [m/s^2]
  bool is_attractor; // its neighbours turn to it as time runs on
  bool exists;
  sign_t sign_g; // of its quadrant
} limit_direction_t;

static const limit_direction_t no_direction = {0, 0, 0, 0, false, false, PLUS};

// Which of the limit directions of a quadrant is sought: the best exit, or the
// first one that a slip turns to from T towards larger or smaller ones.
typedef struct {
  bool leaves, upwards;
  tf_real_t T;
} search_t;

// Keeps the one that is sought where it is better than the best so far.
#define tf_search_quadrant TF_LINK(tf_search_quadrant)
TF_API void tf_search_quadrant(const tf_tyre_t *tyre, const quadrant_t *q,
                               const search_t *search, limit_direction_t *best);

#endif
