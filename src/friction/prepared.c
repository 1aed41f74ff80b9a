// The constants of a contact. No step calls this.
#include "prepared.h"

#include "../num/kernel.h"

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
