// The ends of a step that are off the common path and need no file of their
// own: under a single-valued law, in no mode, of a slip whose force turns.
#include "scheme.h"

// A port may leave the split out (SPLIT=no, docs/PORTS.md). What would be split
// is then of order 1, and TF_COARSE.
#ifndef TF_STEP_SPLITS
#define TF_STEP_SPLITS true
#endif

// The force of a single-valued law over a step, (11). No enumeration is needed,
// but the law may still be stiff in h. Such a law does not read the side.
static tf_force_t single_valued_law(const tf_machine_t *k, tf_slip_t at) {
  return tf_tyre_force(&k->contact.tyre, at.h, at.h, at.g);
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
  if (k->contact.tyre.law == TF_TYRE_NONE) return (tf_force_t){0, 0};
  const tf_force_t first = secant_force(c, start_slip(c));
  const tf_slip_t at =
      slip_at_theta_under(c, response_to(k, &c->linear, first));
  return secant_force(c, at);
}

// The end of the step, the mode that its slip has, and how far the force is
// from the law at the theta point.
static void single_valued_end(const free_motion_t *c, step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_force_t force = single_valued_force(c);
  const change_t change =
      has_friction(k) ? response_to(k, &c->linear, force) : (change_t){0, 0};
  to->end = end_under(c, force, change);
  const unsigned mode =
      slip_of_sign(tf_slip_of_end(c, &to->end).h, c->state->mode);
  to->outcome = (outcome_t){.mode = mode, .set = TF_MODE_BIT(mode)};
  if (!has_friction(k)) return;
  const tf_slip_t at = slip_at_theta_under(c, change);
  to->outcome.residual = magnitude(force.F - single_valued_law(k, at).F);
}

// Whether a force that turns changes the velocities by an amount that differs
// much from that of the force at the start: over the whole step or, of a slip
// that ends in it, up to h = 0.
static bool turns_much(const free_motion_t *c, const inclusion_t *in,
                       const step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_state_t *x = c->state;
  const bool ends = !is_slip(to->outcome.mode);
  const sign_t side = sign_in(ends ? x->mode : to->outcome.mode);
  multipliers_t m =
      slip_multipliers(&k->contact.tyre, side, start_slip(c), true);
  if (ends) {
    const tf_real_t slope = in->h.cx * m.x + in->h.cy * m.y;
    const tf_real_t share = clip(-in->h.c0 / slope, 0, 1);
    m = (multipliers_t){share * m.x, share * m.y};
  }
  const change_t first = change_by(c, m);
  const tf_real_t dp = to->end.friction.p - first.p;
  const tf_real_t dz = to->end.friction.z - first.z;
  return tf_changes_much(k, x, to->end.at, dp, dz, TF_TURN_SHARE);
}

// A slip that is reversed ends in a stick where it can. It is not TF_OK where
// an impulse reverses it and it is kept. Returns: whether that is so.
static bool end_reversed(const free_motion_t *c, const inclusion_t *in,
                         step_end_t *to) {
  const unsigned slip = to->outcome.mode;
  tf_contact_modes_t s = {0};
  const bool turns = turns_much(c, in, to);
  tf_enumerate(in, signs_of(&in->g), &s);
  // h comes to an attracting stick on the present side of g first.
  if (has(s.set & s.attracting, s.near_stick)) to->outcome.mode = s.near_stick;
  to->end = tf_mode_end(c, &s, to->outcome.mode);
  return to->outcome.mode == slip &&
         (turns || tf_step_changes_much(TF_STEP_MACHINE(c), c->state,
                                        to->end.at, TF_IMPULSE_SHARE));
}

// Whether a slip ends within its step and that changes the velocities by so
// much that the way there counts: its force turns up to h = 0.
static bool ends_by_impulse(const tf_machine_t *k, const tf_state_t *from,
                            const step_end_t *to) {
  return k->contact.stick_kappa > 0 &&
         ends_slip(from->mode, to->outcome.mode) &&
         tf_step_changes_much(k, from, to->end.at, TF_ENDING_SHARE);
}

// A slip whose force turns within the step, or that ends in it. One that the
// limit at h -> 0 holds on its side, where the force of its angle does not,
// ends where its course does, if that is in its mode. It is not TF_OK where it
// ends in stick or rest and by that changes much, and where its turn counts.
static void end_of_slip(end_kind_t kind, const free_motion_t *c,
                        const inclusion_t *in, step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const bool has_moment = k->contact.stick_kappa > 0;
  bool coarse = has_moment && (kind == END_REVERSED ? end_reversed(c, in, to)
                                                    : turns_much(c, in, to));
  if (has_moment && kind == END_HELD)
    (void)tf_end_along_course(c, in, TF_MODE_BIT(to->outcome.mode), to);
  to->outcome.delassus = end_delassus(c, in, signs_of(&in->g), &to->end);
  coarse |= ends_by_impulse(k, c->state, to);
  if (coarse) to->outcome.status = TF_COARSE;
}

static void set_valued_end(end_kind_t kind, free_motion_t *c, step_end_t *to) {
  inclusion_t in = inclusion(c);
  const bool lost =
      kind > END_NO_MODE && loses_slip(c->state->mode, to->outcome.mode);
  if (TF_STEP_SPLITS && lost && tf_split_end(c, &in, to)) return;
  add_pinned_point(c, &in);
  if (TF_STEP_MACHINE(c)->contact.stick_kappa > 0 && kind == END_CODIM2) {
    tf_codim2_end(c, &in, to);
  } else if (kind == END_NO_MODE) {
    tf_least_violation(c, &in, to->outcome.set, to);
  } else {
    end_of_slip(kind, c, &in, to);
    if (!TF_STEP_SPLITS && lost) to->outcome.status = TF_COARSE;
  }
}

TF_API tf_status_t tf_rare_end(end_kind_t kind, const tf_machine_t *k,
                               const tf_state_t *state, const tf_input_t *input,
                               const start_t *start, step_end_t *to) {
  if (kind != END_TO_CHECK || loses_slip(state->mode, to->outcome.mode)) {
    free_motion_t c = free_motion(k, state, input, *start);
    if (has_friction(k)) know_start_slip(&c);
    if (!c.linear.definite) return TF_STEP_TOO_LONG;
    if (!tf_tyre_is_set_valued(k->contact.tyre.law))
      single_valued_end(&c, to);
    else
      set_valued_end(kind, &c, to);
  }
  tf_checked_end(k, state, input, to);
  return to->outcome.status;
}
