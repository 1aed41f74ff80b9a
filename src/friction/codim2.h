// What follows h = g = 0: every future that is consistent there, and the one
// that is taken. Every step calls this one function, and so does tf_begin.
//
// Near that point h and g are s sin(angle) and s cos(angle), and their rates
// depend on the angle alone: s' = S(angle), s angle' = N(angle). So a motion
// reaches or leaves the point along a zero of N, a limit direction (Antali and
// Stepan 2018), or in stick; one with S > 0 leaves. A direction to
// which its neighbours turn attracts, as does a stick with a positive Delassus
// scalar. Stick that arrives goes on, at rest, where its law, the bow tie,
// holds the wheel. Other motion runs into a rest unless one of those that
// attract leaves: then it runs there.
#ifndef TF_CODIM2_H
#define TF_CODIM2_H

#include "inclusion.h"
#include "quadrant.h"

// The consistent modes of an instant, as tf_contact_choose reads them, and how
// each slip leaves.
typedef struct {
  tf_contact_modes_t solutions;
  tf_real_t lambda[2]; // of stick+ and stick-, where they are in the set
  tf_real_t T[2];      // cot(psi) along which slip+, slip- leave h = g = 0
  sign_t sign_g[2];    // and the sign of g there
} consistent_modes_t;

// The stick with one sign of g at h = g = 0: the multiplier that keeps h at 0,
// how fast |g| grows under it, and whether its Delassus scalar is positive.
typedef struct {
  tf_real_t x, rate;
  bool attracts;
} stick_t;

TF_INLINE stick_t stick_at(const codim2_field_t *field, sign_t s) {
  const tf_real_t sign = unit(s);
  const affine_t h = field->h, g = field->g;
  const tf_real_t slope = h.cx + sign * h.cy, x = -h.c0 / slope;
  return (stick_t){x, sign * (g.c0 + x * (g.cx + sign * g.cy)), slope < 0};
}

// The multipliers under which neither h nor g changes; too large where friction
// cannot do that.
TF_INLINE multipliers_t balancing_multipliers(affine_t h, affine_t g) {
  const tf_real_t det = h.cx * g.cy - h.cy * g.cx;
  const tf_real_t x = h.cy * g.c0 - h.c0 * g.cy;
  const tf_real_t y = h.c0 * g.cx - h.cx * g.c0;
  if (det == 0) return (multipliers_t){TF_REAL_MAX, TF_REAL_MAX};
  return (multipliers_t){x / det, y / det};
}

// The limit direction of one quadrant of the (g, h) plane to which a slip near
// h = g = 0 turns, whether it falls in or leaves: its T = cot(psi). False where
// there is none.
#define tf_codim2_attractor TF_LINK(tf_codim2_attractor)
TF_API bool tf_codim2_attractor(const tf_contact_t *contact,
                                const codim2_field_t *field, sign_t sign_g,
                                sign_t sign_h, tf_real_t *T);

// Where a slip near h = g = 0 goes within a step, in a field over that step.
typedef struct {
  unsigned mode;   // at its end; TF_PINNED: it comes to h = g = 0; TF_NO_MODE:
                   // the field is no number
  tf_slip_t slip;  // there
  tf_real_t share; // of the step that this takes: 1, or less to h = g = 0
  multipliers_t sum; // of its force over that share
  bool leads_in;     // along a limit direction that leads to h = g = 0
  unsigned from;     // the mode in which it comes there
  bool is_straight;  // it may come there in another mode
} codim2_course_t;

// The course of a slip with this sign of h that is not at h = g = 0: through
// the cells between the anchors of the angle kernel, each with the velocity in
// its middle, to its limit direction, h = 0 or the end of the step.
#define tf_codim2_course TF_LINK(tf_codim2_course)
TF_API codim2_course_t tf_codim2_course(const tf_contact_t *contact,
                                        const codim2_field_t *field,
                                        tf_slip_t slip, sign_t sign_h);

// Adds the best exit into the side h > 0 or h < 0, from both of its quadrants.
#define tf_add_exit TF_LINK(tf_add_exit)
TF_API void tf_add_exit(const tf_contact_t *contact,
                        const codim2_field_t *field, sign_t sign_h,
                        consistent_modes_t *out);

// The consistent modes at h = g = 0 under a law with a moment. Of the slips on
// one side of h = 0 it is the one that attracts, then the one that grows
// faster. `attracting` has the slips that attract as well, departure their s',
// and near_stick is the faster stick.
#define tf_codim2_modes TF_LINK(tf_codim2_modes)
TF_API void tf_codim2_modes(const tf_contact_t *contact,
                            const codim2_field_t *field,
                            consistent_modes_t *out);

// The multipliers of a slip or stick of these modes that leaves h = g = 0.
#define tf_codim2_multipliers TF_LINK(tf_codim2_multipliers)
TF_API multipliers_t tf_codim2_multipliers(const tf_contact_t *contact,
                                           const consistent_modes_t *modes,
                                           unsigned mode);

// Of these modes the one that the declared rule takes (tf_rule_t), TF_NO_MODE
// where there is none. from: the mode of the motion. arrives: it comes there,
// and has lost its mode; else it is there, and keeps its mode as the rule says.
#define tf_leave_codim2 TF_LINK(tf_leave_codim2)
TF_API unsigned tf_leave_codim2(const tf_contact_t *contact,
                                const codim2_field_t *field, unsigned from,
                                bool arrives, uint64_t tick, uint32_t seed,
                                const consistent_modes_t *modes);

#endif
