/* A finger of two links with a roller at its tip, on a belt that runs along -x.
   Springs move its joints. Prints changes of the mode, then the angles [rad],
   heat and kinetic energy without a source [J], and the largest |h| at the end
   of a step that sticks [m/s]. Usage: arm [DT] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "twofold.h"

/* Links; inertias about joint 0, coupling, about joint 1; joints; belt [SI]. */
static const double l0 = 0.06, l1 = 0.04, I0 = 3e-4, Ic = 1e-4, I1 = 9e-5;
static const double K = 0.2, C = 1e-3, V = 0.1, mu = 0.5, kappa = 0.01;

/* h = n . (p' + V x), g = t . (p' + V x), and their slopes by u, then by q: the
   tip p rolls along t = (cos, sin)(q0 + q1); n is t turned left. */
static tf_slip_t slips(const double q[2], const double u[2], double h[4],
                       double g[4]) {
  const double to = q[0] + q[1], c = l0 * cos(q[1]), s = l0 * sin(q[1]);
  const tf_slip_t is = {(tf_real_t)((c + l1) * u[0] + l1 * u[1] - V * sin(to)),
                        (tf_real_t)(s * u[0] + V * cos(to))};
  h[0] = c + l1, h[1] = l1, h[2] = -V * cos(to), h[3] = h[2] - s * u[0];
  g[0] = s, g[1] = 0, g[2] = -V * sin(to), g[3] = g[2] + c * u[0];
  return is;
}

/* What u+ = u_f + by adds to a slip, as q+ = q + dt u+: (a + dt dh/dq) . by */
static tf_real_t added(const double a[4], const double by[2], double dt) {
  return (tf_real_t)((a[0] + dt * a[2]) * by[0] + (a[1] + dt * a[3]) * by[1]);
}

/* by = dt (M + dt C + dt^2 K)^-1 Q */
static void push(double q1, double dt, double Q0, double Q1, double by[2]) {
  const double soft = dt * (C + dt * K), b = I1 + Ic * cos(q1), d = I1 + soft;
  const double a = I0 + 2 * Ic * cos(q1) + soft, det = a * d - b * b;
  by[0] = dt * (d * Q0 - b * Q1) / det;
  by[1] = dt * (a * Q1 - b * Q0) / det;
}

int main(int argc, char **argv) {
  const double dt = argc > 1 ? atof(argv[1]) : 1e-4;
  double q[2] = {0, 0}, u[2] = {0, 0}, a[4], c[4], heat = 0, work = 0, h_of = 0;
  unsigned mode = TF_NO_MODE;
  tf_contact_t contact;
  if (tf_contact_prepare(&contact, TF_TYRE_JUMP, (tf_real_t)mu,
                         (tf_real_t)kappa, TF_REST_HULL, TF_RULE_PERSIST, 0))
    return 1;
  for (unsigned step = 0; step < 1.5 / dt - 0.5; step++) {
    const double to[2] = {0.5 * sin(6 * dt * step), -0.3}, q1 = q[1];
    const double v[2] = {u[0], u[1]}, s = Ic * sin(q1);
    const tf_slip_t now = slips(q, u, a, c);
    double x[2], y[2], by[2], end[2];
    double Q[2] = {s * (2 * u[0] + u[1]) * u[1], -s * u[0] * u[0]};
    for (unsigned i = 0; i < 2; i++)
      Q[i] -= K * (q[i] + dt * u[i] - to[i]) + C * u[i];
    /* The end of the step without friction, and what multipliers add. */
    push(q1, dt, Q[0], Q[1], by);
    for (unsigned i = 0; i < 2; i++) u[i] += by[i], end[i] = q[i] + dt * u[i];
    const tf_slip_t free = slips(end, u, a, c);
    push(q1, dt, -mu * a[0], -mu * a[1], x); /* F acts along -n */
    push(q1, dt, kappa * mu, kappa * mu, y); /* Mz turns q0 + q1 */
    const tf_form_t h = {free.h, added(a, x, dt), added(a, y, dt), 0, 0, 0};
    const tf_form_t g = {free.g, added(c, x, dt), added(c, y, dt), 0, 0, 0};
    tf_contact_modes_t modes;
    tf_force_t is;
    if (tf_contact_modes(&contact, &h, &g, now, mode, &modes, NULL)) return 2;
    const unsigned next = tf_contact_choose(&contact, &modes, mode, step, 1);
    if (tf_contact_force(&contact, &h, &g, &modes, next, now, &is)) return 3;
    if (next != mode) printf("%.4f s %s\n", dt * step, tf_mode_name(next));
    mode = next;
    for (unsigned i = 0; i < 2; i++) {
      u[i] += x[i] * is.F / mu + y[i] * is.M / (kappa * mu);
      q[i] += dt * u[i];
      work += dt * (K * (to[i] - q[i]) - C * u[i] - a[i] * is.F + is.M) *
              (v[i] + u[i]) / 2;
    }
    const double then = slips(q, u, a, c).h;
    heat += dt * is.F * then;
    if (!tf_mode_is_slip(mode)) h_of = fmax(h_of, fabs(then));
  }
  printf("%.6f %.6f %.3g %.3g %.3g\n", q[0], q[1], heat,
         (I0 / 2 + Ic * cos(q[1])) * u[0] * u[0] + I1 / 2 * u[1] * u[1] +
             (I1 + Ic * cos(q[1])) * u[0] * u[1] - work,
         h_of);
  return 0;
}
