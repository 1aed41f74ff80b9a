// Entry points of the set-valued friction for others than the step.
#include "friction_core.h"

TF_API void tf_friction_solve(const tf_inclusion_t *in, tf_solutions_t *out) {
  const unsigned s = in->signs >> 1;
  out->set = 0;
  out->attracting = 0;
  out->near_stick = in->g_now >= 0 ? TF_STICK_PLUS : TF_STICK_MINUS;
  if (in->signs == 3)
    solve_both_signs(in, out);
  else
    out->set = (uint8_t)solve_one_sign(in->mu, in->h_free, in->h1[s], in->h2[s],
                                       s, out);
}

TF_API tf_real_t tf_law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g) {
  return law_residual(mu, kappa, force, h, g);
}
