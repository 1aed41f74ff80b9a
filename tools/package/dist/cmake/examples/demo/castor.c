/* The castor of a trolley that is pushed back, as docs/STUDIES.md derives it:
   it sticks until slip to either side is possible too (A < 0), and then slips
   to one side and the other in turn; where stick ends depends on dt. Prints
   each change of the mode or of the modes that are possible. */
#include <math.h>
#include <stdio.h>

#include "twofold.h"

/* The pin sideways and about itself; trail and speed; friction [SI]. */
static const double m = 4.3367, k = 740.8, c = 5.655, J = 0.000492, cp = 0.0223;
static const double e = 0.00445, V = 0.22395, mu = 13.24, kappa = 0.02724;
static const double dt = 1e-4;

static tf_slip_t slip_of(double v, double psi, double w) {
  const tf_slip_t slip = {(tf_real_t)(v * cos(psi) - V * sin(psi) - e * w),
                          (tf_real_t)(V * cos(psi) + v * sin(psi))};
  return slip;
}

int main(void) {
  const double dt_m = dt / (m + dt * c + dt * dt * k),
               dt_J = dt / (J + dt * cp);
  double y = 0.03, v = 0, psi = 2.9, w = -V * sin(psi) / e;
  unsigned mode = TF_NO_MODE, set = 0;
  tf_contact_t contact;
  if (tf_contact_prepare(&contact, TF_TYRE_JUMP, (tf_real_t)mu,
                         (tf_real_t)kappa, TF_REST_HULL, TF_RULE_PERSIST, 0))
    return 1;
  for (unsigned i = 0; i < 1000; i++) {
    const tf_slip_t now = slip_of(v, psi, w);
    /* The end of the step without friction; v and w by the multipliers. */
    v -= dt_m * (c * v + k * (y + dt * v));
    w -= dt_J * cp * w;
    const double at = psi + dt * w;
    const tf_slip_t end = slip_of(v, at, w);
    const double vx = -dt_m * mu * cos(at), wx = dt_J * mu * e;
    const double wy = dt_J * kappa * mu;
    const double hw = -e - dt * end.g, gw = dt * (end.h + e * w);
    const tf_form_t h = {
        end.h, (tf_real_t)(cos(at) * vx + hw * wx), (tf_real_t)(hw * wy), 0, 0,
        0};
    const tf_form_t g = {
        end.g, (tf_real_t)(sin(at) * vx + gw * wx), (tf_real_t)(gw * wy), 0, 0,
        0};
    tf_contact_modes_t modes;
    tf_force_t by;
    if (tf_contact_modes(&contact, &h, &g, now, mode, &modes, NULL)) return 2;
    const unsigned next = tf_contact_choose(&contact, &modes, mode, i, 1);
    if (tf_contact_force(&contact, &h, &g, &modes, next, now, &by)) return 3;
    if (next != mode || modes.set != set)
      printf("%.4f s %4.0f deg %s, %s\n", i * dt, psi * 57.29578,
             tf_mode_name(next),
             modes.set & (modes.set - 1) ? "of several" : "only");
    mode = next;
    set = modes.set;
    v += vx * by.F / mu;
    w += wx * by.F / mu + dt_J * by.M;
    y += dt * v;
    psi += dt * w;
  }
  return 0;
}
