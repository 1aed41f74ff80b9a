// fields - curves of the scene `chaos` for the figures, by the core:
//
//   borders     r,omega  where one slip is tangent to h = 0, in four parts:
//               slip+ and slip- at g > 0, then at g < 0
//   flow        orbits of stick on h = 0: r, omega, an arrow, and 1 in sliding,
//               -1 in escaping
//   orbits      orbits of stick next to the two-fold, in the coordinates of the
//               paper's normal form: xi, eta, an arrow, and 0 for the normal
//               form, 1 for the sliding field through the same points
//   straight    xi,eta  the two straight orbits, through and across
//   numbers     gnuplot assignments: J1, J2, unit [rad/s], the two-fold
//   directions  r [m], phi [degrees], rho' [m/s^2], pull [m/s^2] of every limit
//               direction next to h = g = 0: there the force depends on phi =
//               atan2(h, g) alone, so that two numbers say all, how fast the
//               distance rho grows, and how fast the direction changes, rho
//               phi'. rho' < 0 falls in, pull = d(rho phi')/dphi < 0 draws its
//               neighbours to it
//   angular     r, phi, 1 or -1 as phi grows or falls, over a grid
//   corner      orbits next to h = g = 0 at r = 0.17: g, h, an arrow, 0; within
//               the unit circle, for all circles are alike
//   tyre        the paper's figure 8: angle [degrees], F / mu and M / mu of the
//               stretched string with the parameters of the left panel, and
//               with those of the right panel, then F / mu and M / (mu kappa)
//               of the law with a jump that takes its place
//
// Orbits are one a block; the arrow is the way to the next point where it is in
// the middle of an orbit, else 0.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../../src/model/rates.h"
#include "twofold.h"

static const double r_low = 0.10, r_high = 0.28;
static const double w_low = -1.16, w_high = -0.88;

static tf_machine_t machine;
static tf_input_t input;

// What the surface h = 0 is at (r, omega).
static tf_surface_t surface_at(double r, double w) {
  tf_surface_t at = {.region = TF_REGION_CODIM2};
  tf_real_t v = 0;
  (void)tf_speed_for_slip(&machine, (tf_real_t)r, (tf_real_t)w, input.omega0, 0,
                          &v);
  (void)tf_surface_at(&machine, &input, (tf_real_t)r, v, (tf_real_t)w, &at);
  return at;
}

// Orbits. A step goes on from s by about so much; 0 where the orbit ends. What
// is drawn of a point is s[0], s[1].
enum { LONGEST = 4000 };
typedef int (*step_t)(double s[4], double step);
static double path[2 * LONGEST + 1][2];
static int first, last;

// Both ways from a point, at most `half` steps each.
static void trace(step_t advance, const double start[4], double step,
                  int half) {
  first = last = LONGEST;
  memcpy(path[LONGEST], start, sizeof path[0]);
  for (int sign = -1; sign <= 1; sign += 2) {
    double s[4] = {start[0], start[1], start[2], start[3]};
    for (int i = 0; i < half && advance(s, sign * step); i++) {
      memcpy(path[sign < 0 ? --first : ++last], s, sizeof path[0]);
    }
  }
}

// Every so many points, with so many digits.
static void print_path(int every, int digits, int kind) {
  const int middle = first + (last - first) / 2;
  for (int i = first; i <= last; i += every) {
    const int next = i + every < last ? i + every : last;
    const int here = i <= middle && middle < next;
    printf("%.*f %.*f %.*f %.*f %d\n", digits, path[i][0], digits, path[i][1],
           digits, here ? path[next][0] - path[i][0] : 0, digits,
           here ? path[next][1] - path[i][1] : 0, kind);
  }
  printf("\n");
}

// h' just off the surface.
static double leave(double r, double w, int side) {
  const tf_surface_t at = surface_at(r, w);
  return (double)(side > 0 ? at.lie_plus : at.lie_minus);
}

