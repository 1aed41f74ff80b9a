// The end of a degraded step: no mode is consistent, or none that a slip may
// enter.
#ifndef TF_LEAST_VIOLATION_H
#define TF_LEAST_VIOLATION_H

#include "outcome.h"
#include "stages.h"

// Of all ends that the step may take, the one that violates the law least. s:
// what solves the inclusion.
TF_INLINE step_end_t least_violation(const free_motion_t *c,
                                     const inclusion_t *in,
                                     const solutions_t *s) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  step_end_t best = {pinned_end(c),
                     {.mode = TF_PINNED, .set = s->set, .status = TF_DEGRADED}};
  tf_real_t least = TF_REAL_MAX;
  solutions_t candidates = *s;
  enumerate_both_signs(in, &candidates); // whatever the sign of g would be
  const bool slipping = c->state->mode <= TF_SLIP_MINUS;
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    const bool sticks = mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
    if (slipping && sticks && !(candidates.attracting & TF_MODE_BIT(mode)))
      continue;
    const forced_end_t end = mode_end(c, &candidates, mode);
    const outcome_t outcome = {.mode = mode};
    const tf_real_t residual =
        mode_residual(k, &outcome, end.force, end_slip(c, &end));
    if (!(residual < least)) continue;
    least = residual;
    best.outcome.mode = mode;
    best.end = end;
  }
  best.outcome.delassus = step_delassus(k, in, end_slip(c, &best.end).g < 0);
  return best;
}

#endif
