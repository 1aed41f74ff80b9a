// Which futures an instant has on the surface h = 0.
#ifndef TF_CONSISTENT_H
#define TF_CONSISTENT_H

#include "../model/rates.h"
#include "twofold/friction.h"

// Solutions of an instant, for tf_select, and how slip leaves.
typedef struct {
  tf_solutions_t solutions;
  tf_real_t lambda[2]; // of stick+, stick-, where in the set
  tf_real_t T[2];      // cot(psi) along which slip+, slip- leave h = g = 0
  int roll[2];         // and the sign of g there
} tf_consistent_t;

// At g != 0; s: 0 where g > 0, 1 where g < 0.
TF_INLINE void surface_modes(const tf_machine_t *k, const tf_rates_t *a, int s,
                             tf_consistent_t *out) {
  const tf_real_t Amu = a->A[s] * k->tyre.mu;
  const bool plus = a->N - Amu > 0, minus = a->N + Amu < 0;
  const unsigned stick = TF_STICK_PLUS + (unsigned)s;
  tf_solutions_t *set = &out->solutions;
  *out = (tf_consistent_t){.lambda = {0, 0}};
  set->set = (uint8_t)(plus << TF_SLIP_PLUS | minus << TF_SLIP_MINUS);
  set->near_stick = (uint8_t)stick;
  set->h_limit[0] = a->N - Amu;
  set->h_limit[1] = a->N + Amu;
  if (a->A[s] > 0) set->attracting = (uint8_t)TF_MODE_BIT(stick);
  if (plus != minus) return;
  set->set |= (uint8_t)TF_MODE_BIT(stick);
  if (a->A[s] != 0) // the vertical line of a two-fold: any lambda, 0 the least
    out->lambda[s] = clip(a->N / a->A[s], -k->tyre.mu, k->tyre.mu);
}

#endif