// A zero of h' off one side between two points, of which the segment has one
// at most; 0 where it has none.
static int tangency(int side, double a[2], double b[2]) {
  enum { HALVINGS = 40 };
  const int there = leave(a[0], a[1], side) > 0;
  if (there == (leave(b[0], b[1], side) > 0)) {
    return 0;
  }
  for (int k = 0; k < HALVINGS; k++) {
    const double mid[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    double *end = (leave(mid[0], mid[1], side) > 0) == there ? a : b;
    end[0] = mid[0];
    end[1] = mid[1];
  }
  return 1;
}

// The zeros of h' off one side: of slip+ along omega = const, of slip- along
// r = const.
static void border(int side, double low, double high) {
  enum { CELLS = 30, LINES = 200 };
  for (int i = 0; i <= LINES; i++) {
    for (int j = 0; j < CELLS; j++) {
      double at[2][2];
      for (int k = 0; k < 2; k++) {
        const double x = (double)i / LINES, y = (double)(j + k) / CELLS;
        at[k][0] = r_low + (r_high - r_low) * (side > 0 ? y : x);
        at[k][1] = low + (high - low) * (side > 0 ? x : y);
      }
      if (tangency(side, at[0], at[1])) {
        printf("%.5f %.5f\n", at[0][0], at[0][1]);
      }
    }
  }
  printf("\n\n");
}

static void borders(void) {
  const double edge = 1e-6, w0 = (double)input.omega0;
  for (int side = 1; side >= -1; side -= 2) {
    border(side, w_low, w0 - edge);
  }
  for (int side = 1; side >= -1; side -= 2) {
    border(side, w0 + edge, w_high);
  }
}

// Orbits of the flow keep their distance: a seed too near to an earlier one is
// dropped, and an orbit ends where it comes too close to one.
enum { ACROSS = 22, UPWARDS = 22 };
static unsigned char taken[ACROSS][UPWARDS];

static unsigned char *cell_of(const double y[2]) {
  int i = (int)((y[0] - r_low) / (r_high - r_low) * ACROSS);
  int j = (int)((y[1] - w_low) / (w_high - w_low) * UPWARDS);
  i = i < 0 ? 0 : i >= ACROSS ? ACROSS - 1 : i;
  j = j < 0 ? 0 : j >= UPWARDS ? UPWARDS - 1 : j;
  return &taken[i][j];
}

// One midpoint step of stick at unit speed in units of the plot, so that a step
// is as long everywhere. It ends where it leaves its region or the plot.
static int along_surface(double s[4], double step) {
  const double w0 = (double)input.omega0;
  const unsigned here = surface_at(s[0], s[1]).region;
  double y[2] = {s[0], s[1]};
  for (int stage = 1; stage <= 2; stage++) {
    const tf_surface_t at = surface_at(y[0], y[1]);
    const double dr = (double)at.stick.r, dw = (double)at.stick.w;
    const double length = hypot(dr / (r_high - r_low), dw / (w_high - w_low));
    if (!(length > 0)) {
      return 0;
    }
    y[0] = s[0] + step * dr / length * stage / 2;
    y[1] = s[1] + step * dw / length * stage / 2;
    if (surface_at(y[0], y[1]).region != here ||
        (s[1] - w0) * (y[1] - w0) <= 0) {
      return 0;
    }
  }
  if (y[0] < r_low || y[0] > r_high || y[1] < w_low || y[1] > w_high ||
      (cell_of(y) != cell_of(s) && *cell_of(y))) {
    return 0;
  }
  s[0] = y[0];
  s[1] = y[1];
  return 1;
}

static void flow(void) {
  enum { SHORTEST = 60 };
  for (int n = 0; n < ACROSS * UPWARDS; n++) {
    const int column = n % ACROSS, row = n / ACROSS;
    const double s[4] = {r_low + (r_high - r_low) * (column + 0.5) / ACROSS,
                         w_low + (w_high - w_low) * (row + 0.5) / UPWARDS, 0,
                         0};
    const unsigned region = surface_at(s[0], s[1]).region;
    if ((region != TF_REGION_SLIDING && region != TF_REGION_ESCAPING) ||
        *cell_of(s)) {
      continue;
    }
    trace(along_surface, s, 1e-3, 2000);
    if (last - first < SHORTEST) {
      continue;
    }
    for (int i = first; i <= last; i++) {
      *cell_of(path[i]) = 1;
    }
    print_path(8, 5, region == TF_REGION_SLIDING ? 1 : -1);
  }
}

// The chart of the normal form: xi = L- / (S sqrt(K--)), eta = -L+ / (S
// sqrt(-K++)), L+- = h_x . f(x, +-mu): sliding is xi, eta > 0, the axes are the
// tangencies themselves, and the stick motion is (J1 xi + eta, xi + J2 eta) to
// first order, times a positive number. S makes xi = 1 lie `unit` from the
// two-fold in omega.
static const double unit = 0.02; // [rad/s]
static tf_two_fold_t fold;
static double size = 1; // S
// (r, omega) = two-fold + ((r_xi, r_eta), (w_xi, w_eta)) (xi, eta), and its
// determinant.
static double r_xi, r_eta, w_xi, w_eta, det;
static double seed[2];

static void coordinates(double r, double w, double out[2]) {
  const tf_surface_t at = surface_at(r, w);
  out[0] = (double)at.lie_minus / sqrt((double)fold.Kmm) / size;
  out[1] = -(double)at.lie_plus / sqrt(-(double)fold.Kpp) / size;
}

// The Teixeira singularity of case 1, and its chart by differences.
static int make_chart(void) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  int count = 0, found = 0;
  (void)tf_two_folds(&machine, &input, places, &count, NULL);
  for (int i = 0; i < count && !found; i++) {
    found = tf_normal_form(&machine, &input, &places[i], &fold) == TF_OK &&
            fold.paper_case == 1;
  }
  const double r = (double)fold.point.r, w = (double)fold.point.w, e = 1e-6;
  double up[2], down[2], right[2], left[2];
  coordinates(r + e, w, right);
  coordinates(r - e, w, left);
  coordinates(r, w + e, up);
  coordinates(r, w - e, down);
  const double xr = (right[0] - left[0]) / (2 * e);
  const double yr = (right[1] - left[1]) / (2 * e);
  const double xw = (up[0] - down[0]) / (2 * e);
  const double yw = (up[1] - down[1]) / (2 * e);
  const double whole = xr * yw - xw * yr;
  size = unit / fabs(yr / whole);
  r_xi = size * yw / whole;
  r_eta = -size * xw / whole;
  w_xi = -size * yr / whole;
  w_eta = size * xr / whole;
  det = r_xi * w_eta - r_eta * w_xi;
  return found;
}

