// The canard: the stick that passes through the two-fold along its weak
// direction and goes on in the escaping region.
//
// In backward time every stick in the escaping region tends to the two-fold
// along the weak direction. In forward time they part from it like the distance
// to the power of the ratio of the eigenvalues (14.02 in `chaos`), so no time
// stepping method can follow the canard: within milliseconds rounding errors
// grow until |lambda| = mu. But it is an analytic curve z(r), regular at the
// two-fold, and is computed as a polynomial (collocation at Chebyshev points,
// Newton's method):
//   A v z'(r) = A z_free(r, z) + N(r, z) z_lambda(r)
// At the two-fold this reads 0 = 0; elsewhere it is divided by the distance to
// the two-fold.

#include "canard.h"

#include <math.h>
#include <string.h>

#include "../setup/modes.h"
#include "twofold/singularity.h"

#define TERMS CLI_CANARD_TERMS
#define NEWTON 12
#define HALF_PI 1.5707963267948966
#define STEP 1e-3 // [s], of the Runge-Kutta method along the curve

static double curve(const cli_canard_t *canard, double r, double *slope) {
  const double x = (r - canard->r) / canard->reach;
  double z = 0, dz = 0;
  for (int n = TERMS - 1; n >= 0; n--) {
    dz = dz * x + z;
    z = z * x + canard->c[n];
  }
  // Here z is the sum of c[n] x^n; the curve is z* + x times that sum.
  *slope = (z + x * dz) / canard->reach;
  return canard->z + x * z;
}

static void residuals(const tf_machine_t *k, const cli_canard_t *canard,
                      double out[TERMS]) {
  for (int i = 0; i < TERMS; i++) {
    const double x = cos(HALF_PI * (2 * i + 1) / TERMS);
    // The number of points is even, so none of them is the two-fold.
    const double r = canard->r + canard->reach * x;
    double slope = 0;
    double field[2];
    const double z = curve(canard, r, &slope);
    cli_sliding_field(k, r, z, canard->s, field);
    out[i] = (field[0] * slope - field[1]) / x;
  }
}

// Solves a x = b in place by elimination with partial pivoting.
// Returns: whether a is regular.
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

bool cli_canard_solve(const tf_machine_t *k, const cli_two_fold_t *two_fold,
                      cli_canard_t *canard) {
  double last = (double)INFINITY;
  memset(canard, 0, sizeof *canard);
  canard->machine = k;
  canard->r = two_fold->r;
  canard->z = two_fold->omega - (double)k->omega0;
  canard->s = two_fold->g < 0 ? -1 : 1;
  // A little further than g keeps its sign on the tangent.
  canard->reach =
      fmin(1.05 * fabs(canard->z / two_fold->slope), 0.5 * fabs(canard->r));
  canard->c[0] = two_fold->slope * canard->reach;
  for (int i = 0; i < NEWTON; i++) {
    double a[TERMS][TERMS], at[TERMS], changed[TERMS];
    residuals(k, canard, at);
    double size = 0;
    for (int n = 0; n < TERMS; n++) {
      size = fmax(size, fabs(at[n]));
    }
    if (!(size < last)) {
      return last < 1e-9 * fabs(two_fold->v * canard->c[0]);
    }
    last = size;
    for (int n = 0; n < TERMS; n++) {
      const double c = canard->c[n];
      const double e = 1e-6 * (1 + fabs(c));
      canard->c[n] = c + e;
      residuals(k, canard, changed);
      canard->c[n] = c;
      for (int j = 0; j < TERMS; j++) {
        a[j][n] = (changed[j] - at[j]) / e;
      }
    }
    if (!solve(a, at)) {
      return false;
    }
    for (int n = 0; n < TERMS; n++) {
      canard->c[n] -= at[n];
    }
  }
  return true;
}

static double speed(const cli_canard_t *canard, double r) {
  double slope = 0;
  const double z = curve(canard, r, &slope);
  return cli_vector_field(canard->machine,
                          cli_point_on_surface(canard->machine, r, z), 0, 0)
      .r;
}

bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached) {
  const tf_machine_t *k = canard->machine;
  double r = canard->r, done = 0, slope = 0;
  *at = cli_point_on_surface(k, r, canard->z);
  while (done < t) {
    const double dt = fmin(STEP, t - done);
    const double a = speed(canard, r);
    const double b = speed(canard, r + dt / 2 * a);
    const double c = speed(canard, r + dt / 2 * b);
    const double d = speed(canard, r + dt * c);
    const double next = r + dt / 6 * (a + 2 * b + 2 * c + d);
    const double z = curve(canard, next, &slope);
    const cli_point_t there = cli_point_on_surface(k, next, z);
    const double A = cli_delassus(k, next, canard->s);
    const bool open =
        fabs(cli_free_slip_rate(k, there)) < fabs(A) * (double)k->tyre.mu &&
        canard->s * (double)cli_slip_at(k, there).g > 0 &&
        fabs(next - canard->r) < canard->reach;
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

bool cli_find_two_fold(const tf_machine_t *k, cli_two_fold_t *out) {
  const tf_input_t input = tf_input_default(k);
  tf_surface_point_t points[TF_TWO_FOLDS];
  tf_two_fold_t form;
  int count = 0;
  if (tf_two_folds(k, &input, points, &count, NULL) != TF_OK) {
    return false;
  }
  for (int i = 0; i < count; i++) {
    // Stick has to arrive and to leave along the weak direction.
    if (tf_normal_form(k, &input, &points[i], &form) == TF_OK &&
        form.through.sticks && form.through.value < 0 &&
        form.across.value < form.through.value) {
      const cli_two_fold_t found = {
          (double)form.point.r, (double)form.point.w, (double)form.point.g,
          (double)form.point.v,
          (double)form.through.velocity.w / (double)form.through.velocity.r};
      *out = found;
      return true;
    }
  }
  return false;
}

tf_state_t cli_before_two_fold(const tf_machine_t *k,
                               const cli_two_fold_t *two_fold,
                               double distance) {
  const double s = two_fold->g < 0 ? -1 : 1;
  const double e =
      cli_delassus(k, two_fold->r + distance, s) > 0 ? distance : -distance;
  tf_state_t state =
      cli_state_at(k, cli_point_on_surface(k, two_fold->r + e,
                                           two_fold->omega - (double)k->omega0 +
                                               two_fold->slope * e));
  state.mode = (uint8_t)cli_stick_mode(s);
  return state;
}
