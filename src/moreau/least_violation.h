// The end of a degraded step: no mode is consistent, or none that a slip may
// enter.
#ifndef TF_LEAST_VIOLATION_H
#define TF_LEAST_VIOLATION_H

#include "outcome.h"
#include "stages.h"

// Of all ends that the step may take, the one that violates the law least.
typedef struct {
  forced_end_t end;
  outcome_t outcome;
} violation_t;

TF_INLINE violation_t least_violation(free_motion_t *c) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  inclusion_t in = inclusion(c);
  solutions_t s = {0};
  const unsigned signs = signs_of(&in.g);
  add_pinned_point(c, &in);
  enumerate(&in, signs, &s);
  violation_t best = {pinned_end(c), {TF_PINNED, s.set, TF_DEGRADED, 0, false}};
  tf_real_t least = TF_REAL_MAX;
  enumerate_both_signs(&in, &s); // candidates, whatever the sign of g would be
  const bool slipping = c->state->mode <= TF_SLIP_MINUS;
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    const bool sticks = mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
    if (slipping && sticks && !(s.attracting & TF_MODE_BIT(mode))) continue;
    const forced_end_t end = mode_end(c, &s, mode);
    const outcome_t outcome = {.mode = mode};
    const tf_real_t residual =
        mode_residual(k, &outcome, end.force, end_slip(c, &end));
    if (!(residual < least)) continue;
    least = residual;
    best.outcome.mode = mode;
    best.end = end;
  }
  best.outcome.delassus = step_delassus(k, &in, end_slip(c, &best.end).g < 0);
  return best;
}

#endif
