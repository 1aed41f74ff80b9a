// surface - curves on the surface h = 0 of the scene `chaos`, for the figures:
//
//   surface borders  r,omega  where one slip is tangent to h = 0, in four
//                    parts: slip+ and slip- at g > 0, then at g < 0
//   surface flow     r,omega,sticks,dr,domega  orbits of stick, one a block;
//                    sticks is 1 in sliding and -1 in escaping; dr, domega is
//                    the way of an arrow, 0 where there is none
//
// The regions themselves are of `twofold regions`, over the same window.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "arrow.h"
#include "place.h"

static const double r_low = 0.10, r_high = 0.28;
static const double w_low = -1.16, w_high = -0.88;

typedef struct {
  tf_machine_t machine;
  tf_input_t input;
} scene_t;

// h' just off the surface.
static double leave(const scene_t *scene, double r, double w, int side) {
  const tf_surface_t at = surface_at(&scene->machine, &scene->input, r, w);
  return (double)(side > 0 ? at.lie_plus : at.lie_minus);
}

// A zero of h' off one side between two points, of which the segment has one
// at most; 0 where it has none.
static int tangency(const scene_t *scene, int side, double a[2], double b[2]) {
  enum { HALVINGS = 40 };
  const int there = leave(scene, a[0], a[1], side) > 0;
  if (there == (leave(scene, b[0], b[1], side) > 0)) {
    return 0;
  }
  for (int k = 0; k < HALVINGS; k++) {
    const double mid[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    double *end = (leave(scene, mid[0], mid[1], side) > 0) == there ? a : b;
    end[0] = mid[0];
    end[1] = mid[1];
  }
  return 1;
}

// The tangencies of one side, between two speeds that share the sign of g:
// those of slip+ are steep, so they are sought along omega = const, those of
// slip- along r = const.
static void border(const scene_t *scene, int side, double low, double high) {
  enum { CELLS = 30, LINES = 200 };
  const int steep = side > 0;
  for (int i = 0; i <= LINES; i++) {
    for (int j = 0; j < CELLS; j++) {
      double at[2][2];
      for (int k = 0; k < 2; k++) {
        const double x = (double)i / LINES, y = (double)(j + k) / CELLS;
        at[k][0] = r_low + (r_high - r_low) * (steep ? y : x);
        at[k][1] = low + (high - low) * (steep ? x : y);
      }
      if (tangency(scene, side, at[0], at[1])) {
        printf("%.5f %.5f\n", at[0][0], at[0][1]);
      }
    }
  }
  printf("\n\n");
}

static void borders(const scene_t *scene) {
  const double edge = 1e-6, w0 = (double)scene->input.omega0;
  for (int side = 1; side >= -1; side -= 2) {
    border(scene, side, w_low, w0 - edge);
  }
  for (int side = 1; side >= -1; side -= 2) {
    border(scene, side, w0 + edge, w_high);
  }
}

// Way of stick at unit speed in units of the plot, so that a step is as long
// everywhere.
static int way(const scene_t *scene, const double y[2], double step,
               double out[2]) {
  const tf_surface_t at =
      surface_at(&scene->machine, &scene->input, y[0], y[1]);
  const double dr = (double)at.stick.r, dw = (double)at.stick.w;
  const double length = hypot(dr / (r_high - r_low), dw / (w_high - w_low));
  if (!(length > 0)) {
    return 0;
  }
  out[0] = step * dr / length;
  out[1] = step * dw / length;
  return 1;
}

// One midpoint step; 0 where it leaves its region or the plot.
static int advance(const scene_t *scene, double y[2], double step) {
  const unsigned here =
      surface_at(&scene->machine, &scene->input, y[0], y[1]).region;
  const double w0 = (double)scene->input.omega0;
  double dy[2];
  if (!way(scene, y, step, dy)) {
    return 0;
  }
  const double mid[2] = {y[0] + dy[0] / 2, y[1] + dy[1] / 2};
  if ((y[1] - w0) * (mid[1] - w0) <= 0 ||
      surface_at(&scene->machine, &scene->input, mid[0], mid[1]).region !=
          here ||
      !way(scene, mid, step, dy)) {
    return 0;
  }
  const double r = y[0] + dy[0], w = y[1] + dy[1];
  if (surface_at(&scene->machine, &scene->input, r, w).region != here ||
      (y[1] - w0) * (w - w0) <= 0 || r < r_low || r > r_high || w < w_low ||
      w > w_high) {
    return 0;
  }
  y[0] = r;
  y[1] = w;
  return 1;
}

// Orbits that keep their distance: a seed too near to an earlier one is
// dropped, and an orbit ends where it comes too close to one.
enum { ACROSS = 22, UPWARDS = 22, LONGEST = 2000, SHORTEST = 60, EVERY = 8 };
static unsigned char taken[ACROSS][UPWARDS];
static double path[2 * LONGEST + 1][2];

static unsigned char *cell_of(const double y[2]) {
  int i = (int)((y[0] - r_low) / (r_high - r_low) * ACROSS);
  int j = (int)((y[1] - w_low) / (w_high - w_low) * UPWARDS);
  i = i < 0 ? 0 : i >= ACROSS ? ACROSS - 1 : i;
  j = j < 0 ? 0 : j >= UPWARDS ? UPWARDS - 1 : j;
  return &taken[i][j];
}

static void print_path(int first, int last, int sticks) {
  for (int i = first; i <= last; i++) {
    *cell_of(path[i]) = 1;
  }
  for (int i = first; i <= last; i += EVERY) {
    const arrow_t arrow = arrow_at(path, first, last, i, EVERY);
    printf("%.5f %.5f %d %.5f %.5f\n", path[i][0], path[i][1], sticks, arrow.x,
           arrow.y);
  }
  printf("\n");
}

static void orbit(const scene_t *scene, double r, double w) {
  const unsigned region =
      surface_at(&scene->machine, &scene->input, r, w).region;
  const double start[2] = {r, w};
  int first = LONGEST, last = LONGEST;
  if ((region != TF_REGION_SLIDING && region != TF_REGION_ESCAPING) ||
      *cell_of(start)) {
    return;
  }
  path[LONGEST][0] = r;
  path[LONGEST][1] = w;
  for (int sign = -1; sign <= 1; sign += 2) {
    double y[2] = {r, w};
    unsigned char *cell = cell_of(y);
    while (first > 0 && last < 2 * LONGEST && advance(scene, y, sign * 1e-3)) {
      if (cell_of(y) != cell && *cell_of(y)) {
        break;
      }
      cell = cell_of(y);
      const int at = sign < 0 ? --first : ++last;
      path[at][0] = y[0];
      path[at][1] = y[1];
    }
  }
  if (last - first >= SHORTEST) {
    print_path(first, last, region == TF_REGION_SLIDING ? 1 : -1);
  }
}

static void flow(const scene_t *scene) {
  for (int j = 0; j < UPWARDS; j++) {
    for (int i = 0; i < ACROSS; i++) {
      orbit(scene, r_low + (r_high - r_low) * (i + 0.5) / ACROSS,
            w_low + (w_high - w_low) * (j + 0.5) / UPWARDS);
    }
  }
}

int main(int argc, char *argv[]) {
  scene_t scene;
  if (tf_prepare(&scene.machine, &tf_scenes[0]->params, NULL) != TF_OK) {
    return 1;
  }
  scene.input = tf_input_default(&scene.machine);
  if (argc == 2 && strcmp(argv[1], "borders") == 0) {
    borders(&scene);
  } else if (argc == 2 && strcmp(argv[1], "flow") == 0) {
    flow(&scene);
  } else {
    fputs("usage: surface borders|flow\n", stderr);
    return 2;
  }
  return 0;
}
