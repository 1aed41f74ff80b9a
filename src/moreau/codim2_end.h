// Where the mode of a step is lost because the motion comes to h = g = 0 within
// the step, the step ends there, and the next one chooses what follows. So the
// branch does not depend on where a step happens to end.
#ifndef TF_CODIM2_END_H
#define TF_CODIM2_END_H

#include "stages.h"

// How near to h = g = 0 the path of a slip must pass, as a share of its length.
#define NEAR_SHARE TF_R(0.5)

// Whether the straight path of the slip between two places passes h = g = 0
// within that share of its length.
TF_INLINE bool passes_near(tf_slip_t from, tf_slip_t to) {
  const tf_real_t h = to.h - from.h, g = to.g - from.g;
  const tf_real_t length2 = h * h + g * g;
  const tf_real_t ahead = clip(-(from.h * h + from.g * g), 0, length2);
  const tf_real_t share = length2 > 0 ? ahead / length2 : 0;
  const tf_real_t closest_h = from.h + share * h,
                  closest_g = from.g + share * g;
  return closest_h * closest_h + closest_g * closest_g <=
         NEAR_SHARE * NEAR_SHARE * length2;
}

// Whether a motion whose mode is lost in this step reaches h = g = 0 in it, and
// finds there neither an attracting stick to continue in nor a force of the law
// that keeps it at rest: a stick that solves, but with the other sign of g, or
// a slip whose present force would take both h and g past 0. What follows is
// decided at h = g = 0 and not by where a step happens to end. So this step
// ends there, under a mean of the forces before and behind, which lies within
// the square that is the convex hull of the law at h = g = 0.
TF_INLINE bool reaches_codim2(free_motion_t *c, unsigned set,
                              unsigned attracting) {
  const unsigned mode = c->state->mode;
  const unsigned going_on = attracting | TF_MODE_BIT(TF_PINNED);
  inclusion_t in = inclusion(c);
  add_pinned_point(c, &in);
  if (mode == TF_PINNED || set & going_on || !in.has_moment ||
      !within(in.pin_x, 1) || !within(in.pin_y, 1))
    return false;
  if (mode > TF_SLIP_MINUS) {
    const quadratic_t h = along(&in.h, mode == TF_STICK_MINUS);
    // A stick whose g is already past 0 has left that point.
    const bool comes = mode == TF_STICK_MINUS ? in.g_now < 0 : in.g_now > 0;
    return comes && (h.at_upper > 0) == (h.at_lower < 0);
  }
  const tf_real_t side = mode == TF_SLIP_PLUS ? TF_R(1.0) : TF_R(-1.0);
  const tf_slip_t now = start_slip(c);
  const forced_end_t end =
      end_by(c, slip_multipliers(&TF_API_MACHINE(c)->tyre, side, now));
  return passes_near(now, end_slip(c, &end));
}

#endif
