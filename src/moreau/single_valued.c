// The force of a single-valued law over a step, (11). No enumeration is needed,
// but the law may still be stiff in h.
#include "rare_end.h"

// A single-valued law does not read the side.
static tf_force_t single_valued_law(const tf_machine_t *k, tf_slip_t at) {
  return tf_tyre_force(&k->tyre, at.h, at.h, at.g);
}

static tf_slip_t slip_at_theta_under(const free_motion_t *c,
                                     change_t friction) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  return slip_at_theta(k, &c->linear, r_at_theta(k, c->state->r, c->state->v),
                       friction);
}

// (11): the secant F = c h at the predicted slip is taken implicitly where that
// damps (the end of the step responds with E < 0) and explicitly where it
// drives. The secant never extrapolates: |share| <= 1.
static tf_force_t secant_force(const free_motion_t *c, tf_slip_t at) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_real_t h_now = start_slip(c).h;
  const tf_force_t f = single_valued_law(k, at);
  if (at.h == 0) return f;
  const response_t a = response_at_end(k, response_to(k, &c->linear, f));
  const tf_real_t E = slip_response(k, &c->end, a).h / at.h;
  if (!(E < 0)) return f;
  const tf_real_t h =
      (h_now + k->theta * (c->slip.h - h_now)) / (1 - k->theta * E);
  const tf_real_t share = clip(h / at.h, -1, 1);
  return (tf_force_t){share * f.F, share * f.M};
}

// The force for a step: predicted from the start, corrected at the theta point.
static tf_force_t single_valued_force(const free_motion_t *c) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_force_t first = secant_force(c, start_slip(c));
  const tf_slip_t at =
      slip_at_theta_under(c, response_to(k, &c->linear, first));
  return secant_force(c, at);
}

// The end of the step, the mode that its slip has, and how far the force is
// from the law at the theta point.
TF_API void tf_single_valued_end(const tf_machine_t *k, const tf_state_t *state,
                                 const tf_input_t *input, start_t start,
                                 step_end_t *to) {
  const free_motion_t c = free_motion(k, state, input, start);
  if (!c.linear.definite) {
    refuse_end(to);
    return;
  }
  const tf_force_t force = single_valued_force(&c);
  const change_t change = response_to(k, &c.linear, force);
  const tf_slip_t at = slip_at_theta_under(&c, change);
  to->end = end_under(&c, force, change);
  const unsigned mode = slip_of_sign(end_slip(&c, &to->end).h, state->mode);
  to->outcome = (outcome_t){.mode = mode, .set = TF_MODE_BIT(mode)};
  to->outcome.residual = magnitude(force.F - single_valued_law(k, at).F);
}
