// The surface h = 0 for the page: which region a point lies in, a map of them
// over (r, omega), what friction does to a slip there, and the two-folds.
#include "module.h"

#define MAP_MOST 40000
#define NO_REGION TF_REGIONS // the law has no surface, or the point has no v
static uint8_t map[MAP_MOST];
static double two_fold[TF_TWO_FOLDS][4];

static uint8_t region_at(const tf_machine_t *k, const tf_input_t *input,
                         tf_real_t r, tf_real_t v, tf_real_t w) {
  tf_surface_t at;
  return tf_surface_at(k, input, r, v, w, &at) == TF_OK ? at.region : NO_REGION;
}

static tf_real_t part(double from, double to, uint32_t i, uint32_t count) {
  return from + (to - from) * (((double)i + 0.5) / (double)count);
}

// Regions at the centres of columns x rows cells, row by row from w0 on.
// Returns: 0 where that is more than there is room for, or nothing has begun.
const uint8_t *EXPORT(regions)(double r0, double r1, uint32_t columns,
                               double w0, double w1, uint32_t rows) {
  const tf_machine_t *k = machine_begun();
  if (!k || columns > MAP_MOST || rows > MAP_MOST || columns * rows > MAP_MOST)
    return 0;
  const tf_input_t input = input_applied();
  for (uint32_t j = 0; j < rows; j++) {
    for (uint32_t i = 0; i < columns; i++) {
      const tf_real_t r = part(r0, r1, i, columns), w = part(w0, w1, j, rows);
      tf_real_t v = 0;
      map[j * columns + i] =
          tf_speed_for_slip(k, r, w, input.omega0, 0, &v) == TF_OK
              ? region_at(k, &input, r, v, w)
              : NO_REGION;
    }
  }
  return map;
}

// By how much 1 N of friction brakes the slip of a wheel that rolls forwards,
// [m/s^2]; 0 where there is no such point.
double EXPORT(delassus_at)(double r, double w) {
  const tf_machine_t *k = machine_begun();
  tf_surface_t at = {0};
  tf_real_t v = 0;
  if (!k) return 0;
  const tf_input_t input = input_applied();
  if (tf_speed_for_slip(k, r, w, input.omega0, 0, &v) != TF_OK ||
      tf_surface_at(k, &input, r, v, w, &at) != TF_OK)
    return 0;
  return at.delassus;
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
