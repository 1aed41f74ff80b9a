// Cases that the analyser does not tell apart by itself, in the entries that
// ask for finite numbers: put before every file there. It lets NaN pass a
// comparison, which IEEE 754 and so the language (Annex F) do not, and knows no
// relation between two numbers. So the functions through which numbers pass
// are called here case by case: one argument is NaN or infinite or beyond the
// limit, or none is. What they return is theirs in every case, and nothing is
// assumed of it: where in_reach() lets a number through, the proofs that need
// it fail.
//
// Two things are admitted: that a number is NaN or not, infinite or not; and
// what the angle kernel returns, which is executed (angle_kernel_error_bound).
#ifndef TF_EVA_CASES_H
#define TF_EVA_CASES_H

#include <math.h>

#include "friction/tyre_law.h"
#include "model/mechanics.h"

// The documented limit of r, v, w and of every input (twofold/machine.h).
#define LIMIT TF_R(1e9)
#define IN_REACH(x) (\is_finite(x) && -1e9 <= (x) <= 1e9)

// Whether it is a number and not NaN. What is assigned the analyser computes
// as IEEE 754 does; NaN passes where it branches.
static inline bool is_number(tf_real_t x) {
  const bool is = x >= -(tf_real_t)INFINITY;
  return is;
}

// NaN or below the limits, within them, or above.
static inline int side_of(const tf_real_t *x) {
  //@ admit \is_NaN(*x) || !\is_NaN(*x);
  if (!is_number(*x)) return -1;
  if (!(*x >= -LIMIT)) return -1;
  if (!(*x <= LIMIT)) return 1;
  return 0;
}

static inline bool in_reach_by_cases(const tf_real_t *r, const tf_real_t *v,
                                     const tf_real_t *w) {
  if (side_of(r) != 0) return in_reach(*r, *v, *w);
  if (side_of(v) != 0) return in_reach(*r, *v, *w);
  if (side_of(w) != 0) return in_reach(*r, *v, *w);
  return in_reach(*r, *v, *w);
}

static inline bool in_range_by_cases(const tf_state_t *x, const tf_input_t *u) {
  const tf_real_t *const number[] = {&x->r,  &x->v,     &x->w,      &u->omega0,
                                     &u->r0, &u->force, &u->torque, &u->alpha};
  //@ loop unroll 8;
  for (int i = 0; i < 8; i++)
    if (side_of(number[i]) != 0) return in_range(x, u);
  return in_range(x, u);
}

static inline bool within_by_cases(const tf_real_t *x, tf_real_t limit) {
  /*@ admit \is_NaN(*x) || \is_plus_infinity(*x) || \is_minus_infinity(*x) ||
            \is_finite(*x); */
  return within(*x, limit);
}

// NaN passes the branches of clip() here, but not where IEEE 754 holds: then it
// returns `low`, which is executed
// (numbers_that_pass_are_finite_and_within_the_limit) and assumed here, not
// shown.
static inline tf_real_t clip_by_cases(tf_real_t x, tf_real_t low,
                                      tf_real_t high) {
  //@ admit \is_NaN(x) || !\is_NaN(x);
  if (!is_number(x)) return low;
  return clip(x, low, high);
}

// T is NaN where G or H is not finite, else in [0, 6 kappa] up to its 16 ULP
// (angle_kernel_error_bound executes that): x is 4/3 - T / (18 kappa).
static inline multipliers_t told_multipliers(const tf_tyre_t *tyre, sign_t side,
                                             tf_slip_t slip) {
  multipliers_t m = jump_multipliers(tyre, side, slip);
  //@ admit \is_NaN(m.x) || -1.34 <= m.x <= 1.34;
  //@ admit \is_NaN(m.y) || -1.01 <= m.y <= 1.01;
  return m;
}

#define in_reach(r, v, w) in_reach_by_cases(&(r), &(v), &(w))
#define in_range in_range_by_cases
#define within(x, limit) within_by_cases(&(x), limit)
#define clip clip_by_cases
#define jump_multipliers told_multipliers

#endif
