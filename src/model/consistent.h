// The law of the contact at an instant of the machine: the modes that are
// consistent on the surface h = 0, and the field at h = g = 0.
#ifndef TF_CONSISTENT_H
#define TF_CONSISTENT_H

#include "../friction/codim2.h"
#include "rates.h"

// h = g = 0 means p = 0 and r z = 0: the wheel turns with the turntable, or the
// slider passes the axis. Set to 0 is whichever of z and r changes r z now.
TF_INLINE void place_at_codim2(const rates_t *now, tf_real_t *r, tf_real_t *z) {
  if (now->vz > now->rz)
    *r = 0;
  else
    *z = 0;
}

// How h and g change at h = g = 0, at an instant.
#define tf_codim2_field_of TF_LINK(tf_codim2_field_of)
TF_API codim2_field_t tf_codim2_field_of(const tf_machine_t *k,
                                         const rates_t *rates);

// g' in the stick with one sign of g, under lambda.
TF_INLINE tf_real_t g_rate_in_stick(const tf_machine_t *k, const rates_t *a,
                                    sign_t s, tf_real_t lambda) {
  const tf_real_t moment = signed_kappa(k, s) * lambda;
  return slip_from_pq(k, a->dp + lambda * a->Fp,
                      a->dq + lambda * a->Fq + moment * a->Mq)
      .g;
}

// The regions of h = 0 at g != 0: both slips lead to it (stick alone is
// consistent), both lead away (all three are), or one crosses it.
TF_INLINE void surface_modes(const tf_machine_t *k, const rates_t *a, sign_t s,
                             consistent_modes_t *out) {
  const slip_limits_t h_rate = slip_limits(k, a, s);
  const bool plus = h_rate.plus > 0, minus = h_rate.minus < 0;
  const unsigned stick = stick_with(s);
  tf_contact_modes_t *solutions = &out->solutions;
  *out = (consistent_modes_t){.lambda = {0, 0}};
  solutions->set = (uint8_t)(plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS);
  solutions->near_stick = (uint8_t)stick;
  solutions->h_limit[0] = h_rate.plus;
  solutions->h_limit[1] = h_rate.minus;
  if (a->A[s] > 0) solutions->attracting = (uint8_t)TF_MODE_BIT(stick);
  if (plus != minus) return;
  solutions->set |= (uint8_t)TF_MODE_BIT(stick);
  // A = 0 is the vertical line of a two-fold: any lambda, 0 the smallest.
  if (a->A[s] != 0) out->lambda[s] = stick_lambda(k, a, s);
}

#endif
