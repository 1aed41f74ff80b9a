// The surface h = 0 for the page: which region a point lies in, a map of them
// over (r, omega), what friction does to a slip there, and the two-folds.
#include "module.h"

#define MAP_MOST 40000
#define NO_REGION TF_REGIONS // the law has no surface, or the point has no v
static uint8_t map[MAP_MOST];
static double two_fold[TF_TWO_FOLDS][4];

// Returns: whether the surface has a point there.
static bool surface_at(tf_real_t r, tf_real_t w, tf_surface_t *at) {
  const tf_machine_t *k = machine_begun();
  const tf_input_t input = input_applied();
  tf_real_t v = 0;
  return k && tf_speed_for_slip(k, r, w, input.omega0, 0, &v) == TF_OK &&
         tf_surface_at(k, &input, r, v, w, at) == TF_OK;
}

static tf_real_t part(double from, double to, uint32_t i, uint32_t count) {
  return from + (to - from) * (((double)i + 0.5) / (double)count);
}

// Regions at the centres of columns x rows cells, row by row from w0 on.
// Returns: 0 where that is more than there is room for, or nothing has begun.
const uint8_t *EXPORT(regions)(double r0, double r1, uint32_t columns,
                               double w0, double w1, uint32_t rows) {
  if (!machine_begun() || columns > MAP_MOST || rows > MAP_MOST ||
      columns * rows > MAP_MOST)
    return 0;
  for (uint32_t j = 0; j < rows; j++) {
    for (uint32_t i = 0; i < columns; i++) {
      tf_surface_t at;
      const bool is_there =
          surface_at(part(r0, r1, i, columns), part(w0, w1, j, rows), &at);
      map[j * columns + i] = is_there ? at.region : NO_REGION;
    }
  }
  return map;
}

// By how much 1 N of friction brakes the slip of a wheel that rolls forwards,
// [m/s^2]; 0 where there is no such point.
double EXPORT(delassus_at)(double r, double w) {
  tf_surface_t at;
  return surface_at(r, w, &at) ? at.delassus : 0;
}

// Returns: how many there are.
uint32_t EXPORT(find_two_folds)(void) {
  const tf_machine_t *k = machine_begun();
  tf_surface_point_t points[TF_TWO_FOLDS];
  int count = 0;
  if (!k) return 0;
  const tf_input_t input = input_applied();
  if (tf_two_folds(k, &input, points, &count, 0) != TF_OK) return 0;
  for (int i = 0; i < count; i++) {
    two_fold[i][0] = points[i].r;
    two_fold[i][1] = points[i].v;
    two_fold[i][2] = points[i].w;
    two_fold[i][3] = points[i].g;
  }
  return (uint32_t)count;
}

// r, v, omega and g of each of them.
const double *EXPORT(two_folds)(void) { return two_fold[0]; }
