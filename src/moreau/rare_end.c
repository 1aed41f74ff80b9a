// The ends of a step that are off the common path and need no file of their
// own: under a single-valued law, in no mode, of a slip whose force turns.
#include "rare_end.h"

#include "scheme.h"

// All members are set, because the struct is copied.
static void refuse_end(step_end_t *to) {
  *to = (step_end_t){.outcome = {.status = TF_STEP_TOO_LONG}};
}

// The force of a single-valued law over a step, (11). No enumeration is needed,
// but the law may still be stiff in h. Such a law does not read the side.
static tf_force_t single_valued_law(const tf_machine_t *k, tf_slip_t at) {
  return tf_tyre_force(&k->tyre, at.h, at.h, at.g);
}

static tf_slip_t slip_at_theta_under(const free_motion_t *c,
                                     change_t friction) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  return slip_at_theta(k, &c->linear, turn_after_theta(k, c->input),
                       r_at_theta(k, c->state->r, c->state->v), friction);
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
static __attribute__((noinline)) void single_valued_end(const tf_machine_t *k,
                                                        const tf_state_t *state,
                                                        const tf_input_t *input,
                                                        start_t start,
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
  const bool slipping = is_slip(c->state->mode);
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    const bool sticks = is_stick(mode);
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

// Whether a force that turns changes the velocities by an amount that differs
// much from that of the force at the start: over the whole step or, of a slip
// that ends in it, up to h = 0.
static bool turns_much(const free_motion_t *c, const inclusion_t *in,
                       const step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_state_t *x = c->state;
  const bool ends = !is_slip(to->outcome.mode);
  const unsigned slip = ends ? x->mode : to->outcome.mode;
  const tf_real_t side = slip == TF_SLIP_MINUS ? TF_R(-1.0) : 1;
  multipliers_t m = slip_multipliers(&k->tyre, side, start_slip(c));
  if (ends) {
    const tf_real_t slope = in->h.cx * m.x + in->h.cy * m.y;
    const tf_real_t share = clip(-in->h.c0 / slope, 0, 1);
    m = (multipliers_t){share * m.x, share * m.y};
  }
  const change_t first = change_by(c, m);
  const tf_real_t dp = to->end.friction.p - first.p;
  const tf_real_t dz = to->end.friction.z - first.z;
  return changes_much(k, (end_state_t){x->r, x->v, x->w}, to->end.at, dp, dz,
                      TF_TURN_SHARE);
}

// A slip whose force turns within the step, see slip_end(). A slip that is
// reversed ends in a stick where it can. It is not TF_OK where an impulse
// reverses it and it is kept, or where that counts.
static void end_turning(free_motion_t *c, inclusion_t *in, const solutions_t *s,
                        step_end_t *to) {
  const tf_state_t *x = c->state;
  const unsigned slip = to->outcome.mode;
  bool coarse = turns_much(c, in, to);
  if (to->end.held && !to->end.reverses && in->has_moment)
    tf_slip_along_course(c, in, s, to);
  if (to->end.reverses) {
    const unsigned mode = mode_after_reversal(s, slip);
    to->end = mode_end(c, s, mode);
    to->outcome.mode = mode;
    coarse =
        mode == slip &&
        (coarse || is_impulse(TF_STEP_MACHINE(c),
                              (end_state_t){x->r, x->v, x->w}, to->end.at));
  }
  if (coarse) to->outcome.status = TF_COARSE;
}

// Whether a slip ends within its step and that changes the velocities by so
// much that the way there counts: its force turns up to h = 0.
static bool ends_by_impulse(const tf_machine_t *k, const tf_state_t *from,
                            const step_end_t *to) {
  const end_state_t at = to->end.at;
  const tf_real_t dw = at.w - from->w;
  return k->stick_kappa > 0 && ends_slip(from->mode, to->outcome.mode) &&
         changes_much(k, (end_state_t){from->r, from->v, from->w}, at,
                      ground_speed(k, at.v - from->v, dw), dw, TF_COURSE_SHARE);
}

TF_API step_end_t tf_rare_end(const tf_machine_t *k, const tf_state_t *state,
                              const tf_input_t *input, start_t start) {
  free_motion_t c;
  inclusion_t in;
  solutions_t s;
  unsigned signs;
  step_end_t to;
  const end_kind_t kind =
      end_of_step(k, state, input, start, &c, &in, &s, &signs, &to);
  const bool may_follow = kind == END_TURNING || kind == END_TO_CHECK;
  switch (kind) {
    case END_SINGLE_VALUED:
      single_valued_end(k, state, input, start, &to);
      break;
    case END_TOO_LONG:
      refuse_end(&to);
      break;
    case END_CODIM2:
      tf_codim2_end(&c, &in, &s, &to);
      break;
    case END_NO_MODE:
      tf_least_violation(&c, &in, &s, &to);
      break;
    case END_TURNING:
      end_turning(&c, &in, &s, &to);
      to.outcome.delassus = end_delassus(&c, &in, signs, &to.end);
      break;
    case END_TO_CHECK:
    case END_COMMON:
    default:
      if (ends_slip(state->mode, to.outcome.mode) && turns_much(&c, &in, &to))
        to.outcome.status = TF_COARSE;
      break;
  }
  if (may_follow && ends_by_impulse(k, state, &to))
    tf_end_along_course(&c, &in, &s, &to);
  if (to.outcome.status >= TF_OK && needs_check(k, state, input, &to))
    return tf_checked_end(k, state, input, to);
  return to;
}
