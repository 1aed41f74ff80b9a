// The core's equations of motion in double: next to a two-fold A and N are
// differences in which float has no digits.

#undef TF_REAL_FLOAT
#include "../../../src/model/rates.h"
#include "canard.h"

cli_field_t cli_wide_field_at(const cli_wide_t *given, cli_point_t at) {
  const tf_machine_t k = {CLI_WIDE(given),
                          .contact.stick_kappa = given->stick_kappa};
  const tf_input_t input = {.omega0 = k.omega0, .r0 = k.r0};
  const rates_t a = rates_at(&k, &input, at.r, at.p, at.z, k.omega0);
  const tf_slip_t slip = slip_from_pq(&k, at.p, at.r * at.z);
  const double arm = at.r * k.cos_gamma;
  return (cli_field_t){
      .rate = {slider_velocity(&k, at.p, at.z), a.dp, a.dz},
      .h = slip.h,
      .g = slip.g,
      .N = a.N,
      .A = {a.A[0], a.A[1]},
      .p_F = a.Fp,
      .stick_arm = {stick_arm(&k, arm, PLUS), stick_arm(&k, arm, MINUS)},
      .J = inertia_at(&k, at.r)};
}
