// The modes that are consistent at an instant on the surface h = 0.
#ifndef TF_CONSISTENT_H
#define TF_CONSISTENT_H

#include "../model/rates.h"
#include "inclusion.h"

// The consistent modes of an instant, as tf_select reads them, and how each
// slip leaves.
typedef struct {
  solutions_t solutions;
  tf_real_t lambda[2]; // of stick+ and stick-, where they are in the set
  tf_real_t T[2];      // cot(psi) along which slip+, slip- leave h = g = 0
  int sign_g[2];       // and the sign of g there
} consistent_modes_t;

// g' in stick with the sign of g of s, under lambda.
TF_INLINE tf_real_t g_rate_in_stick(const tf_machine_t *k, const rates_t *a,
                                    int s, tf_real_t lambda) {
  const tf_real_t moment = signed_kappa(k, s) * lambda;
  return slip_from_pq(k, a->dp + lambda * a->Fp,
                      a->dq + lambda * a->Fq + moment * a->Mq)
      .g;
}

// The regions of h = 0 at g != 0: both slips lead to it (stick alone is
// consistent), both lead away (all three are), or one crosses it. s: 0 where
// g > 0, 1 where g < 0.
TF_INLINE void surface_modes(const tf_machine_t *k, const rates_t *a, int s,
                             consistent_modes_t *out) {
  const slip_limits_t h_rate = slip_limits(k, a, s);
  const bool plus = h_rate.plus > 0, minus = h_rate.minus < 0;
  const unsigned stick = TF_STICK_PLUS + (unsigned)s;
  solutions_t *solutions = &out->solutions;
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
