// Kinematics: slip speeds of the wheel, and the range of states.
#ifndef TF_KINEMATICS_H
#define TF_KINEMATICS_H

#include "../num/kernel.h"
#include "twofold/machine.h"

// Where a step begins or ends.
typedef struct {
  tf_real_t r, v, w;
} end_state_t;

// p = v - d z, the speed along the slider that the slip sees.
TF_INLINE tf_real_t slider_speed(const tf_machine_t *k, tf_real_t v,
                                 tf_real_t z) {
  return v - k->d * z;
}

// P = v - d w, the same seen from the ground: the kinetic energy has m P^2/2.
TF_INLINE tf_real_t ground_speed(const tf_machine_t *k, tf_real_t v,
                                 tf_real_t w) {
  return v - k->d * w;
}

// By how much the turntable turns faster after some time of a step. A build for
// one scene whose turntable is steady defines this as 0 (port/core.h).
#ifndef TF_STEP_TURN
#define TF_STEP_TURN(u, time) ((u)->alpha * (time))
#endif

// Its gain over the step, and over what follows the theta point; its speed at
// that point. omega0 of the inputs is that at the end.
TF_INLINE tf_real_t turn_of_step(const tf_machine_t *k, const tf_input_t *u) {
  return TF_STEP_TURN(u, k->dt);
}

TF_INLINE tf_real_t turn_after_theta(const tf_machine_t *k,
                                     const tf_input_t *u) {
  return TF_STEP_TURN(u, k->explicit_dt);
}

TF_INLINE tf_real_t speed_at_theta(const tf_machine_t *k, const tf_input_t *u) {
  return u->omega0 - turn_after_theta(k, u);
}

// v from p and z, or from P and w.
TF_INLINE tf_real_t slider_velocity(const tf_machine_t *k, tf_real_t p,
                                    tf_real_t z) {
  return p + k->d * z;
}

// (h), (g): the slip is (p, q) rotated by gamma, with q = r z.
TF_INLINE tf_slip_t slip_from_pq(const tf_machine_t *k, tf_real_t p,
                                 tf_real_t q) {
  return (tf_slip_t){p * k->minus_sin_gamma - q * k->cos_gamma,
                     q * k->sin_gamma - p * k->cos_gamma};
}

TF_INLINE tf_slip_t slip_speeds(const tf_machine_t *k, tf_real_t r, tf_real_t v,
                                tf_real_t z) {
  return slip_from_pq(k, slider_speed(k, v, z), r * z);
}

// What the terms of h and g amount to without their signs [m/s].
TF_INLINE tf_real_t slip_terms(const tf_machine_t *k, tf_real_t r, tf_real_t v,
                               tf_real_t w, tf_real_t omega0) {
  return magnitude(v) +
         (magnitude(k->d) + magnitude(r)) * (magnitude(w) + magnitude(omega0));
}

// What rounding makes of h and g at a state: below it they count as 0. With u =
// epsilon/2, and a step that moves v and w by no more than their size,
//   w and omega0 are off by u |w| and u |omega0|, and v by u |v|;
//   the sums and products that form v+ and w+ add 4 u of each;

//   z, d z, r z, p and the two products of h or g add u each.
// h and g are (p, q) rotated, so that this is at most 2 (1 + 4 + 3) u times the
// sum of their terms. Whoever asks whether a state is at h = 0 or g = 0 asks
// for this bound, so that a state means the same to all of them.
#define SLIP_ROUNDINGS (32 * TF_REAL_EPSILON)
TF_INLINE tf_real_t slip_rounding(const tf_machine_t *k, tf_real_t r,
                                  tf_real_t v, tf_real_t w, tf_real_t omega0) {
  return SLIP_ROUNDINGS * slip_terms(k, r, v, w, omega0);
}

// One sum instead of three comparisons: NaN and infinity survive into it.
TF_INLINE bool in_reach(tf_real_t r, tf_real_t v, tf_real_t w) {
  return within(magnitude(r) + magnitude(v) + magnitude(w), TF_STATE_LIMIT);
}

TF_INLINE bool input_in_range(const tf_input_t *u) {
  return within(magnitude(u->omega0) + magnitude(u->r0) + magnitude(u->force) +
                    magnitude(u->torque) + magnitude(u->alpha),
                TF_STATE_LIMIT);
}

TF_INLINE bool in_range(const tf_state_t *state, const tf_input_t *u) {
  return in_reach(state->r, state->v, state->w) && input_in_range(u);
}

#endif
