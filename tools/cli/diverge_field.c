// The machine's equations for the host's own steppers, and the two-fold that
// stick runs through. In (r, p, z), p = v - d z, z = w - omega0, friction acts
// through a diagonal mass (DESIGN.md (13), (14)):
//   r' = v = p + d z,   m p' = Q_r + F sin gamma
//   m (beta^2 + r^2) z' = Q_phi + d Q_r + F r cos gamma + M
// On h = 0 with F = lambda, M = s kappa lambda: h' = N - A lambda.

#include <math.h>

#include "diverge.h"
#include "twofold/singularity.h"

cli_place_t cli_flow(const tf_machine_t *k, cli_place_t at, double F,
                     double M) {
  const double v = at.p + (double)k->d * at.z;
  const double w = at.z + (double)k->omega0;
  const double Q_r = (double)k->k2 * ((double)k->r0 - at.r) -
                     (double)k->c2 * v + (double)k->m * at.r * w * w;
  const double Q_phi = -(double)k->c1 * w - 2 * (double)k->m * at.r * v * w;
  const double J = (double)k->m * ((double)k->beta2 + at.r * at.r);
  const cli_place_t rate = {
      v, (Q_r + F * (double)k->sin_gamma) / (double)k->m,
      (Q_phi + (double)k->d * Q_r + F * at.r * (double)k->cos_gamma + M) / J};
  return rate;
}

tf_slip_t cli_place_slip(const tf_machine_t *k, cli_place_t at) {
  const double q = at.r * at.z;
  const tf_slip_t slip = {
      (tf_real_t)(-at.p * (double)k->sin_gamma - q * (double)k->cos_gamma),
      (tf_real_t)(q * (double)k->sin_gamma - at.p * (double)k->cos_gamma)};
  return slip;
}

tf_state_t cli_place_state(const tf_machine_t *k, cli_place_t at) {
  const tf_state_t state = {.r = (tf_real_t)at.r,
                            .v = (tf_real_t)(at.p + (double)k->d * at.z),
                            .w = (tf_real_t)(at.z + (double)k->omega0),
                            .mode = TF_MODES};
  return state;
}

cli_place_t cli_state_place(const tf_machine_t *k, const tf_state_t *state) {
  const double z = (double)state->w - (double)k->omega0;
  const cli_place_t at = {(double)state->r, (double)state->v - (double)k->d * z,
                          z};
  return at;
}

double cli_delassus(const tf_machine_t *k, double r, double g) {
  const double arm = r * (double)k->cos_gamma;
  const double kappa = g < 0 ? -(double)k->stick_kappa : (double)k->stick_kappa;
  return (double)k->sin_gamma * (double)k->sin_gamma / (double)k->m +
         arm * (arm + kappa) / ((double)k->m * ((double)k->beta2 + r * r));
}

cli_place_t cli_on_surface(const tf_machine_t *k, double r, double z) {
  const cli_place_t at = {
      r, -r * z * (double)k->cos_gamma / (double)k->sin_gamma, z};
  return at;
}

double cli_free_rate(const tf_machine_t *k, cli_place_t at) {
  const cli_place_t f = cli_flow(k, at, 0, 0);
  return -f.p * (double)k->sin_gamma -
         (f.r * at.z + at.r * f.z) * (double)k->cos_gamma;
}

void cli_sliding_field(const tf_machine_t *k, double r, double z, double s,
                       double out[2]) {
  const cli_place_t at = cli_on_surface(k, r, z);
  const double A = cli_delassus(k, r, s);
  const double N = cli_free_rate(k, at);
  const cli_place_t f = cli_flow(k, at, 0, 0);
  const double J = (double)k->m * ((double)k->beta2 + r * r);
  out[0] = A * f.r;
  out[1] =
      A * f.z + N * (r * (double)k->cos_gamma + s * (double)k->stick_kappa) / J;
}

bool cli_find_twofold(const tf_machine_t *k, cli_twofold_t *out) {
  const tf_input_t input = tf_input_default(k);
  tf_surface_point_t places[TF_TWO_FOLDS];
  tf_two_fold_t form;
  int count = 0;
  if (tf_two_folds(k, &input, places, &count, NULL) != TF_OK) {
    return false;
  }
  for (int i = 0; i < count; i++) {
    // Stick has to arrive along the weak direction, and to leave along it.
    if (tf_normal_form(k, &input, &places[i], &form) == TF_OK &&
        form.through.sticks && form.through.value < 0 &&
        form.across.value < form.through.value) {
      const cli_twofold_t found = {
          (double)form.point.r, (double)form.point.w, (double)form.point.g,
          (double)form.point.v,
          (double)form.through.velocity.w / (double)form.through.velocity.r};
      *out = found;
      return true;
    }
  }
  return false;
}

tf_state_t cli_before_twofold(const tf_machine_t *k,
                              const cli_twofold_t *twofold, double distance) {
  const double s = twofold->g < 0 ? -1 : 1;
  const double e =
      cli_delassus(k, twofold->r + distance, s) > 0 ? distance : -distance;
  tf_state_t state = cli_place_state(
      k,
      cli_on_surface(k, twofold->r + e,
                     twofold->omega - (double)k->omega0 + twofold->slope * e));
  state.mode = s < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
  return state;
}
