// The ends of a step that are rare, as functions of their own: with an end, or
// with a status below TF_OK where the step is refused.
#ifndef TF_RARE_END_H
#define TF_RARE_END_H

#include "balance.h"
#include "stages.h"

// All members are set, because the struct is copied.
TF_INLINE void refuse_end(step_end_t *to) {
  *to = (step_end_t){.outcome = {.status = TF_STEP_TOO_LONG}};
}

// (11), under a single-valued law.
#define tf_single_valued_end TF_LINK(tf_single_valued_end)
TF_API void tf_single_valued_end(const tf_machine_t *k, const tf_state_t *state,
                                 const tf_input_t *input, start_t start,
                                 step_end_t *to);

// At h = g = 0, or near it with the mode lost; see codim2_end.c.
#define tf_codim2_end TF_LINK(tf_codim2_end)
TF_API void tf_codim2_end(free_motion_t *c, const tf_input_t *input,
                          inclusion_t *in, solutions_t *s, step_end_t *to);

// Where no mode is consistent, or none that a slip may enter: of all ends that
// the step may take, the one that violates the law least.
#define tf_least_violation TF_LINK(tf_least_violation)
TF_API void tf_least_violation(free_motion_t *c, inclusion_t *in,
                               const solutions_t *s, step_end_t *to);

// Whether a force that swings changes the velocities by an amount that differs
// much from that of the force at the start: over the whole step or, of a slip
// that ends in it, up to h = 0.
TF_INLINE bool swings_much(const free_motion_t *c, const inclusion_t *in,
                           const step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_state_t *x = c->state;
  const bool ends = to->outcome.mode > TF_SLIP_MINUS;
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
                      TF_SWING_SHARE);
}

// A slip whose force swings within the step, see slip_end(). A slip that is
// reversed ends in a stick where it can. It is not TF_OK where an impulse
// reverses it and it is kept, or where the swing counts.
TF_INLINE void end_swinging(const free_motion_t *c, const inclusion_t *in,
                            const solutions_t *s, step_end_t *to) {
  const tf_state_t *x = c->state;
  const unsigned slip = to->outcome.mode;
  bool coarse = swings_much(c, in, to);
  if (to->end.reverses) {
    const unsigned mode = mode_instead(s, slip);
    to->end = mode_end(c, s, mode);
    to->outcome.mode = mode;
    coarse =
        mode == slip &&
        (coarse || is_impulse(TF_STEP_MACHINE(c),
                              (end_state_t){x->r, x->v, x->w}, to->end.at));
  }
  if (coarse) to->outcome.status = TF_COARSE;
}

#endif
