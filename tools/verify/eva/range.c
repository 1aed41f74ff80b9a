// What the checks of a step let pass, for any numbers: what stands behind
// step_finite, as properties of their own.
#include "any.h"

static void reach(void) {
  tf_real_t r = any_real(), v = any_real(), w = any_real();
  if (!in_reach(r, v, w)) return;
  //@ check IN_REACH(r) && IN_REACH(v) && IN_REACH(w);
}

static void range(void) {
  tf_state_t x = any_state();
  tf_input_t u = any_input();
  if (!in_range(&x, &u)) return;
  //@ check IN_REACH(x.r) && IN_REACH(x.v) && IN_REACH(x.w);
  //@ check IN_REACH(u.omega0) && IN_REACH(u.r0);
  //@ check IN_REACH(u.force) && IN_REACH(u.torque) && IN_REACH(u.alpha);
}

static void finite(void) {
  tf_real_t x = any_real();
  if (!within(x, TF_REAL_MAX)) return;
  //@ check \is_finite(x);
}

static void clipped(void) {
  const tf_real_t share = clip(any_real(), -1, 1);
  //@ check \is_finite(share) && -1 <= share <= 1;
  (void)share;
}

ENTRY(range_any) {
  reach();
  range();
  finite();
  clipped();
  //@ check reached: \false;
}
