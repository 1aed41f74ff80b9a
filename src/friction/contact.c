// A contact of any mechanism, by the parts of which tf_step is made: inclusion
// and enumeration, the law of slip, what follows h = g = 0. prepared.c has its
// constants, select.c the choice.
#include "twofold/contact.h"

#include "codim2.h"
#include "mode_set.h"

// The inclusion of a step: without a moment there is no y.
static inclusion_t inclusion_under(const tf_contact_t *contact,
                                   const tf_form_t *h, const tf_form_t *g,
                                   tf_real_t g_now) {
  inclusion_t in = {.h = *h,
                    .g = *g,
                    .g_now = g_now,
                    .has_moment = contact->stick_kappa > 0,
                    .rest = contact->rest};
  if (in.has_moment) return in;
  in.h.cy = in.h.cxy = in.h.cyy = 0;
  in.g.cy = in.g.cxy = in.g.cyy = 0;
  return in;
}

static tf_real_t size_of_form(const tf_form_t *f) {
  return magnitude(f->c0) + magnitude(f->cx) + magnitude(f->cy) +
         magnitude(f->cxx) + magnitude(f->cxy) + magnitude(f->cyy);
}

// NaN and infinity survive into the sum.
static bool is_finite(const inclusion_t *in, tf_slip_t now) {
  return within(size_of_form(&in->h) + size_of_form(&in->g) + magnitude(now.h) +
                    magnitude(now.g),
                TF_REAL_MAX);
}

static multipliers_t pin_of(const inclusion_t *in) {
  const multipliers_t none = {0, 0};
  return tf_multipliers_to(&in->h, &in->g, (tf_slip_t){0, 0}, none);
}

TF_API tf_status_t tf_contact_modes(const tf_contact_t *contact,
                                    const tf_form_t *h, const tf_form_t *g,
                                    tf_slip_t now, unsigned mode,
                                    tf_contact_modes_t *modes,
                                    bool *reaches_codim2) {
  inclusion_t in = inclusion_under(contact, h, g, now.g);
  if (mode > TF_NO_MODE || !is_finite(&in, now)) return TF_BAD_STATE;
  const unsigned signs = signs_of(&in.g);
  const multipliers_t pin = pin_of(&in);
  in.pin_x = pin.x;
  in.pin_y = pin.y;
  *modes = (tf_contact_modes_t){.set = 0};
  tf_enumerate(&in, signs, modes);
  if (reaches_codim2 != NULL)
    *reaches_codim2 =
        in.has_moment &&
        (mode == TF_PINNED ||
         (is_stick(mode) ? stick_reaches_codim2(mode, signs, modes->set)
                         : slip_reaches_codim2(&in.h, &in.g, now)));
  return TF_OK;
}

// In slip under the force at h -> 0; nobody asks for those of a pin.
static multipliers_t multipliers_of(const tf_contact_modes_t *modes,
                                    unsigned mode) {
  const sign_t s = sign_in(mode);
  return is_slip(mode) ? limit_multipliers(s, modes->tau[s])
                       : stick_multipliers(modes->x[s], s);
}

TF_API tf_status_t tf_contact_force(const tf_contact_t *contact,
                                    const tf_form_t *h, const tf_form_t *g,
                                    const tf_contact_modes_t *modes,
                                    unsigned mode, tf_slip_t at,
                                    tf_force_t *force) {
  const bool none = mode == TF_NO_MODE;
  const inclusion_t in = inclusion_under(contact, h, g, 0);
  if (!is_finite(&in, at) || mode > TF_NO_MODE ||
      !(none || has(modes->set, mode)))
    return TF_BAD_STATE;
  const unsigned slip = none ? slip_of_sign(at.h, TF_SLIP_PLUS) : mode;
  if (!is_slip(slip)) {
    *force = force_under(
        contact, slip == TF_PINNED ? pin_of(&in) : multipliers_of(modes, mode));
    return TF_OK;
  }
  const sign_t side = sign_in(slip);
  const multipliers_t m = slip_multipliers(&contact->tyre, side, at, true);
  const bool stays = none || with_sign(side, form_value(&in.h, m.x, m.y)) > 0;
  *force = force_under(contact, stays ? m : multipliers_of(modes, mode));
  return none ? TF_DEGRADED : TF_OK;
}

static codim2_field_t field_by(const tf_form_t *h, const tf_form_t *g) {
  const affine_t of_h = {h->c0, h->cx, h->cy}, of_g = {g->c0, g->cx, g->cy};
  return (codim2_field_t){of_h, of_g, balancing_multipliers(of_h, of_g)};
}

// The futures of h = g = 0, and the multipliers of the one that is taken.
static unsigned futures_of(const tf_contact_t *contact,
                           const codim2_field_t *field, unsigned from,
                           bool arrives, uint64_t tick, uint32_t seed,
                           tf_contact_modes_t *modes, multipliers_t *m) {
  consistent_modes_t found;
  tf_codim2_modes(contact, field, &found);
  *modes = found.solutions;
  for (unsigned i = 0; i < 2; i++) {
    const multipliers_t slip =
        tf_codim2_multipliers(contact, &found, TF_SLIP_PLUS + i);
    modes->tau[i] = slip.y / slip.x;
    modes->x[i] = found.lambda[i] * contact->inv_mu;
  }
  const unsigned mode =
      tf_leave_codim2(contact, field, from, arrives, tick, seed, &found);
  *m = is_slip(mode)       ? tf_codim2_multipliers(contact, &found, mode)
       : mode == TF_PINNED ? field->pin
                           : multipliers_of(modes, mode);
  return mode;
}

TF_API unsigned tf_contact_leave(const tf_contact_t *contact,
                                 const tf_form_t *h, const tf_form_t *g,
                                 unsigned from, bool arrives, uint64_t tick,
                                 uint32_t seed, tf_contact_modes_t *modes,
                                 tf_force_t *force) {
  const tf_form_t by_h = {h->c0, h->cx, h->cy, 0, 0, 0};
  const tf_form_t by_g = {g->c0, g->cx, g->cy, 0, 0, 0};
  const inclusion_t in = inclusion_under(contact, &by_h, &by_g, 0);
  unsigned mode = TF_NO_MODE;
  multipliers_t m;
  *modes = (tf_contact_modes_t){.set = 0};
  *force = (tf_force_t){0, 0};
  if (from > TF_NO_MODE || !is_finite(&in, (tf_slip_t){0, 0})) return mode;
  if (in.has_moment) {
    const codim2_field_t field = field_by(h, g);
    mode = futures_of(contact, &field, from, arrives, tick, seed, modes, &m);
  } else { // g = 0 is no border: all that may follow h = 0
    tf_enumerate(&in, BOTH_SIGNS, modes);
    mode = tf_contact_choose(contact, modes, arrives ? TF_NO_MODE : from, tick,
                             seed);
    m = multipliers_of(modes, mode);
  }
  if (mode != TF_NO_MODE) *force = force_under(contact, m);
  return mode;
}
