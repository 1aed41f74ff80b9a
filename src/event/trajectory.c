// Where a located step begins, and which way it leaves a switch.
#include "trajectory.h"

#include "../friction/mode_set.h"
#include "twofold/select.h"

TF_API void tf_keep_largest_set(tf_trajectory_t *walk, unsigned set) {
  const unsigned n = size_of(set);
  if (n < walk->choices) return;
  walk->choices = n;
  walk->set = set;
}

TF_API tf_slip_t tf_trajectory_slip(const tf_trajectory_t *walk) {
  return slip_from_pq(walk->motion.machine, walk->at.p,
                      walk->at.r * walk->at.z);
}

TF_API tf_rates_t tf_trajectory_rates(const tf_trajectory_t *walk) {
  return rates_at(walk->motion.machine, walk->motion.input, walk->at.r,
                  walk->at.p, walk->at.z, walk->omega);
}

TF_API tf_real_t tf_trajectory_rounding(const tf_trajectory_t *walk) {
  const tf_machine_t *k = walk->motion.machine;
  const tf_real_t w = magnitude(walk->at.z + walk->omega);
  return 4 * TF_REAL_EPSILON *
         (magnitude(walk->at.p) + (magnitude(k->d) + magnitude(walk->at.r)) *
                                      (w + magnitude(walk->omega)));
}

TF_API void tf_project(tf_trajectory_t *walk) {
  const tf_machine_t *k = walk->motion.machine;
  const tf_real_t arm = walk->at.r * k->cos_gamma;
  const tf_real_t inertia = k->beta2 + walk->at.r * walk->at.r;
  const tf_real_t A =
      k->sin_gamma * k->sin_gamma + arm * arm / inertia; // times m
  if (A == 0) return;
  const tf_real_t impulse = tf_trajectory_slip(walk).h / A;
  walk->at.p += impulse * k->sin_gamma;
  walk->at.z += impulse * arm / inertia;
}

TF_API void tf_enter_mode(tf_trajectory_t *walk, unsigned mode,
                          tf_contact_t slip, tf_segment_t segment) {
  segment.closure = mode == TF_PINNED       ? TF_CONTACT_PINNED
                    : mode <= TF_SLIP_MINUS ? slip
                                            : TF_CONTACT_STICK;
  walk->mode = mode;
  walk->segment = segment;
}

TF_API bool tf_leave_h_zero(tf_trajectory_t *walk) {
  const tf_machine_t *k = walk->motion.machine;
  const int s = tf_trajectory_slip(walk).g < 0;
  const tf_rates_t rates = tf_trajectory_rates(walk);
  tf_consistent_t futures;
  tf_project(walk);
  surface_modes(k, &rates, s, &futures);
  tf_keep_largest_set(walk, futures.solutions.set);
  const unsigned mode =
      tf_select(k->rule, k->exit_threshold, &futures.solutions, walk->mode,
                walk->state->tick, walk->state->seed);
  if (mode == TF_MODES) return false;
  tf_enter_mode(walk, mode, TF_CONTACT_SLIP,
                (tf_segment_t){.side = mode == TF_SLIP_MINUS ? -1 : 1,
                               .roll = s ? -1 : 1,
                               .h_zeros = 1});
  return true;
}

// h = g = 0 means p = 0 and r z = 0: the wheel turns with the turntable, or the
// slider passes the axis, whichever of them moves r z now.
static void put_into_corner(tf_trajectory_t *walk) {
  const tf_rates_t rates = tf_trajectory_rates(walk);
  walk->at.p = 0;
  if (rates.vz > rates.rz)
    walk->at.r = 0;
  else
    walk->at.z = 0;
}

TF_API bool tf_leave_codim2(tf_trajectory_t *walk, bool from_minus) {
  const tf_machine_t *k = walk->motion.machine;
  put_into_corner(walk);
  const tf_rates_t rates = tf_trajectory_rates(walk);
  tf_consistent_t futures;
  tf_codim2_modes(k, &rates, &futures);
  futures.solutions.near_stick = from_minus ? TF_STICK_MINUS : TF_STICK_PLUS;
  tf_keep_largest_set(walk, futures.solutions.set);
  const unsigned mode =
      tf_select(k->rule, k->exit_threshold, &futures.solutions, walk->mode,
                walk->state->tick, walk->state->seed);
  if (mode == TF_MODES) return false;
  tf_segment_t segment = {.h_zeros = 1, .g_is_0 = true};
  if (mode <= TF_SLIP_MINUS) {
    segment.side = mode == TF_SLIP_PLUS ? 1 : -1;
    segment.roll = futures.sign_g[mode];
    segment.T = futures.T[mode];
  } else {
    segment.side = 1;
    segment.roll = mode == TF_STICK_MINUS ? -1 : 1;
  }
  tf_enter_mode(walk, mode, TF_CONTACT_CODIM2_SLIP, segment);
  return true;
}

TF_API bool tf_first_segment(tf_trajectory_t *walk) {
  const tf_machine_t *k = walk->motion.machine;
  const tf_slip_t slip = tf_trajectory_slip(walk);
  const tf_real_t rounding = tf_trajectory_rounding(walk);
  if (k->tyre.law == TF_TYRE_NONE) {
    walk->mode = slip.h < 0   ? TF_SLIP_MINUS
                 : slip.h > 0 ? TF_SLIP_PLUS
                              : walk->mode & 1u;
    walk->segment =
        (tf_segment_t){.closure = TF_CONTACT_NONE, .side = 1, .roll = 1};
    tf_keep_largest_set(walk, TF_MODE_BIT(walk->mode));
    return true;
  }
  // Where the mode and the signs agree they are believed, however small h or g:
  // a motion that leaves slowly must not be put back in every step.
  const bool h_is_0 = within(slip.h, rounding);
  const bool slips = walk->mode == TF_SLIP_PLUS    ? slip.h > 0
                     : walk->mode == TF_SLIP_MINUS ? slip.h < 0
                                                   : !h_is_0;
  const bool rolls = walk->mode == TF_STICK_PLUS    ? slip.g > 0
                     : walk->mode == TF_STICK_MINUS ? slip.g < 0
                                                    : false;
  if (h_is_0 && !slips) {
    // A pinned wheel comes from no side, whatever the rounding of omega0 is.
    if (k->stick_kappa > 0 && !rolls && within(slip.g, rounding))
      return tf_leave_codim2(walk, walk->mode != TF_PINNED && slip.g < 0);
    return tf_leave_h_zero(walk);
  }
  walk->mode = slip.h > 0 ? TF_SLIP_PLUS : TF_SLIP_MINUS;
  walk->segment = (tf_segment_t){.closure = TF_CONTACT_SLIP,
                                 .side = slip.h > 0 ? 1 : -1,
                                 .roll = slip.g < 0 ? -1 : 1};
  tf_keep_largest_set(walk, TF_MODE_BIT(walk->mode));
  return true;
}
