// The stick that runs through the two-fold and on in the escaping region.
//
// Backward in time the escaping region leads all sticks into the two-fold,
// along its weak direction; forward they part from that direction like the
// distance to the power of the ratio of the eigenvalues (14.02 in `chaos`). So
// no step by step method can follow this stick: its own rounding is thrown to
// |lambda| = mu within milliseconds. But it is an analytic curve z(r), regular
// through the point, and is solved for as a polynomial (collocation at
// Chebyshev points, Newton's method):
//   A v z'(r) = A z_free(r, z) + N(r, z) z_lambda(r)
// which at the two-fold is 0 = 0 and is divided by its distance elsewhere.

#include <math.h>
#include <string.h>

#include "diverge.h"

#define TERMS CLI_STICK_TERMS
#define NEWTON 12
#define HALF_PI 1.5707963267948966
#define STEP 1e-3 // [s], of the motion along the curve

static double stick_value(const cli_stick_t *stick, double r, double *slope) {
  const double x = (r - stick->r) / stick->reach;
  double z = 0, dz = 0;
  for (int n = TERMS - 1; n >= 0; n--) {
    dz = dz * x + z;
    z = z * x + stick->c[n];
  }
  // z so far is the sum of c[n] x^n; the curve is z* + x times it.
  *slope = (z + x * dz) / stick->reach;
  return stick->z + x * z;
}

static void residuals(const tf_machine_t *k, const cli_stick_t *stick,
                      double out[TERMS]) {
  for (int i = 0; i < TERMS; i++) {
    const double x = cos(HALF_PI * (2 * i + 1) / TERMS);
    // Points of an even number: none of them is the two-fold.
    const double r = stick->r + stick->reach * x;
    double slope = 0;
    double field[2];
    const double z = stick_value(stick, r, &slope);
    cli_sliding_field(k, r, z, stick->s, field);
    out[i] = (field[0] * slope - field[1]) / x;
  }
}

// Solves a x = b in place by elimination with pivots; returns whether it could.
static bool solve(double a[TERMS][TERMS], double b[TERMS]) {
  for (int i = 0; i < TERMS; i++) {
    int pivot = i;
    for (int j = i + 1; j < TERMS; j++) {
      pivot = fabs(a[j][i]) > fabs(a[pivot][i]) ? j : pivot;
    }
    if (!(fabs(a[pivot][i]) > 0)) {
      return false;
    }
    for (int j = 0; j < TERMS; j++) {
      const double t = a[i][j];
      a[i][j] = a[pivot][j];
      a[pivot][j] = t;
    }
    const double t = b[i];
    b[i] = b[pivot];
    b[pivot] = t;
    for (int j = i + 1; j < TERMS; j++) {
      const double f = a[j][i] / a[i][i];
      for (int n = i; n < TERMS; n++) {
        a[j][n] -= f * a[i][n];
      }
      b[j] -= f * b[i];
    }
  }
  for (int i = TERMS - 1; i >= 0; i--) {
    for (int j = i + 1; j < TERMS; j++) {
      b[i] -= a[i][j] * b[j];
    }
    b[i] /= a[i][i];
  }
  return true;
}

bool cli_stick_through(const tf_machine_t *k, const cli_twofold_t *twofold,
                       cli_stick_t *stick) {
  double last = (double)INFINITY;
  memset(stick, 0, sizeof *stick);
  stick->machine = k;
  stick->r = twofold->r;
  stick->z = twofold->omega - (double)k->omega0;
  stick->s = twofold->g < 0 ? -1 : 1;
  // As far as g keeps its sign on the tangent, and some more.
  stick->reach =
      fmin(1.05 * fabs(stick->z / twofold->slope), 0.5 * fabs(stick->r));
  stick->c[0] = twofold->slope * stick->reach;
  for (int i = 0; i < NEWTON; i++) {
    double a[TERMS][TERMS], at[TERMS], beside[TERMS];
    residuals(k, stick, at);
    double size = 0;
    for (int n = 0; n < TERMS; n++) {
      size = fmax(size, fabs(at[n]));
    }
    if (!(size < last)) {
      return last < 1e-9 * fabs(twofold->v * stick->c[0]);
    }
    last = size;
    for (int n = 0; n < TERMS; n++) {
      const double c = stick->c[n];
      const double e = 1e-6 * (1 + fabs(c));
      stick->c[n] = c + e;
      residuals(k, stick, beside);
      stick->c[n] = c;
      for (int j = 0; j < TERMS; j++) {
        a[j][n] = (beside[j] - at[j]) / e;
      }
    }
    if (!solve(a, at)) {
      return false;
    }
    for (int n = 0; n < TERMS; n++) {
      stick->c[n] -= at[n];
    }
  }
  return true;
}

static double speed(const cli_stick_t *stick, double r) {
  double slope = 0;
  const double z = stick_value(stick, r, &slope);
  return cli_flow(stick->machine, cli_on_surface(stick->machine, r, z), 0, 0).r;
}

bool cli_stick_after(const cli_stick_t *stick, double t, cli_place_t *at,
                     double *reached) {
  const tf_machine_t *k = stick->machine;
  double r = stick->r, done = 0, slope = 0;
  *at = cli_on_surface(k, r, stick->z);
  while (done < t) {
    const double dt = fmin(STEP, t - done);
    const double a = speed(stick, r);
    const double b = speed(stick, r + dt / 2 * a);
    const double c = speed(stick, r + dt / 2 * b);
    const double d = speed(stick, r + dt * c);
    const double next = r + dt / 6 * (a + 2 * b + 2 * c + d);
    const double z = stick_value(stick, next, &slope);
    const cli_place_t there = cli_on_surface(k, next, z);
    const double A = cli_delassus(k, next, stick->s);
    const bool open =
        fabs(cli_free_rate(k, there)) < fabs(A) * (double)k->tyre.mu &&
        stick->s * (double)cli_place_slip(k, there).g > 0 &&
        fabs(next - stick->r) < stick->reach;
    if (!open) {
      *reached = done;
      return false;
    }
    *at = there;
    r = next;
    done += dt;
  }
  *reached = t;
  return true;
}
