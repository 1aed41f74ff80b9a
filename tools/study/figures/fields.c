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
  double v = 0;
  (void)tf_speed_for_slip(&machine, r, w, input.omega0, 0, &v);
  (void)tf_surface_at(&machine, &input, r, v, w, &at);
  return at;
}

// Orbits. A step goes on from s by about so much; 0 where the orbit ends. What
// is drawn of a point is s[0], s[1].
enum { LONGEST = 4000 };
typedef int step_t(double s[4], double step);
static double path[2 * LONGEST + 1][2];
static int first, last;

// Both ways from a point, at most `half` steps each.
static void trace(step_t advance, const double start[4], double step,
                  int half) {
  first = last = LONGEST;
  memcpy(path[LONGEST], start, sizeof path[0]);
  for (int sign = -1; sign <= 1; sign += 2) {
    double s[4] = {start[0], start[1], start[2], start[3]};
    for (int i = 0; i < half && advance(s, sign * step); i++)
      memcpy(path[sign < 0 ? --first : ++last], s, sizeof path[0]);
  }
}

// The way from a point of the plane; 0 where there is none.
typedef int way_t(const double at[2], double out[2]);

// One step by the midpoint rule.
static int midpoint(way_t way, double at[2], double step) {
  double v[2];
  if (!way(at, v)) return 0;
  const double mid[2] = {at[0] + step / 2 * v[0], at[1] + step / 2 * v[1]};
  if (!way(mid, v)) return 0;
  at[0] += step * v[0];
  at[1] += step * v[1];
  return 1;
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
static double leave(const double at[2], int side) {
  const tf_surface_t here = surface_at(at[0], at[1]);
  return side > 0 ? here.lie_plus : here.lie_minus;
}

// A zero of h' off one side between two points, of which the segment has one
// at most; 0 where it has none.
static int tangency(int side, double a[2], double b[2]) {
  enum { HALVINGS = 40 };
  const int there = leave(a, side) > 0;
  if (there == (leave(b, side) > 0)) return 0;
  for (int k = 0; k < HALVINGS; k++) {
    const double mid[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    memcpy((leave(mid, side) > 0) == there ? a : b, mid, sizeof mid);
  }
  return 1;
}

// The zeros of h' off one side: of slip+ along omega = const, of slip- along
// r = const.
static void border(int side, double low, double high) {
  enum { CELLS = 30, LINES = 200 };
  for (int n = 0; n < (LINES + 1) * CELLS; n++) {
    const int line = n / CELLS;
    double at[2][2];
    for (int k = 0; k < 2; k++) {
      const double x = (double)line / LINES;
      const double y = (double)(n % CELLS + k) / CELLS;
      at[k][0] = r_low + (r_high - r_low) * (side > 0 ? y : x);
      at[k][1] = low + (high - low) * (side > 0 ? x : y);
    }
    if (tangency(side, at[0], at[1])) printf("%.5f %.5f\n", at[0][0], at[0][1]);
  }
  printf("\n\n");
}

static void borders(void) {
  const double edge = 1e-6, w0 = input.omega0;
  for (int side = 1; side >= -1; side -= 2) border(side, w_low, w0 - edge);
  for (int side = 1; side >= -1; side -= 2) border(side, w0 + edge, w_high);
}

// Orbits of the flow keep their distance: a seed too near to an earlier one is
// dropped, and an orbit ends where it comes too close to one.
enum { ACROSS = 22, UPWARDS = 22 };
static unsigned char taken[ACROSS][UPWARDS];

static int cell_in(double share, int cells) {
  const int cell = (int)(share * cells);
  return cell < 0 ? 0 : cell >= cells ? cells - 1 : cell;
}

static unsigned char *cell_of(const double y[2]) {
  return &taken[cell_in((y[0] - r_low) / (r_high - r_low), ACROSS)]
               [cell_in((y[1] - w_low) / (w_high - w_low), UPWARDS)];
}

// Stick at unit speed in units of the plot, so that a step is as long
// everywhere. It ends where it leaves its region.
static unsigned region;
static int is_above;

static int stick_way(const double at[2], double out[2]) {
  const tf_surface_t here = surface_at(at[0], at[1]);
  const double length =
      hypot(here.stick.r / (r_high - r_low), here.stick.w / (w_high - w_low));
  out[0] = here.stick.r / length;
  out[1] = here.stick.w / length;
  return length > 0 && here.region == region &&
         (at[1] > input.omega0) == is_above;
}

// It ends where it leaves the plot, too.
static int along_surface(double s[4], double step) {
  const double from[2] = {s[0], s[1]};
  double v[2];
  return midpoint(stick_way, s, step) && stick_way(s, v) && s[0] >= r_low &&
         s[0] <= r_high && s[1] >= w_low && s[1] <= w_high &&
         (cell_of(s) == cell_of(from) || !*cell_of(s));
}

static void flow(void) {
  enum { SHORTEST = 60 };
  for (int n = 0; n < ACROSS * UPWARDS; n++) {
    const int column = n % ACROSS, row = n / ACROSS;
    const double s[4] = {r_low + (r_high - r_low) * (column + 0.5) / ACROSS,
                         w_low + (w_high - w_low) * (row + 0.5) / UPWARDS, 0,
                         0};
    region = surface_at(s[0], s[1]).region;
    is_above = s[1] > input.omega0;
    if (region > TF_REGION_ESCAPING || *cell_of(s)) continue;
    trace(along_surface, s, 1e-3, 2000);
    if (last - first < SHORTEST) continue;
    for (int i = first; i <= last; i++) *cell_of(path[i]) = 1;
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
// (r, omega) = two-fold + chart (xi, eta), and its determinant.
static double chart[2][2], det;
static double seed[2];

static void coordinates(double r, double w, double out[2]) {
  const tf_surface_t at = surface_at(r, w);
  out[0] = at.lie_minus / sqrt(fold.Kmm) / size;
  out[1] = -at.lie_plus / sqrt(-fold.Kpp) / size;
}

// The Teixeira singularity of case 1, and its chart by differences.
static int make_chart(void) {
  tf_surface_point_t places[TF_TWO_FOLDS];
  int count = 0, found = 0;
  (void)tf_two_folds(&machine, &input, places, &count, NULL);
  for (int i = 0; i < count && !found; i++)
    found = tf_normal_form(&machine, &input, &places[i], &fold) == TF_OK &&
            fold.paper_case == 1;
  double by[2][2]; // of xi, eta by r, omega
  for (int j = 0; j < 2; j++) {
    const double e = 1e-6, r = j == 0 ? e : 0, w = j == 1 ? e : 0;
    double up[2], down[2];
    coordinates(fold.point.r + r, fold.point.w + w, up);
    coordinates(fold.point.r - r, fold.point.w - w, down);
    for (int i = 0; i < 2; i++) by[i][j] = (up[i] - down[i]) / (2 * e);
  }
  const double whole = by[0][0] * by[1][1] - by[0][1] * by[1][0];
  size = unit / fabs(by[1][0] / whole);
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      chart[i][j] =
          (i == j ? size : -size) * by[i ^ (i == j)][j ^ (i == j)] / whole;
  det = chart[0][0] * chart[1][1] - chart[0][1] * chart[1][0];
  return found;
}

// Whether a point of the chart is in the quadrant of its seed, and in the plot.
static int in_plot(const double x[2]) {
  return x[0] * seed[0] > 0 && x[1] * seed[1] > 0 && fabs(x[0]) <= 1 &&
         fabs(x[1]) <= 1;
}

// Way of the normal form, of length 1.
static int form_way(const double x[2], double out[2]) {
  const double sign = x[0] + x[1] > 0 ? 1 : -1;
  const double dx = sign * (fold.J1 * x[0] + x[1]);
  const double dy = sign * (x[0] + fold.J2 * x[1]);
  const double length = hypot(dx, dy);
  out[0] = dx / length;
  out[1] = dy / length;
  return length > 0;
}

static int along_form(double s[4], double step) {
  return midpoint(form_way, s, step) && in_plot(s);
}

// That of the sliding field over (r, omega), of length 1 in the chart.
static int field_way(const double at[2], double out[2]) {
  const tf_surface_t here = surface_at(at[0], at[1]);
  const double dr = here.stick.r, dw = here.stick.w;
  const double length = hypot((chart[1][1] * dr - chart[0][1] * dw) / det,
                              (chart[0][0] * dw - chart[1][0] * dr) / det);
  out[0] = length > 0 ? dr / length : 0;
  out[1] = length > 0 ? dw / length : 0;
  return 1;
}

// s[2], s[3] = (r, omega) is the place.
static int along_field(double s[4], double step) {
  if (!midpoint(field_way, s + 2, step)) return 0;
  coordinates(s[2], s[3], s);
  return in_plot(s);
}

static void orbits(void) {
  enum { RAYS = 9 };
  for (int sign = -1; sign <= 1; sign += 2) {
    for (int i = 1; i <= RAYS; i++) {
      const double turn = acos(-1.0) / 2 * i / (RAYS + 1);
      const double xi = sign * 0.75 * cos(turn), eta = sign * 0.75 * sin(turn);
      double s[4] = {0, 0, fold.point.r + chart[0][0] * xi + chart[0][1] * eta,
                     fold.point.w + chart[1][0] * xi + chart[1][1] * eta};
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
  const double value[2] = {fold.through.value, fold.across.value};
  for (int i = 0; i < 2; i++) {
    const double xi = value[i] - fold.J2, most = fmax(fabs(xi), 1);
    printf("%.5f %.5f\n%.5f %.5f\n\n\n", -xi / most, -1 / most, xi / most,
           1 / most);
  }
}

static void numbers(void) {
  printf("J1 = %.4f; J2 = %.4f; unit = %g; r_star = %.10g; w_star = %.10g\n",
         fold.J1, fold.J2, unit, fold.point.r, fold.point.w);
}

// Next to h = g = 0.
typedef struct {
  double radial, angular; // rho', rho phi' [m/s^2]
} polar_t;

// By the core's rates at v = 0, omega = omega0.
static polar_t rates(double r, double phi) {
  const tf_machine_t *k = &machine;
  const double h = sin(phi), g = cos(phi);
  const rates_t rate = rates_at(k, &input, r, 0, 0, k->omega0);
  const tf_force_t f = tf_tyre_force(&k->contact.tyre, h < 0 ? -1 : 1, h, g);
  const tf_slip_t d = slip_from_pq(k, rate.dp + rate.Fp * f.F,
                                   rate.dq + rate.Fq * f.F + rate.Mq * f.M);
  return (polar_t){d.g * g + d.h * h, d.h * g - d.g * h};
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
      const double at_low = rates(r, low).angular;
      const double at_high = rates(r, high).angular;
      const double pull = (at_high - at_low) / (high - low);
      if ((at_low > 0) == (at_high > 0)) continue;
      for (int j = 0; j < HALVINGS; j++) {
        const double mid = (low + high) / 2;
        *((rates(r, mid).angular > 0) == (at_low > 0) ? &low : &high) = mid;
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

static int corner_way(const double at[2], double out[2]) {
  const polar_t here = rates(corner_r, at[1]);
  out[0] = here.radial;
  out[1] = here.angular;
  return 1;
}

static int around_corner(double s[4], double step) {
  double v[2];
  (void)corner_way(s + 2, v);
  (void)midpoint(corner_way, s + 2, step / hypot(v[0], v[1]));
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

static const struct {
  const char *name;
  void (*print)(void);
} fields[] = {{"borders", borders}, {"flow", flow},
              {"orbits", orbits},   {"straight", straight},
              {"numbers", numbers}, {"directions", directions},
              {"angular", angular}, {"corner", corner}};

int main(int argc, char *argv[]) {
  if (tf_prepare(&machine, &tf_scenes[0]->params, NULL) != TF_OK) return 1;
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
