// The check of the parameters and what is derived from them.
#include <stddef.h>

#include "any.h"
#include "twofold/compensated.h"

// Any numbers; law: one that exists, or TF_TYRE_LAWS for any other.
static tf_params_t any_params(int law) {
  tf_params_t params;
  ANY_BITS(params);
  //@ loop unroll TF_PARAMETERS;
  for (int i = 0; i < TF_PARAMETERS; i++) *member_of(&params, i) = any_real();
  params.with_angle = any_bool();
  if (law < TF_TYRE_LAWS)
    params.law = (tf_tyre_law_t)law;
  else
    params.law = (tf_tyre_law_t)Frama_C_unsigned_int_interval(law, ~0u);
  return params;
}

// Any bits: no undefined behaviour, and none left once they were accepted.
ENTRY(prepare_any) {
  const int law = Frama_C_interval(0, TF_TYRE_LAWS);
  tf_compensated_t machine;
  tf_params_t params;
  int offender;
  //@ split law;
  params = any_params(law);
  tf_prepare(&machine.machine, &params, any_bool() ? &offender : NULL);
  tf_prepare_compensated(&machine, &params, any_bool() ? &offender : NULL);
  //@ check reached: \false;
}

static void accepted(tf_status_t status) {
  //@ check status == TF_OK;
  (void)status;
}

// All parameters in their ranges: accepted, and every number on the way is
// finite. The tangents of the angle kernel are far apart in size over the whole
// range of kappa, but not in a slice of it: so kappa goes slice by slice.
ENTRY(prepare_in_range) {
  tf_params_t params = params_in_range();
  tf_machine_t machine;
  //@ loop unroll TF_TYRE_LAWS;
  for (int law = 0; law < TF_TYRE_LAWS; law++) {
    if (law == TF_TYRE_JUMP || law == TF_TYRE_SMOOTH) continue;
    params.law = (tf_tyre_law_t)law;
    accepted(tf_prepare(&machine, &params, NULL));
  }
  params.law = any_bool() ? TF_TYRE_JUMP : TF_TYRE_SMOOTH;
  //@ loop unroll 50;
  for (tf_real_t low = TF_R(1e-9); low < TF_R(1e6); low *= 2) {
    params.kappa = REAL_BETWEEN(low, 2 * low < TF_R(1e6) ? 2 * low : TF_R(1e6));
    accepted(tf_prepare(&machine, &params, NULL));
  }
  //@ check reached: \false;
}
