// The consistent modes at h = g = 0. The force of a slip depends there on the
// direction of the slip in the (g, h) plane alone, and a slip can begin or end
// in h = g = 0 only along a limit direction: one whose acceleration has no
// component across it (Antali and Stepan 2018, for extended Filippov systems).
#include "codim2.h"

#include "mode_set.h"
#include "rest_law.h"

static const search_t exits = {true, false, 0};

TF_API bool tf_codim2_attractor(const tf_contact_t *contact,
                                const codim2_field_t *field, sign_t sign_g,
                                sign_t sign_h, tf_real_t *T) {
  const quadrant_t q = tf_quadrant_of(&contact->tyre, field, sign_g, sign_h);
  const search_t last = {false, false, TF_REAL_MAX};
  limit_direction_t to = no_direction;
  tf_search_quadrant(&contact->tyre, &q, &last, &to);
  if (to.exists) *T = to.T;
  return to.exists;
}

// The best exit into the side h > 0 or h < 0, from both of its quadrants.
static void add_exit(const tf_contact_t *contact, const codim2_field_t *field,
                     sign_t sign_h, consistent_modes_t *out) {
  static const sign_t signs[2] = {MINUS, PLUS};
  limit_direction_t best = no_direction;
  for (int n = 0; n < 2; n++) {
    const quadrant_t q =
        tf_quadrant_of(&contact->tyre, field, signs[n], sign_h);
    if (tf_may_leave(&q, contact->tyre.T_anchor[TF_TYRE_ANCHORS - 1]))
      tf_search_quadrant(&contact->tyre, &q, &exits, &best);
  }
  if (!best.exists) return;
  const unsigned bit = TF_MODE_BIT(slip_with(sign_h));
  out->T[sign_h] = best.T;
  out->sign_g[sign_h] = best.sign_g;
  out->solutions.set |= (uint8_t)bit;
  if (best.is_attractor) out->solutions.attracting |= (uint8_t)bit;
  out->solutions.h_limit[sign_h] = with_sign(sign_h, best.speed);
}

// The stick with the sign s of g, if the law has the force that keeps h at 0
// and g gets that sign under it. Returns how fast g grows, 0 where it does not.
static tf_real_t add_stick(const tf_contact_t *contact,
                           const codim2_field_t *field, sign_t s,
                           consistent_modes_t *out) {
  tf_contact_modes_t *solutions = &out->solutions;
  const stick_t stick = stick_at(field, s);
  const uint8_t bit = (uint8_t)TF_MODE_BIT(stick_with(s));
  if (stick.attracts) solutions->attracting |= bit;
  if (!within(stick.x, 1) || !(stick.rate > 0)) return 0;
  solutions->set |= bit;
  out->lambda[s] = stick.x * contact->tyre.mu;
  return stick.rate;
}

TF_API void tf_codim2_modes(const tf_contact_t *contact,
                            const codim2_field_t *field,
                            consistent_modes_t *out) {
  *out = (consistent_modes_t){.solutions = {.set = 0}};
  add_exit(contact, field, PLUS, out);
  add_exit(contact, field, MINUS, out);
  const tf_real_t plus = add_stick(contact, field, PLUS, out);
  const tf_real_t minus = add_stick(contact, field, MINUS, out);
  out->solutions.near_stick = minus > plus ? TF_STICK_MINUS : TF_STICK_PLUS;
  if (rests_under(contact->rest, field->pin.x, field->pin.y))
    out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}

TF_API multipliers_t tf_codim2_multipliers(const tf_contact_t *contact,
                                           const consistent_modes_t *modes,
                                           unsigned mode) {
  const sign_t s = sign_in(mode);
  if (!is_slip(mode))
    return stick_multipliers(modes->lambda[s] * contact->inv_mu, s);
  return signed_multipliers(multipliers_at(&contact->tyre, modes->T[s]), s,
                            modes->sign_g[s]);
}

TF_API unsigned tf_leave_codim2(const tf_contact_t *contact,
                                const codim2_field_t *field, unsigned from,
                                bool arrives, uint64_t tick, uint32_t seed,
                                const consistent_modes_t *modes) {
  tf_contact_modes_t s = modes->solutions;
  // Where the law of stick holds the wheel, a stick that arrives goes on.
  if (arrives && !is_slip(from) &&
      rests_under(TF_REST_BOW_TIE, field->pin.x, field->pin.y))
    s.attracting |= (uint8_t)TF_MODE_BIT(TF_PINNED);
  const bool lost = arrives || (from != TF_PINNED && !has(s.set, from));
  return tf_contact_choose(contact, &s, lost ? TF_NO_MODE : from, tick, seed);
}
