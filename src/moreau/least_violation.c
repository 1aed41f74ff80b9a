#include "rare_end.h"

TF_API void tf_least_violation(free_motion_t *c, inclusion_t *in,
                               const solutions_t *s, step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  add_pinned_point(c, in);
  to->end = pinned_end(c);
  to->outcome =
      (outcome_t){.mode = TF_PINNED, .set = s->set, .status = TF_DEGRADED};
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
    to->outcome.mode = mode;
    to->end = end;
  }
  to->outcome.delassus = step_delassus(k, in, end_slip(c, &to->end).g < 0);
}
