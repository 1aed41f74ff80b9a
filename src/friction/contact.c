// The contact of a mechanism: its constants, the modes of a step, the force.
#include "twofold/contact.h"

#include "../num/kernel.h"
#include "codim2.h"
#include "inclusion.h"
#include "mode_set.h"
#include "tyre_law.h"

// The constants of a contact. No step calls this.

// T at the anchors from T(inf) = 6 kappa by halving and adding angles, then
// its Taylor series at 0 from (1 + y^2) T' = a (1 + T^2):
//   (2n+1) c_n = a [y^(2n)] T^2 - (2n-1) c_(n-1),   c_0 = a.
TF_API void tf_prepare_angle_kernel(tf_tyre_t *tyre, tf_real_t kappa) {
  tf_real_t *T = tyre->T_anchor;
  T[0] = 0;
  T[8] = 6 * kappa;
  T[4] = half_tangent(T[8]);
  T[2] = half_tangent(T[4]);
  T[1] = half_tangent(T[2]);
  T[3] = (T[2] + T[1]) / (1 - T[2] * T[1]);
  // Above pi/4 from T(inf) downwards: a sum of angles would multiply the
  // rounding of its terms by (1 + T^2)/T.
  T[5] = (T[8] - T[3]) / (1 + T[8] * T[3]);
  T[6] = (T[8] - T[2]) / (1 + T[8] * T[2]);
  T[7] = (T[8] - T[1]) / (1 + T[8] * T[1]);
  const tf_real_t a =
      tf_small_arctangent(half_tangent(T[1])) * TF_R(10.185916357881301489);
  tyre->T_series[0] = a;
  for (int n = 1; n < TF_TYRE_TERMS; n++) {
    const tf_real_t before = (tf_real_t)(2 * n - 1) * tyre->T_series[n - 1];
    tf_real_t square = 0;
    for (int i = 0; i < n; i++)
      square += tyre->T_series[i] * tyre->T_series[n - 1 - i];
    tyre->T_series[n] = (a * square - before) / (tf_real_t)(2 * n + 1);
  }
  tyre->inv_18_kappa = 1 / (18 * kappa);
  tyre->inv_6_kappa = 1 / (6 * kappa);
}

// Stick carries a moment unless friction counts as none: 1/mu is 0 then, and
// any force would pass as one that pins the wheel.
TF_API void tf_complete_contact(tf_contact_t *contact, tf_rest_law_t rest,
                                tf_rule_t rule, tf_real_t rate_dt) {
  const tf_real_t mu = contact->tyre.mu, kappa = contact->tyre.kappa;
  const bool carries_moment = contact->tyre.law == TF_TYRE_JUMP &&
                              inverse_or_0(mu) > 0 &&
                              inverse_or_0(kappa * mu) > 0;
  const tf_real_t p = tf_exit_probability(rate_dt);
  contact->stick_kappa = carries_moment ? kappa : 0;
  contact->kappa_mu = contact->stick_kappa * mu;
  contact->inv_mu = inverse_or_0(mu);
  contact->inv_kappa_mu = inverse_or_0(contact->kappa_mu);
  contact->exit_threshold = (uint64_t)(p * TF_R(9223372036854775808.0));
  contact->rest = rest;
  contact->rule = rule;
}

// NaN is in no range.
static bool is_in(tf_real_t x, tf_real_t low, tf_real_t high) {
  return x >= low && x <= high;
}

TF_API tf_status_t tf_contact_prepare(tf_contact_t *contact, tf_tyre_law_t law,
                                      tf_real_t mu, tf_real_t kappa,
                                      tf_rest_law_t rest, tf_rule_t rule,
                                      tf_real_t rate_dt) {
  const bool has_kappa = law == TF_TYRE_JUMP;
  if (!tf_tyre_is_set_valued(law) || (unsigned)rest >= TF_REST_LAWS ||
      (unsigned)rule >= TF_RULES || !is_in(mu, 0, TF_R(MAX_MU)) ||
      !is_in(rate_dt, 0, TF_R(MAX_RATE)) ||
      (has_kappa && !is_in(kappa, TF_R(MIN_KAPPA), TF_R(MAX_KAPPA))))
    return TF_BAD_PARAMETER;
  *contact = (tf_contact_t){.tyre = {.law = law, .mu = mu}};
  if (has_kappa) {
    contact->tyre.kappa = kappa;
    tf_prepare_angle_kernel(&contact->tyre, kappa);
  }
  tf_complete_contact(contact, rest, rule, rate_dt);
  return TF_OK;
}

// Enumeration and Newton's method off the common path of a step: functions that
// are small rather than fast.

TF_API void tf_enumerate(const inclusion_t *in, unsigned signs,
                         tf_contact_modes_t *out) {
  out->near_stick = nearer_stick(in, signs);
  if (signs == BOTH_SIGNS && in->has_moment)
    enumerate_both_signs(in, out);
  else
    enumerate_one_law(in, signs == MINUS_SIGN ? MINUS : PLUS, signs, out);
}

