// normal - orbits of stick next to the two-fold of the scene `chaos`, in the
// coordinates of the paper's normal form, for the figures:
//
//   normal orbits      true,xi,eta,dxi,deta  one a block: true 0 those of the
//                      normal form, true 1 those of the sliding field through
//                      the same points; dxi, deta is the way of an arrow, 0
//                      where there is none
//   normal directions  xi,eta  the two straight orbits, through and across
//   normal numbers     gnuplot assignments: J1, J2, unit [rad/s]
//
// xi = L- / (S sqrt(K--)), eta = -L+ / (S sqrt(-K++)), L+- = h_x . f(x, +-mu):
// sliding is xi, eta > 0, the axes are the tangencies themselves, and the stick
// motion is (J1 xi + eta, xi + J2 eta) to first order, times a positive
// number. S makes xi = 1 lie `unit` from the two-fold in omega.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "arrow.h"
#include "place.h"

static const double unit = 0.02; // [rad/s]

typedef struct {
  tf_machine_t machine;
  tf_input_t input;
  tf_two_fold_t fold;
  double a, b, c, d; // (r, omega) = two-fold + ((a, b), (c, d)) (xi, eta)
  double size;       // S
} chart_t;

static void coordinates(const chart_t *k, double r, double w, double out[2]) {
  const tf_surface_t at = surface_at(&k->machine, &k->input, r, w);
  out[0] = (double)at.lie_minus / sqrt((double)k->fold.Kmm) / k->size;
  out[1] = -(double)at.lie_plus / sqrt(-(double)k->fold.Kpp) / k->size;
}

// The Teixeira singularity of case 1, and its chart by differences.
static int make_chart(chart_t *k) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  int count = 0, found = 0;
  if (tf_prepare(&k->machine, &tf_scenes[0]->params, NULL) != TF_OK) {
    return 0;
  }
  k->input = tf_input_default(&k->machine);
  (void)tf_two_folds(&k->machine, &k->input, places, &count, NULL);
  for (int i = 0; i < count && !found; i++) {
    found =
        tf_normal_form(&k->machine, &k->input, &places[i], &k->fold) == TF_OK &&
        k->fold.paper_case == 1;
  }
  if (!found) {
    return 0;
  }
  const double r = (double)k->fold.point.r, w = (double)k->fold.point.w;
  const double e = 1e-6;
  double up[2], down[2], right[2], left[2];
  k->size = 1;
  coordinates(k, r + e, w, right);
  coordinates(k, r - e, w, left);
  coordinates(k, r, w + e, up);
  coordinates(k, r, w - e, down);
  const double xr = (right[0] - left[0]) / (2 * e);
  const double yr = (right[1] - left[1]) / (2 * e);
  const double xw = (up[0] - down[0]) / (2 * e);
  const double yw = (up[1] - down[1]) / (2 * e);
  const double det = xr * yw - xw * yr;
  k->size = unit / fabs(yr / det);
  k->a = k->size * yw / det;
  k->b = -k->size * xw / det;
  k->c = -k->size * yr / det;
  k->d = k->size * xr / det;
  return 1;
}

// Way of the normal form, of length 1.
static void way(const chart_t *k, const double x[2], double out[2]) {
  const double J1 = (double)k->fold.J1, J2 = (double)k->fold.J2;
  const double sign = x[0] + x[1] > 0 ? 1 : -1;
  const double dx = sign * (J1 * x[0] + x[1]), dy = sign * (x[0] + J2 * x[1]);
  const double length = hypot(dx, dy);
  out[0] = length > 0 ? dx / length : 0;
  out[1] = length > 0 ? dy / length : 0;
}