// Whether a point of the chart is in the quadrant of its seed, and in the plot.
static int in_plot(const double x[2]) {
  return x[0] * seed[0] > 0 && x[1] * seed[1] > 0 && fabs(x[0]) <= 1 &&
         fabs(x[1]) <= 1;
}

// Way of the normal form, of length 1.
static void way(const double x[2], double out[2]) {
  const double sign = x[0] + x[1] > 0 ? 1 : -1;
  const double dx = sign * ((double)fold.J1 * x[0] + x[1]);
  const double dy = sign * (x[0] + (double)fold.J2 * x[1]);
  const double length = hypot(dx, dy);
  out[0] = length > 0 ? dx / length : 0;
  out[1] = length > 0 ? dy / length : 0;
}

static int along_form(double s[4], double step) {
  double x[2], y[2];
  way(s, x);
  const double mid[2] = {s[0] + step / 2 * x[0], s[1] + step / 2 * x[1]};
  way(mid, y);
  s[0] += step * y[0];
  s[1] += step * y[1];
  return in_plot(s);
}

// By the sliding field, of which s[2], s[3] = (r, omega) is the place.
static int along_field(double s[4], double step) {
  double mid[2] = {s[2], s[3]};
  for (int stage = 0; stage < 2; stage++) {
    const tf_surface_t at = surface_at(mid[0], mid[1]);
    const double dr = (double)at.stick.r, dw = (double)at.stick.w;
    const double length =
        hypot((w_eta * dr - r_eta * dw) / det, (r_xi * dw - w_xi * dr) / det);
    const double h = length > 0 ? (stage + 1) * step / 2 / length : 0;
    mid[0] = s[2] + h * dr;
    mid[1] = s[3] + h * dw;
  }
  s[2] = mid[0];
  s[3] = mid[1];
  coordinates(s[2], s[3], s);
  return in_plot(s);
}

