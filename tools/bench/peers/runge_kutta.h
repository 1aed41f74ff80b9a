/// Steps of fixed length in one smooth field: classical Runge-Kutta of order
/// four, and order five of Dormand and Prince (1980).
#pragma once

#include "bench/harness.h"
#include "model.h"

static inline point_t ahead(point_t y, double t, point_t dy) {
  return (point_t){y.r + t * dy.r, y.h + t * dy.h, y.z + t * dy.z,
                   y.t + t * dy.t};
}

// A step: its end, and the estimate of its error but for the part that hangs
// on the rates at the end, which the next step needs anyway.
typedef struct {
  point_t end, error;
} step_t;

// One step of a field whose rates `dy` at y the caller has already.
typedef step_t advance_t(const model_t *k, contact_t c, point_t y, point_t dy,
                         double t);

static inline step_t rk4(const model_t *k, contact_t c, point_t y, point_t dy,
                         double t) {
  const point_t k2 = contact_rates(k, c, ahead(y, t / 2, dy));
  const point_t k3 = contact_rates(k, c, ahead(y, t / 2, k2));
  const point_t k4 = contact_rates(k, c, ahead(y, t, k3));
  const point_t end = ahead(ahead(y, t / 6, dy), t / 3, k2);
  return (step_t){ahead(ahead(end, t / 3, k3), t / 6, k4), {0, 0, 0, 0}};
}

// y + t (b[0] rate[0] + ... + b[n - 1] rate[n - 1])
static inline point_t mixed(point_t y, double t, const point_t *rate,
                            const double *b, int n) {
  point_t sum = {0, 0, 0, 0};
  for (int i = 0; i < n; i++) sum = ahead(sum, b[i], rate[i]);
  return ahead(y, t, sum);
}

// Share of the rates at the end in the estimate of the error of dp5.
static const double dp5_last = -1.0 / 40;

static inline step_t dp5(const model_t *k, contact_t c, point_t y, point_t dy,
                         double t) {
  static const double stage[5][5] = {
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176,
       -5103.0 / 18656}};
  static const double weight[6] = {
      35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
  static const double embedded[6] = {71.0 / 57600,      0,
                                     -71.0 / 16695,     71.0 / 1920,
                                     -17253.0 / 339200, 22.0 / 525};
  point_t rate[6] = {dy};
  for (int i = 0; i < 5; i++)
    rate[i + 1] = contact_rates(k, c, mixed(y, t, rate, stage[i], i + 1));
  return (step_t){mixed(y, t, rate, weight, 6),
                  mixed((point_t){0, 0, 0, 0}, t, rate, embedded, 6)};
}