// One step of about so much, by the normal form or by the sliding field of
// which y = (r, omega) is the place. x: in/out, the coordinates.
static void advance(const chart_t *k, int true_field, double step, double x[2],
                    double y[2]) {
  double a[2];
  if (!true_field) {
    double b[2];
    way(k, x, a);
    const double mid[2] = {x[0] + step / 2 * a[0], x[1] + step / 2 * a[1]};
    way(k, mid, b);
    x[0] += step * b[0];
    x[1] += step * b[1];
    return;
  }
  double mid[2] = {y[0], y[1]};
  for (int stage = 0; stage < 2; stage++) {
    const tf_surface_t at = surface_at(&k->machine, &k->input, mid[0], mid[1]);
    const double dr = (double)at.stick.r, dw = (double)at.stick.w;
    const double det = k->a * k->d - k->b * k->c;
    const double length =
        hypot((k->d * dr - k->b * dw) / det, (k->a * dw - k->c * dr) / det);
    const double h = length > 0 ? (stage + 1) * step / 2 / length : 0;
    mid[0] = y[0] + h * dr;
    mid[1] = y[1] + h * dw;
  }
  y[0] = mid[0];
  y[1] = mid[1];
  coordinates(k, y[0], y[1], x);
}

// One orbit through a seed, both ways, within the quadrant of the seed.
static void orbit(const chart_t *k, int true_field, double r, double w) {
  enum { HALF = 1500, EVERY = 25 };
  static double path[2 * HALF + 1][2];
  int first = HALF, last = HALF;
  double seed[2];
  coordinates(k, r, w, seed);
  path[HALF][0] = seed[0];
  path[HALF][1] = seed[1];
  for (int sign = -1; sign <= 1; sign += 2) {
    double x[2] = {seed[0], seed[1]}, y[2] = {r, w};
    for (int i = 0; i < HALF; i++) {
      advance(k, true_field, sign * 2e-3, x, y);
      if (x[0] * seed[0] <= 0 || x[1] * seed[1] <= 0 || fabs(x[0]) > 1 ||
          fabs(x[1]) > 1) {
        break;
      }
      const int at = sign < 0 ? --first : ++last;
      path[at][0] = x[0];
      path[at][1] = x[1];
    }
  }
  for (int i = first; i <= last; i += EVERY) {
    const arrow_t arrow = arrow_at(path, first, last, i, EVERY);
    printf("%d %.4f %.4f %.4f %.4f\n", true_field, path[i][0], path[i][1],
           arrow.x, arrow.y);
  }
  printf("\n");
}

static void orbits(const chart_t *k) {
  enum { RAYS = 9 };
  const double r = (double)k->fold.point.r, w = (double)k->fold.point.w;
  for (int sign = -1; sign <= 1; sign += 2) {
    for (int i = 1; i <= RAYS; i++) {
      const double turn = acos(-1.0) / 2 * i / (RAYS + 1);
      const double xi = sign * 0.75 * cos(turn), eta = sign * 0.75 * sin(turn);
      for (int true_field = 0; true_field < 2; true_field++) {
        orbit(k, true_field, r + k->a * xi + k->b * eta,
              w + k->c * xi + k->d * eta);
      }
    }
  }
}

static void directions(const chart_t *k) {
  const double value[2] = {(double)k->fold.through.value,
                           (double)k->fold.across.value};
  for (int i = 0; i < 2; i++) {
    const double xi = value[i] - (double)k->fold.J2;
    const double size = fabs(xi) > 1 ? fabs(xi) : 1;
    printf("%.5f %.5f\n%.5f %.5f\n\n\n", -xi / size, -1 / size, xi / size,
           1 / size);
  }
}

int main(int argc, char *argv[]) {
  chart_t chart;
  if (!make_chart(&chart)) {
    fputs("normal: the scene has no two-fold of case 1\n", stderr);
    return 1;
  }
  if (argc == 2 && strcmp(argv[1], "orbits") == 0) {
    orbits(&chart);
  } else if (argc == 2 && strcmp(argv[1], "directions") == 0) {
    directions(&chart);
  } else if (argc == 2 && strcmp(argv[1], "numbers") == 0) {
    printf("J1 = %.4f; J2 = %.4f; unit = %g\n", (double)chart.fold.J1,
           (double)chart.fold.J2, unit);
  } else {
    fputs("usage: normal orbits|directions|numbers\n", stderr);
    return 2;
  }
  return 0;
}
