// What the analyser is told, not shown, in the entry step_finite: put before
// src/moreau/step.c there. It lets NaN pass a comparison, which IEEE 754 and so
// the language (Annex F) do not, and knows no relation between two numbers.
// Each line below that says "admit" is the whole of one argument; that the code
// is as the arguments say is not analysed but executed, at and around every
// limit: numbers_that_pass_are_finite_and_within_the_limit,
// angle_kernel_error_bound.
#ifndef TF_EVA_TOLD_H
#define TF_EVA_TOLD_H

#include "model/kinematics.h"
#include "model/tyre_law.h"

#define IN_REACH(x) (\is_finite(x) && -1e9 <= (x) <= 1e9)

// |r| + |v| + |w| <= 1e9: no comparison holds for NaN, and a sum of magnitudes,
// rounded, is not below any of them, for rounding keeps the order.
static inline bool told_reach(const tf_real_t *r, const tf_real_t *v,
                              const tf_real_t *w) {
  //@ admit IN_REACH(*r) && IN_REACH(*v) && IN_REACH(*w);
  return true;
}

// The same of the state and the inputs that a step begins with.
static inline bool told_range(const tf_state_t *x, const tf_input_t *u) {
  //@ admit IN_REACH(x->r) && IN_REACH(x->v) && IN_REACH(x->w);
  //@ admit IN_REACH(u->omega0) && IN_REACH(u->r0) && IN_REACH(u->force);
  //@ admit IN_REACH(u->torque) && IN_REACH(u->alpha);
  return true;
}

// |x| <= limit, and limit is a number: x is neither NaN nor infinite.
static inline bool told_within(const tf_real_t *x) {
  //@ admit \is_finite(*x);
  return true;
}

// A clip between two numbers is between them: what is not above the lower one,
// NaN too, becomes it.
static inline tf_real_t told_clip(tf_real_t x, tf_real_t low, tf_real_t high) {
  const tf_real_t y = clip(x, low, high);
  //@ admit \is_finite(low) && \is_finite(high) ==> low <= y <= high;
  return y;
}

// T is NaN where G or H is not finite, else in [0, 6 kappa] up to its 16 ULP
// (angle_kernel_error_bound executes that): x is 4/3 - T / (18 kappa).
static inline multipliers_t told_multipliers(const tf_tyre_t *tyre,
                                             tf_real_t side, tf_real_t h,
                                             tf_real_t g) {
  multipliers_t m = jump_multipliers(tyre, side, h, g);
  //@ admit \is_NaN(m.x) || -1.34 <= m.x <= 1.34;
  //@ admit \is_NaN(m.y) || -1.01 <= m.y <= 1.01;
  return m;
}

#define in_reach(r, v, w) (in_reach(r, v, w) && told_reach(&(r), &(v), &(w)))
#define in_range(x, u) (in_range(x, u) && told_range(x, u))
#define within(x, limit) (within(x, limit) && told_within(&(x)))
#define clip(x, low, high) told_clip(x, low, high)
#define jump_multipliers told_multipliers

#endif
