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

// What rounding makes of g where forces balance, step after step: that of the
// state, which an incremental step does not have, and that of the terms of (2)
// and (3), whose sum goes into p and q; friction, which balances them, is no
// larger.
TF_INLINE tf_real_t rounding_of_g(const free_motion_t *c,
                                  const tf_input_t *input) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const linear_t *l = &c->linear;
  const tf_state_t *x = c->state;
  const tf_real_t r = magnitude(x->r), v = magnitude(x->v);
  const tf_real_t w = magnitude(x->w), mrw = k->m * r * w;
  const tf_real_t outward = k->k2 * magnitude(input->r0 - x->r) + k->c2 * v +
                            mrw * w + magnitude(input->force);
  const tf_real_t about = magnitude(input->torque) + k->c1 * w + 2 * mrw * v;
  const tf_real_t both = about + magnitude(k->d) * outward;
  const tf_real_t p =
      l->p_b * outward + magnitude(l->p_t) * both + magnitude(l->p_c) * about;
  const tf_real_t z =
      l->z_t * both + l->z_c * about + magnitude(l->p_t) * outward;
  return 64 * TF_REAL_EPSILON * (p + r * z) +
         (c->start.incremental ? 0
                               : slip_rounding(k, x->r, x->v, x->w, l->omega0));
}

// Whether a stick that ends on the other side of g = 0 does so by rounding
// alone: it is at rest at g = 0, or comes to it for ever, and goes on. One that
// passes g = 0 changes g by more than the rounding of one step, a quarter of
// that of several, and does not decay.
TF_INLINE bool rests_at_g_zero(const free_motion_t *c, const inclusion_t *in,
                               const solutions_t *s, unsigned mode,
                               tf_real_t rounding) {
  const bool minus = mode == TF_STICK_MINUS;
  const quadratic_t h = along(&in->h, minus);
  const tf_real_t x = minus ? s->x[1] : s->x[0];
  if (!(s->attracting & TF_MODE_BIT(mode)) ||
      (h.at_upper > 0) != (h.at_lower < 0))
    return false;
  const forced_end_t end = end_by(c, (multipliers_t){x, minus ? -x : x});
  const tf_real_t g = end_slip(c, &end).g;
  const tf_real_t change = g - in->g_now;
  const bool decays = within(g, magnitude(in->g_now));
  return within(g, rounding) && (decays || within(change, rounding / 4));
}

// Whether a motion whose mode is lost in this step reaches h = g = 0 in it, and
// finds there neither an attracting stick to continue in nor a force of the law
// that keeps it at rest: a stick that solves, but with the other sign of g, or
// a slip whose present force would take both h and g past 0. What follows is
// decided at h = g = 0 and not by where a step happens to end. So this step
// ends there, under a mean of the forces before and behind, which lies within
// the square that is the convex hull of the law at h = g = 0.
TF_INLINE bool reaches_codim2(const free_motion_t *c, const inclusion_t *in,
                              unsigned set, unsigned attracting,
                              tf_real_t rounding) {
  const unsigned mode = c->state->mode;
  const unsigned going_on = attracting | TF_MODE_BIT(TF_PINNED);
  if (mode == TF_PINNED || set & going_on || !in->has_moment ||
      !within(in->pin_x, 1) || !within(in->pin_y, 1))
    return false;
  if (mode > TF_SLIP_MINUS) {
    const quadratic_t h = along(&in->h, mode == TF_STICK_MINUS);
    // A stick whose g is already past 0, and not by rounding, has left it.
    const bool comes =
        mode == TF_STICK_MINUS ? in->g_now < rounding : in->g_now > -rounding;
    return comes && (h.at_upper > 0) == (h.at_lower < 0);
  }
  const tf_real_t side = mode == TF_SLIP_PLUS ? TF_R(1.0) : TF_R(-1.0);
  const tf_slip_t now = start_slip(c);
  const forced_end_t end =
      end_by(c, slip_multipliers(&TF_API_MACHINE(c)->tyre, side, now));
  return passes_near(now, end_slip(c, &end));
}

// What a step ends in whose mode is lost while g+ can have both signs: that
// stick, at rest; pinned, at h = g = 0; or TF_NO_MODE where the choice is open.
TF_INLINE unsigned end_of_lost_mode(free_motion_t *c, const tf_input_t *input,
                                    unsigned set, unsigned attracting) {
  const unsigned mode = c->state->mode;
  inclusion_t in = inclusion(c);
  const tf_real_t rounding = rounding_of_g(c, input);
  add_pinned_point(c, &in);
  if (in.has_moment && (mode == TF_STICK_PLUS || mode == TF_STICK_MINUS)) {
    solutions_t s = {0};
    enumerate_both_signs(&in, &s);
    if (rests_at_g_zero(c, &in, &s, mode, rounding)) return mode;
  }
  return reaches_codim2(c, &in, set, attracting, rounding)
             ? (unsigned)TF_PINNED
             : (unsigned)TF_NO_MODE;
}

#endif
