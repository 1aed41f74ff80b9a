// Entry points of the set-valued friction for others than the step.
#include "inclusion.h"

TF_API unsigned tf_friction_signs(const tf_inclusion_t *in) {
  return signs_of(&in->g);
}

TF_API void tf_friction_solve(const tf_inclusion_t *in, tf_solutions_t *out) {
  enumerate(in, signs_of(&in->g), out);
}

TF_API tf_real_t tf_law_residual(tf_real_t mu, tf_real_t kappa,
                                 tf_force_t force, tf_real_t h, tf_real_t g) {
  return law_residual(mu, kappa, force, h, g);
}

TF_API const char *tf_mode_name(unsigned mode) {
  static const char *const names[TF_MODES] = {"slip+", "slip-", "stick+",
                                              "stick-", "pinned"};
  return mode < TF_MODES ? names[mode] : "unknown mode";
}
