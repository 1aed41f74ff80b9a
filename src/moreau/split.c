// A step that loses its slip, in two parts: up to h = 0 and behind it. Moreau's
// step has the mean force of one mode, and so is of order 1 through a change of
// mode at which the force jumps. With the instant of the change known to order
// 2 and the force of either part to order 1 in dt, the impulse of the step is
// known to order 2, and with it the end. Where a stick ends the force does not
// jump: the step in slip is of order 2 as it is.
#include "scheme.h"

// The mean multipliers up to the change, which takes a share of the step, and
// the mode behind it.
typedef struct {
  multipliers_t mean;
  tf_real_t share;
  unsigned next;
} part_t;

static multipliers_t mean_of(multipliers_t a, multipliers_t b) {
  return (multipliers_t){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

static multipliers_t slip_at(const free_motion_t *c, sign_t side,
                             tf_slip_t at) {
  return slip_multipliers(&TF_STEP_MACHINE(c)->contact.tyre, side, at, true);
}

// What follows h = 0: the other slip if h grows on its side under its force,
// else stick. begin: the multipliers at the start.
static part_t part_of_slip(const free_motion_t *c, const inclusion_t *in,
                           sign_t sign_g, multipliers_t begin) {
  const tf_real_t h_now = start_slip(c).h;
  const quadratic_t h = along(&in->h, sign_g);
  const sign_t side = sign_in(c->state->mode), other = opposite(side);
  const tf_real_t beyond = (other == PLUS ? h.at_upper : h.at_lower) - h_now;
  part_t part = {.mean = mean_of(begin, limit_multipliers(side, unit(sign_g))),
                 .next = with_sign(other, beyond) > 0 ? slip_with(other)
                         : stick_attracts(&h)         ? stick_with(sign_g)
                                                      : TF_NO_MODE};
  part.share = h_now / (h_now - form_value(&in->h, part.mean.x, part.mean.y));
  return part;
}

// The multipliers of the step, with `then` behind the change.
static multipliers_t of_step(const part_t *part, multipliers_t then) {
  const tf_real_t share = part->share, rest = 1 - share;
  return (multipliers_t){share * part->mean.x + rest * then.x,
                         share * part->mean.y + rest * then.y};
}

// The multiplier of a stick behind the change that ends the step at h = 0.
static tf_real_t stick_behind(const tf_form_t *h, const part_t *part,
                              sign_t sign_g) {
  tf_real_t x = 0;
  for (int i = 0; i < 4; i++) {
    const tf_form_t at =
        form_about(h, of_step(part, stick_multipliers(x, sign_g)));
    x -= at.c0 / ((1 - part->share) * (at.cx + with_sign(sign_g, at.cy)));
  }
  return x;
}

// The end behind the change: in slip under the mean of the multipliers at
// h -> 0 and at the end, in stick under those that end the step at h = 0.
// Returns: whether that is an end in its mode.
static bool end_of_parts(const free_motion_t *c, const tf_form_t *h,
                         const part_t *part, sign_t sign_g, forced_end_t *end) {
  const sign_t side = sign_in(part->next);
  const bool slips = is_slip(part->next);
  const multipliers_t limit = limit_multipliers(side, unit(sign_g));
  multipliers_t then = limit;
  if (!slips) then = stick_multipliers(stick_behind(h, part, sign_g), sign_g);
  for (int i = 0; i < 2 && (i == 0 || slips); i++) {
    if (i > 0) then = mean_of(limit, slip_at(c, side, tf_slip_of_end(c, end)));
    *end = tf_end_by(c, of_step(part, then));
  }
  return slips ? with_sign(side, tf_slip_of_end(c, end).h) > 0
               : within(then.x, 1);
}

// Whether the force turns too much up to h = 0 for its mean to be known.
static bool part_turns(const free_motion_t *c, const part_t *part,
                       multipliers_t begin, end_state_t end) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_real_t twice = 2 * part->share;
  const change_t by =
      change_by(c, (multipliers_t){twice * (part->mean.x - begin.x),
                                   twice * (part->mean.y - begin.y)});
  return k->contact.stick_kappa > 0 &&
         tf_changes_much(k, c->state, end, by.p, by.z, TF_TURN_SHARE);
}

TF_API bool tf_split_end(const free_motion_t *c, const inclusion_t *in,
                         step_end_t *to) {
  const unsigned signs = signs_of(&in->g);
  const sign_t sign_g = signs == PLUS_SIGN ? PLUS : MINUS;
  if (signs == BOTH_SIGNS) return false;
  const multipliers_t begin =
      slip_at(c, sign_in(c->state->mode), start_slip(c));
  const part_t part = part_of_slip(c, in, sign_g, begin);
  forced_end_t end;
  if (part.next == TF_NO_MODE || !(part.share > 0 && part.share < 1) ||
      !end_of_parts(c, &in->h, &part, sign_g, &end))
    return false;
  to->end = end;
  to->outcome = (outcome_t){
      .mode = part.next,
      .set = TF_MODE_BIT(part.next),
      .status = part_turns(c, &part, begin, end.at) ? TF_COARSE : TF_OK,
      .delassus = step_delassus(TF_STEP_MACHINE(c), in, sign_g),
      .is_mean = true};
  return true;
}
