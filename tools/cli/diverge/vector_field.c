// The equations of motion in (r, p, z), p = v - d z, z = w - omega0, in which
// friction acts through a diagonal mass matrix (DESIGN.md (13), (14)):
//   r' = v = p + d z,   m p' = Q_r + F sin gamma
//   m (beta^2 + r^2) z' = Q_phi + d Q_r + F r cos gamma + M
// On h = 0 with F = lambda, M = s kappa lambda: h' = N - A lambda.

#include "vector_field.h"

// J [kg m^2], in double whatever the number type of the core.
static double inertia_at(const tf_machine_t *k, double r) {
  return (double)k->m * ((double)k->beta2 + r * r);
}

// J z' in stick, of lambda = 1 N; s: the sign of g.
static double stick_arm(const tf_machine_t *k, double r, double s) {
  return r * (double)k->cos_gamma + s * (double)k->stick_kappa;
}

cli_point_t cli_vector_field(const tf_machine_t *k, cli_point_t at, double F,
                             double M) {
  const double v = at.p + (double)k->d * at.z;
  const double w = at.z + (double)k->omega0;
  const double Q_r = (double)k->k2 * ((double)k->r0 - at.r) -
                     (double)k->c2 * v + (double)k->m * at.r * w * w;
  const double Q_phi = -(double)k->c1 * w - 2 * (double)k->m * at.r * v * w;
  const double J = inertia_at(k, at.r);
  return (cli_point_t){
      v, (Q_r + F * (double)k->sin_gamma) / (double)k->m,
      (Q_phi + (double)k->d * Q_r + F * at.r * (double)k->cos_gamma + M) / J};
}

tf_slip_t cli_slip_at(const tf_machine_t *k, cli_point_t at) {
  const double q = at.r * at.z;
  return (tf_slip_t){
      (tf_real_t)(-at.p * (double)k->sin_gamma - q * (double)k->cos_gamma),
      (tf_real_t)(q * (double)k->sin_gamma - at.p * (double)k->cos_gamma)};
}

tf_state_t cli_state_at(const tf_machine_t *k, cli_point_t at) {
  return (tf_state_t){.r = (tf_real_t)at.r,
                      .v = (tf_real_t)(at.p + (double)k->d * at.z),
                      .w = (tf_real_t)(at.z + (double)k->omega0),
                      .mode = TF_NO_MODE};
}

cli_point_t cli_point_of(const tf_machine_t *k, const tf_state_t *state) {
  const double z = (double)state->w - (double)k->omega0;
  return (cli_point_t){(double)state->r, (double)state->v - (double)k->d * z,
                       z};
}

double cli_delassus(const tf_machine_t *k, double r, double g) {
  return (double)k->sin_gamma * (double)k->sin_gamma / (double)k->m +
         r * (double)k->cos_gamma * stick_arm(k, r, g < 0 ? -1 : 1) /
             inertia_at(k, r);
}

cli_point_t cli_point_on_surface(const tf_machine_t *k, double r, double z) {
  return (cli_point_t){r, -r * z * (double)k->cos_gamma / (double)k->sin_gamma,
                       z};
}

double cli_slip_rate(const tf_machine_t *k, cli_point_t at, cli_point_t rate) {
  return -rate.p * (double)k->sin_gamma -
         (rate.r * at.z + at.r * rate.z) * (double)k->cos_gamma;
}

double cli_free_slip_rate(const tf_machine_t *k, cli_point_t at) {
  return cli_slip_rate(k, at, cli_vector_field(k, at, 0, 0));
}

void cli_sliding_field(const tf_machine_t *k, double r, double z, double s,
                       double out[2]) {
  const cli_point_t at = cli_point_on_surface(k, r, z);
  const double A = cli_delassus(k, r, s);
  const double N = cli_free_slip_rate(k, at);
  const cli_point_t f = cli_vector_field(k, at, 0, 0);
  out[0] = A * f.r;
  out[1] = A * f.z + N * stick_arm(k, r, s) / inertia_at(k, r);
}
