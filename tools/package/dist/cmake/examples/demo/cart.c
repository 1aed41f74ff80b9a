/* Two castors as in castor.c on a body that moves sideways and turns. Prints
   changes of modes and their number, then y, a, psi, psi, energy [SI]. Usage:
   cart [DT [UNTIL [INDEX in the first of several modes [Y A PSI PSI]]]] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "twofold.h"

/* Body: y and its turn a. Castors. Speed, friction [SI]. */
static const double m = 4.3367, k = 740.8, c = 5.655, I = 0.3, ka = 50;
static const double J = 0.000492, cp = 0.0223, e = 0.00445, mu = 13.24;
static const double place[2] = {0.3, -0.2}, V = 0.22395, kappa = 0.02724;

static tf_slip_t slip_of(double u, double psi, double w) {
  const tf_slip_t slip = {(tf_real_t)(u * cos(psi) - V * sin(psi) - e * w),
                          (tf_real_t)(V * cos(psi) + u * sin(psi))};
  return slip;
}

int main(int argc, char **argv) {
  const double dt = argc > 1 ? atof(argv[1]) : 1e-4;
  const double until = argc > 2 ? atof(argv[2]) : 0.1;
  const double dt_m = dt / (m + dt * c + dt * dt * k);
  const double dt_I = dt / (I + dt * dt * ka);
  const double dt_J = dt / (J + dt * cp);
  double z[] = {0.03, 0.05, 2.9, 2.6}, v = 0, va = 0, *psi = z + 2;
  for (int j = 4; j < argc && j < 8; j++) z[j - 4] = atof(argv[j]);
  double w[2] = {-V * sin(psi[0]) / e, -V * sin(psi[1]) / e};
  uint8_t modes[2] = {TF_NO_MODE, TF_NO_MODE};
  unsigned count = 0, at = argc > 3 ? (unsigned)*argv[3] - 48 : 99;
  tf_contact_t contact[2];
  if (tf_contact_prepare(contact, TF_TYRE_JUMP, (tf_real_t)mu, (tf_real_t)kappa,
                         TF_REST_HULL, TF_RULE_PERSIST, 0))
    return 1;
  contact[1] = contact[0];
  for (unsigned step = 0; step < until / dt - 0.5; step++) {
    tf_real_t forms[2][2][TF_TERMS(2)] = {{{0}}};
    tf_slip_t now[2];
    tf_force_t by[2];
    tf_joint_mode_t found[TF_JOINT_ROOM(2)];
    for (unsigned i = 0; i < 2; i++)
      now[i] = slip_of(v + place[i] * va, psi[i], w[i]);
    /* The end of the step without friction, and what multipliers add. */
    v -= dt_m * (c * v + k * (z[0] + dt * v));
    va -= dt_I * ka * (z[1] + dt * va);
    for (unsigned i = 0; i < 2; i++) w[i] -= dt_J * cp * w[i];
    for (unsigned i = 0; i < 2; i++) {
      const double to = psi[i] + dt * w[i];
      const tf_slip_t end = slip_of(v + place[i] * va, to, w[i]);
      const double hw = -e - dt * end.g, gw = dt * (end.h + e * w[i]);
      tf_real_t *h = forms[i][0], *g = forms[i][1];
      h[0] = end.h, g[0] = end.g;
      for (unsigned j = 0; j < 2; j++) { /* F of j moves the pin of i */
        const double u =
            -mu * cos(psi[j] + dt * w[j]) * (dt_m + place[i] * place[j] * dt_I);
        h[1 + 2 * j] = (tf_real_t)(cos(to) * u + (i == j) * hw * dt_J * mu * e);
        g[1 + 2 * j] = (tf_real_t)(sin(to) * u + (i == j) * gw * dt_J * mu * e);
      }
      h[2 + 2 * i] = (tf_real_t)(hw * dt_J * kappa * mu);
      g[2 + 2 * i] = (tf_real_t)(gw * dt_J * kappa * mu);
    }
    if (tf_contacts_modes(2, contact, forms[0][0], now, found, TF_JOINT_ROOM(2),
                          &count) < 0)
      return 2;
    unsigned it = tf_contacts_choose(2, contact, found, count, modes, step, 1);
    if (count > 1 && at < count) it = at, at = 99;
    if (it == count ||
        tf_contacts_force(2, contact, forms[0][0], &found[it], now, by))
      return 3;
    const uint8_t *is = found[it].mode;
    if (is[0] != modes[0] || is[1] != modes[1])
      printf("%.5f s %s %s, of %u\n", step * dt, tf_mode_name(is[0]),
             tf_mode_name(is[1]), count);
    for (unsigned i = 0; i < 2; i++) {
      const double side = by[i].F * cos(psi[i] + dt * w[i]);
      modes[i] = is[i];
      v -= dt_m * side;
      va -= dt_I * place[i] * side;
      w[i] += dt_J * (e * by[i].F + by[i].M);
      psi[i] += dt * w[i];
    }
    z[0] += dt * v, z[1] += dt * va;
  }
  v = (m * v * v + I * va * va + J * (w[0] * w[0] + w[1] * w[1])) / 2;
  printf("%.9g %.9g %.9g %.9g %.9g\n", z[0], z[1], psi[0], psi[1],
         v + (k * z[0] * z[0] + ka * z[1] * z[1]) / 2);
  return 0;
}