static void orbits(void) {
  enum { RAYS = 9 };
  for (int sign = -1; sign <= 1; sign += 2) {
    for (int i = 1; i <= RAYS; i++) {
      const double turn = acos(-1.0) / 2 * i / (RAYS + 1);
      const double xi = sign * 0.75 * cos(turn), eta = sign * 0.75 * sin(turn);
      double s[4] = {0, 0, (double)fold.point.r + r_xi * xi + r_eta * eta,
                     (double)fold.point.w + w_xi * xi + w_eta * eta};
      coordinates(s[2], s[3], s);
      memcpy(seed, s, sizeof seed);
      trace(along_form, s, 2e-3, 1500);
      print_path(25, 4, 0);
      trace(along_field, s, 2e-3, 1500);
      print_path(25, 4, 1);
    }
  }
}

static void straight(void) {
  const double value[2] = {(double)fold.through.value,
                           (double)fold.across.value};
  for (int i = 0; i < 2; i++) {
    const double xi = value[i] - (double)fold.J2;
    const double most = fabs(xi) > 1 ? fabs(xi) : 1;
    printf("%.5f %.5f\n%.5f %.5f\n\n\n", -xi / most, -1 / most, xi / most,
           1 / most);
  }
}

static void numbers(void) {
  printf("J1 = %.4f; J2 = %.4f; unit = %g; r_star = %.10g; w_star = %.10g\n",
         (double)fold.J1, (double)fold.J2, unit, (double)fold.point.r,
         (double)fold.point.w);
}

// Next to h = g = 0.
typedef struct {
  double radial, angular; // rho', rho phi' [m/s^2]
} polar_t;

// By the core's rates at v = 0, omega = omega0.
static polar_t rates(double r, double phi) {
  const tf_machine_t *k = &machine;
  const double h = sin(phi), g = cos(phi);
  const rates_t rate = rates_at(k, &input, (tf_real_t)r, 0, 0, k->omega0);
  const tf_force_t f =
      tf_tyre_force(&k->tyre, h < 0 ? -1 : 1, (tf_real_t)h, (tf_real_t)g);
  const double p = (double)(rate.dp + rate.Fp * f.F);
  const double q = (double)(rate.dq + rate.Fq * f.F + rate.Mq * f.M);
  const tf_slip_t d = slip_from_pq(k, (tf_real_t)p, (tf_real_t)q);
  const double dh = (double)d.h, dg = (double)d.g;
  return (polar_t){dg * g + dh * h, dh * g - dg * h};
}

static double degrees(double phi) { return phi * 180 / acos(-1.0); }

// Angles from -135 to 225 degrees, so that the directions next to 0, along
// which the motion goes, are not cut.
enum { CELLS = 720 };
static double angle(double i) { return acos(-1.0) * (2 * i / CELLS - 0.75); }

static void directions(void) {
  enum { ROWS = 90, HALVINGS = 45 };
  const double edge = 1e-9;
  for (int row = 0; row <= ROWS; row++) {
    const double r = r_low + (r_high - r_low) * row / ROWS;
    for (int i = 0; i < CELLS; i++) {
      double low = angle(i) + edge, high = angle(i + 1) - edge;
      const int up = rates(r, low).angular > 0;
      if (up == (rates(r, high).angular > 0)) {
        continue;
      }
      const double pull =
          (rates(r, high).angular - rates(r, low).angular) / (high - low);
      for (int j = 0; j < HALVINGS; j++) {
        const double mid = (low + high) / 2;
        *((rates(r, mid).angular > 0) == up ? &low : &high) = mid;
      }
      printf("%.4f %.3f %.4g %.4g\n", r, degrees(low), rates(r, low).radial,
             pull);
    }
  }
}

