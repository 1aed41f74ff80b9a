// portrait - slip next to h = g = 0 of the scene `chaos`, for the figures.
// There the force depends on the direction phi = atan2(h, g) alone, so that
// at a given r two numbers say all: how fast the distance grows, rho', and how
// fast the direction changes, rho phi'.
//
//   portrait directions  r [m], phi [degrees], rho' [m/s^2], pull [m/s^2] of
//                        every limit direction: rho' < 0 falls in, pull =
//                        d(rho phi')/dphi < 0 draws its neighbours to it
//   portrait angular     r, phi, 1 or -1 as phi grows or falls, over a grid
//   portrait orbits R    g,h,dg,dh [1] orbits at r = R, one a block, within
//                        the unit circle: all circles are alike
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../../src/model/rates.h"
#include "arrow.h"
#include "twofold.h"

static const double r_low = 0.10, r_high = 0.28;

typedef struct {
  double radial, angular; // rho', rho phi' [m/s^2]
} polar_t;

// By the core's rates at v = 0, omega = omega0.
static polar_t rates(const tf_machine_t *k, double r, double phi) {
  const double h = sin(phi), g = cos(phi);
  const tf_input_t input = tf_input_default(k);
  const rates_t rate = rates_at(k, &input, (tf_real_t)r, 0, 0, k->omega0);
  const tf_force_t f =
      tf_tyre_force(&k->tyre, h < 0 ? -1 : 1, (tf_real_t)h, (tf_real_t)g);
  const double p = (double)(rate.dp + rate.Fp * f.F);
  const double q = (double)(rate.dq + rate.Fq * f.F + rate.Mq * f.M);
  const double s = (double)k->sin_gamma, c = (double)k->cos_gamma;
  const double dh = -p * s - q * c, dg = -p * c + q * s;
  return (polar_t){dg * g + dh * h, dh * g - dg * h};
}

static double degrees(double phi) { return phi * 180 / acos(-1.0); }

// Angles from -135 to 225 degrees, so that the directions next to 0, along
// which the motion goes, are not cut.
enum { CELLS = 720 };
static double angle(double i) { return acos(-1.0) * (2 * i / CELLS - 0.75); }

static void directions(const tf_machine_t *k) {
  enum { ROWS = 90, HALVINGS = 45 };
  const double edge = 1e-9;
  for (int row = 0; row <= ROWS; row++) {
    const double r = r_low + (r_high - r_low) * row / ROWS;
    for (int i = 0; i < CELLS; i++) {
      double a = angle(i) + edge, b = angle(i + 1) - edge;
      const int up = rates(k, r, a).angular > 0;
      if (up == (rates(k, r, b).angular > 0)) {
        continue;
      }
      const double steep = rates(k, r, b).angular - rates(k, r, a).angular;
      const double pull = steep / (b - a);
      for (int j = 0; j < HALVINGS; j++) {
        const double mid = (a + b) / 2;
        if ((rates(k, r, mid).angular > 0) == up) {
          a = mid;
        } else {
          b = mid;
        }
      }
      printf("%.4f %.3f %.4g %.4g\n", r, degrees(a), rates(k, r, a).radial,
             pull);
    }
  }
}

static void angular(const tf_machine_t *k) {
  enum { ROWS = 180, COLUMNS = 180 };
  for (int i = 0; i < ROWS; i++) {
    const double phi = angle((i + 0.5) * CELLS / ROWS);
    for (int j = 0; j < COLUMNS; j++) {
      const double r = r_low + (r_high - r_low) * (j + 0.5) / COLUMNS;
      printf("%.4f %.2f %d\n", r, degrees(phi),
             rates(k, r, phi).angular > 0 ? 1 : -1);
    }
  }
}

// From a point, both ways in logarithmic time, to h = 0, to the circle or to
// the middle.
static void orbit(const tf_machine_t *k, double r, double rho, double phi) {
  enum { HALF = 4000, EVERY = 40 };
  static double path[2 * HALF + 1][2];
  int first = HALF, last = HALF;
  path[HALF][0] = rho * cos(phi);
  path[HALF][1] = rho * sin(phi);
  for (int sign = -1; sign <= 1; sign += 2) {
    double x = log(rho), y = phi;
    for (int i = 0; i < HALF; i++) {
      const polar_t a = rates(k, r, y);
      const double step = sign * 2e-3 / hypot(a.radial, a.angular);
      const polar_t b = rates(k, r, y + step / 2 * a.angular);
      const double next = y + step * b.angular;
      x += step * b.radial;
      if (sin(next) * sin(phi) <= 0 || x > 0 || x < -6) {
        break;
      }
      y = next;
      const int at = sign < 0 ? --first : ++last;
      path[at][0] = exp(x) * cos(y);
      path[at][1] = exp(x) * sin(y);
    }
  }
  for (int i = first; i <= last; i += EVERY) {
    const arrow_t arrow = arrow_at(path, first, last, i, EVERY);
    printf("%.4f %.4f %.4f %.4f\n", path[i][0], path[i][1], arrow.x, arrow.y);
  }
  printf("\n");
}

static void orbits(const tf_machine_t *k, double r) {
  enum { SEEDS = 16 };
  printf("# r %g\n", r);
  for (int i = 0; i < SEEDS; i++) {
    orbit(k, r, 0.55, angle((i + 0.5) * CELLS / SEEDS));
  }
}

int main(int argc, char *argv[]) {
  tf_machine_t machine;
  if (tf_prepare(&machine, &tf_scenes[0]->params, NULL) != TF_OK) {
    return 1;
  }
  if (argc == 2 && strcmp(argv[1], "directions") == 0) {
    directions(&machine);
  } else if (argc == 2 && strcmp(argv[1], "angular") == 0) {
    angular(&machine);
  } else if (argc == 3 && strcmp(argv[1], "orbits") == 0) {
    orbits(&machine, strtod(argv[2], NULL));
  } else {
    fputs("usage: portrait directions|angular|orbits R\n", stderr);
    return 2;
  }
  return 0;
}