// One step of Newton's method on (8).
static void step_to(const tf_form_t *h, const tf_form_t *g, tf_slip_t to,
                    multipliers_t *m) {
  const tf_form_t at_h = form_about(h, *m), at_g = form_about(g, *m);
  const tf_real_t missed_h = at_h.c0 - to.h, missed_g = at_g.c0 - to.g;
  const tf_real_t det = at_h.cx * at_g.cy - at_h.cy * at_g.cx;
  m->x = m->x + (at_h.cy * missed_g - at_g.cy * missed_h) / det;
  m->y = m->y + (at_g.cx * missed_h - at_h.cx * missed_g) / det;
}

TF_API multipliers_t tf_multipliers_to(const tf_form_t *h, const tf_form_t *g,
                                       tf_slip_t to, multipliers_t guess) {
  multipliers_t m = guess;
  step_to(h, g, to, &m);
  step_to(h, g, to, &m);
  return m;
}

// A contact of any mechanism, by the parts of which tf_step is made: inclusion
// and enumeration, the law of slip, what follows h = g = 0. select.c has the
// choice.

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

// NaN and infinity survive into the sum.
static bool is_finite(const inclusion_t *in, tf_slip_t now) {
  const tf_real_t size = form_size(&in->h, 1, 1) + form_size(&in->g, 1, 1) +
                         magnitude(now.h) + magnitude(now.g);
  return within(size, TF_REAL_MAX);
}

// Of the zeros under which the wheel rests the one with the least |x|, and then
// the least |y|; without any, a point that is in no law.
static multipliers_t pin_of(const inclusion_t *in) {
  multipliers_t at[TF_MOST_ZEROS], pin = {TF_REAL_MAX, TF_REAL_MAX};
  const unsigned count = tf_common_zeros(&in->h, &in->g, at);
  for (unsigned i = 0; i < count; i++) {
    const tf_real_t by_x = magnitude(pin.x) - magnitude(at[i].x);
    const tf_real_t by_y = magnitude(pin.y) - magnitude(at[i].y);
    if (rests_under(in->rest, at[i].x, at[i].y) &&
        (by_x > 0 || (by_x == 0 && by_y > 0)))
      pin = at[i];
  }
  return pin;
}

TF_API tf_status_t tf_contact_modes(const tf_contact_t *contact,
                                    const tf_form_t *h, const tf_form_t *g,
                                    tf_slip_t now, unsigned mode,
                                    tf_contact_modes_t *modes,
                                    bool *reaches_codim2) {
  inclusion_t in = inclusion_under(contact, h, g, now.g);
  if (mode > TF_NO_MODE || !is_finite(&in, now)) return TF_BAD_STATE;
  if (drives_itself(contact, h->cx, h->cy)) return TF_BAD_PARAMETER;
  const unsigned signs = signs_of(&in.g);
  if (in.has_moment && signs == BOTH_SIGNS) {
    const multipliers_t pin = pin_of(&in);
    in.pin_x = pin.x;
    in.pin_y = pin.y;
  }
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

// In slip under the force at h -> 0; those of a pin are never read.
static multipliers_t multipliers_of(const tf_contact_modes_t *modes,
                                    unsigned mode) {
  const sign_t s = sign_in(mode);
  return is_slip(mode) ? limit_multipliers(s, modes->tau[s])
                       : stick_multipliers(modes->x[s], s);
}

TF_API multipliers_t tf_mode_multipliers(const tf_contact_t *contact,
                                         const tf_form_t *h, const tf_form_t *g,
                                         const tf_contact_modes_t *modes,
                                         unsigned mode) {
  const inclusion_t in = inclusion_under(contact, h, g, 0);
  return mode == TF_PINNED ? pin_of(&in) : multipliers_of(modes, mode);
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
    const multipliers_t m = tf_mode_multipliers(contact, h, g, modes, mode);
    if (slip == TF_PINNED && !rests_under(in.rest, m.x, m.y))
      return TF_BAD_STATE;
    *force = force_under(contact, m);
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

TF_API const char *tf_mode_name(unsigned mode) {
  static const char *const names[TF_MODES] = {"slip+", "slip-", "stick+",
                                              "stick-", "pinned"};
  return mode < TF_MODES ? names[mode] : "unknown mode";
}

TF_API const char *tf_rule_name(unsigned rule) {
  static const char *const names[TF_RULES] = {"persist", "slip+", "slip-",
                                              "random"};
  return rule < TF_RULES ? names[rule] : "unknown rule";
}

TF_API const char *tf_rest_law_name(unsigned law) {
  static const char *const names[TF_REST_LAWS] = {"hull", "square", "bow_tie"};
  return law < TF_REST_LAWS ? names[law] : "unknown law of rest";
}