static void angular(void) {
  enum { ROWS = 180, COLUMNS = 180 };
  for (int i = 0; i < ROWS; i++) {
    const double phi = angle((i + 0.5) * CELLS / ROWS);
    for (int j = 0; j < COLUMNS; j++) {
      const double r = r_low + (r_high - r_low) * (j + 0.5) / COLUMNS;
      printf("%.4f %.2f %d\n", r, degrees(phi),
             rates(r, phi).angular > 0 ? 1 : -1);
    }
  }
}

// In logarithmic time, to h = 0, to the circle or to the middle: s[2], s[3] are
// log rho and phi.
static const double corner_r = 0.17;

static int around_corner(double s[4], double step) {
  const polar_t here = rates(corner_r, s[3]);
  const double by = step / hypot(here.radial, here.angular);
  const polar_t mid = rates(corner_r, s[3] + by / 2 * here.angular);
  s[2] += by * mid.radial;
  s[3] += by * mid.angular;
  s[0] = exp(s[2]) * cos(s[3]);
  s[1] = exp(s[2]) * sin(s[3]);
  return sin(s[3]) * seed[1] > 0 && s[2] <= 0 && s[2] >= -6;
}

static void corner(void) {
  enum { SEEDS = 16 };
  printf("# r %g\n", corner_r);
  for (int i = 0; i < SEEDS; i++) {
    const double phi = angle((i + 0.5) * CELLS / SEEDS), rho = 0.55;
    const double s[4] = {rho * cos(phi), rho * sin(phi), log(rho), phi};
    seed[1] = sin(phi);
    trace(around_corner, s, 2e-3, LONGEST);
    print_path(40, 4, 0);
  }
}

static tf_force_t force_at(const tf_params_t *params, double radians) {
  tf_machine_t one;
  const tf_force_t none = {0, 0};
  if (tf_prepare(&one, params, NULL) != TF_OK) return none;
  return tf_tyre_force(&one.tyre, 1, sin(radians), cos(radians));
}

static void tyre(void) {
  enum { ROWS = 300 };
  const tf_params_t *chaos = &tf_scenes[0]->params;
  tf_params_t left = *chaos, right = *chaos;
  left.law = right.law = TF_TYRE_STRING;
  left.k = left.delta = left.sigma = left.a = 1;
  left.rho = right.rho = 2.0 / 3.0;
  right.k = 1e3;
  right.delta = right.sigma = 1e-3;
  right.a = 1;
  printf("# angle F_left M_left F_right M_right F_jump M_jump\n");
  for (int i = 1; i < ROWS; i++) {
    const double at = 90.0 * i / ROWS, radians = at * acos(-1.0) / 180;
    const tf_force_t of_left = force_at(&left, radians);
    const tf_force_t of_right = force_at(&right, radians);
    const tf_force_t jump = force_at(chaos, radians);
    printf("%.3f %.8g %.8g %.8g %.8g %.8g %.8g\n", at, of_left.F, of_left.M,
           of_right.F, of_right.M, jump.F, jump.M / chaos->kappa);
  }
}

static const struct {
  const char *name;
  void (*print)(void);
} fields[] = {
    {"borders", borders},   {"flow", flow},       {"orbits", orbits},
    {"straight", straight}, {"numbers", numbers}, {"directions", directions},
    {"angular", angular},   {"corner", corner},   {"tyre", tyre}};

int main(int argc, char *argv[]) {
  if (tf_prepare(&machine, &tf_scenes[0]->params, NULL) != TF_OK) {
    return 1;
  }
  input = tf_input_default(&machine);
  if (!make_chart()) {
    fputs("fields: the scene has no two-fold of case 1\n", stderr);
    return 1;
  }
  for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
    if (argc == 2 && strcmp(argv[1], fields[i].name) == 0) {
      fields[i].print();
      return 0;
    }
  }
  fputs("usage: fields NAME, of those at the top of fields.c\n", stderr);
  return 2;
}
