// Ends that any rare step may take: in a given mode, and without a mode.
#include "scheme.h"

TF_API forced_end_t tf_mode_end(const free_motion_t *c,
                                const tf_contact_modes_t *s, unsigned mode) {
  return mode_end(c, s, mode, true);
}

TF_API forced_end_t tf_end_by(const free_motion_t *c, multipliers_t m) {
  return end_by(c, m);
}

TF_API tf_slip_t tf_slip_of_end(const free_motion_t *c,
                                const forced_end_t *end) {
  return end_slip(c, end);
}

// How far an end is from the law: in slip, how far h is on the other side.
static tf_real_t violation_of(const tf_machine_t *k, unsigned mode,
                              tf_force_t force, tf_slip_t slip) {
  const outcome_t outcome = {.mode = mode};
  if (!is_slip(mode)) return mode_residual(k, &outcome, force, slip);
  return clip(with_sign(sign_in(mode), -slip.h), 0, TF_REAL_MAX);
}

TF_API void tf_least_violation(const free_motion_t *c, inclusion_t *in,
                               unsigned set, step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  to->outcome =
      (outcome_t){.mode = TF_PINNED, .set = set, .status = TF_DEGRADED};
  tf_real_t least = TF_REAL_MAX;
  tf_contact_modes_t candidates = {0};
  to->end = tf_mode_end(c, &candidates, TF_PINNED);
  if (k->contact.stick_kappa > 0) // whatever the sign of g would be
    tf_enumerate(in, BOTH_SIGNS, &candidates);
  const bool slipping = is_slip(c->state->mode);
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    const bool sticks = is_stick(mode);
    if (slipping && sticks && !(candidates.attracting & TF_MODE_BIT(mode)))
      continue;
    const forced_end_t end = tf_mode_end(c, &candidates, mode);
    const tf_slip_t slip = tf_slip_of_end(c, &end);
    const tf_real_t violation = violation_of(k, mode, end.force, slip);
    const bool ties =
        violation == least && magnitude(end.at.w) < magnitude(to->end.at.w);
    if (!(violation < least) && !ties) continue;
    least = violation;
    to->outcome.mode = mode;
    to->end = end;
  }
  to->outcome.delassus =
      step_delassus(k, in, sign_of(tf_slip_of_end(c, &to->end).g));
}
