// The machine's equations for the host's own steppers, and the two-fold that
// stick runs through. In (r, p, z), p = v - d z, z = w - omega0, friction acts
// through a diagonal mass (DESIGN.md (13), (14)):
//   r' = v = p + d z,   m p' = Q_r + F sin gamma
//   m (beta^2 + r^2) z' = Q_phi + d Q_r + F r cos gamma + M
// On h = 0 with F = lambda, M = s kappa lambda: h' = N - A lambda. The two-fold
// is A = 0, a quadratic in r, and N = 0, a quadratic in z with p on h = 0.

#include <math.h>

#include "diverge.h"

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

// The place on h = 0 at (r, z).
cli_place_t cli_on_surface(const tf_machine_t *k, double r, double z) {
  const cli_place_t at = {
      r, -r * z * (double)k->cos_gamma / (double)k->sin_gamma, z};
  return at;
}

// h' without friction, at a place on h = 0.
double cli_free_rate(const tf_machine_t *k, cli_place_t at) {
  const cli_place_t f = cli_flow(k, at, 0, 0);
  return -f.p * (double)k->sin_gamma -
         (f.r * at.z + at.r * f.z) * (double)k->cos_gamma;
}

// The sliding field times A, which is regular at A = 0: (r', z').
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

// Roots of a x^2 + b x + c; returns how many.
static int roots(double a, double b, double c, double x[2]) {
  const double D = b * b - 4 * a * c;
  if (!(D >= 0) || (a == 0 && b == 0)) {
    return 0;
  }
  if (a == 0) {
    x[0] = -c / b;
    return 1;
  }
  const double q = -(b + copysign(sqrt(D), b)) / 2;
  x[0] = q / a;
  x[1] = q == 0 ? 0 : c / q;
  return D > 0 ? 2 : 1;
}

// Whether stick of sign s runs through (r, z): the linear part of the rescaled
// field attracts, and lambda of the weak direction is less than mu there.
static bool runs_through(const tf_machine_t *k, double r, double z, double s,
                         cli_twofold_t *out) {
  const double e = 1e-6;
  double a[2], b[2], c[2], d[2];
  const cli_place_t at = cli_on_surface(k, r, z);
  const double g = (double)cli_place_slip(k, at).g;
  if (!(s * g > 0)) {
    return false;
  }
  cli_sliding_field(k, r + e, z, s, a);
  cli_sliding_field(k, r - e, z, s, b);
  cli_sliding_field(k, r, z + e, s, c);
  cli_sliding_field(k, r, z - e, s, d);
  const double rr = (a[0] - b[0]) / (2 * e), zr = (a[1] - b[1]) / (2 * e);
  const double rz = (c[0] - d[0]) / (2 * e), zz = (c[1] - d[1]) / (2 * e);
  double rate[2];
  if (roots(1, -(rr + zz), rr * zz - rz * zr, rate) < 2) {
    return false;
  }
  const double weak = fmax(rate[0], rate[1]);
  // (rr - weak) dr + rz dz = 0; r' is A v, so that rz is 0 at A = 0.
  const double slope = zr / (weak - zz);
  const double dA =
      (cli_delassus(k, r + e, s) - cli_delassus(k, r - e, s)) / (2 * e);
  const double dN =
      (cli_free_rate(k, cli_on_surface(k, r + e, z + slope * e)) -
       cli_free_rate(k, cli_on_surface(k, r - e, z - slope * e))) /
      (2 * e);
  if (!(weak < 0) || !isfinite(slope) ||
      !(fabs(dN / dA) < (double)k->tyre.mu)) {
    return false;
  }
  const tf_state_t state = cli_place_state(k, at);
  const cli_twofold_t found = {r,     (double)state.w,
                               g,     (double)state.v,
                               slope, fmin(rate[0], rate[1]) / weak};
  *out = found;
  return true;
}

bool cli_find_twofold(const tf_machine_t *k, cli_twofold_t *out) {
  const double sin2 = (double)k->sin_gamma * (double)k->sin_gamma;
  if (!(fabs((double)k->sin_gamma) > 1e-6) || !((double)k->stick_kappa > 0)) {
    return false;
  }
  for (int s = 1; s >= -1; s -= 2) {
    double r[2];
    const int n = roots(1, s * (double)k->stick_kappa * (double)k->cos_gamma,
                        (double)k->beta2 * sin2, r);
    for (int i = 0; i < n; i++) {
      // N along z is a quadratic: three values give it.
      const double N0 = cli_free_rate(k, cli_on_surface(k, r[i], 0));
      const double N1 = cli_free_rate(k, cli_on_surface(k, r[i], 1));
      const double N2 = cli_free_rate(k, cli_on_surface(k, r[i], -1));
      double z[2];
      const int m = roots((N1 + N2) / 2 - N0, (N1 - N2) / 2, N0, z);
      for (int j = 0; j < m; j++) {
        if (runs_through(k, r[i], z[j], s, out)) {
          return true;
        }
      }
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
