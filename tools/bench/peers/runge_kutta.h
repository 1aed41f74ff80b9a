/// Steps of fixed length in one smooth field: classical Runge-Kutta of order
/// four, and order five of Dormand and Prince (1980).
#pragma once

#include "bench/harness.h"
#include "model.h"

static inline point_t ahead(point_t y, real_t t, point_t dy) {
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
                         real_t t);

typedef point_t field_t(const model_t *k, contact_t c, point_t y);

static inline point_t rk4_of(field_t *field, const model_t *k, contact_t c,
                             point_t y, point_t dy, real_t t) {
  const point_t k2 = field(k, c, ahead(y, t / 2, dy));
  const point_t k3 = field(k, c, ahead(y, t / 2, k2));
  const point_t k4 = field(k, c, ahead(y, t, k3));
  const real_t sixth = t / 6;
  return (point_t){y.r + sixth * (dy.r + 2 * (k2.r + k3.r) + k4.r),
                   y.h + sixth * (dy.h + 2 * (k2.h + k3.h) + k4.h),
                   y.z + sixth * (dy.z + 2 * (k2.z + k3.z) + k4.z), y.t + t};
}

static inline step_t rk4(const model_t *k, contact_t c, point_t y, point_t dy,
                         real_t t) {
  return (step_t){rk4_of(contact_rates, k, c, y, dy, t), {0, 0, 0, 0}};
}

// y + t (b[0] rate[0] + ... + b[n - 1] rate[n - 1])
static inline point_t mixed(point_t y, real_t t, const point_t *rate,
                            const real_t *b, int n) {
  point_t sum = {0, 0, 0, 0};
  for (int i = 0; i < n; i++) sum = ahead(sum, b[i], rate[i]);
  return ahead(y, t, sum);
}

// Share of the rates at the end in the estimate of the error of dp5.
static const real_t dp5_last = (real_t)-1 / 40;

static inline step_t dp5(const model_t *k, contact_t c, point_t y, point_t dy,
                         real_t t) {
  static const real_t stage[5][5] = {
      {(real_t)1 / 5},
      {(real_t)3 / 40, (real_t)9 / 40},
      {(real_t)44 / 45, (real_t)-56 / 15, (real_t)32 / 9},
      {(real_t)19372 / 6561, (real_t)-25360 / 2187, (real_t)64448 / 6561,
       (real_t)-212 / 729},
      {(real_t)9017 / 3168, (real_t)-355 / 33, (real_t)46732 / 5247,
       (real_t)49 / 176, (real_t)-5103 / 18656}};
  static const real_t weight[6] = {(real_t)35 / 384,     0,
                                   (real_t)500 / 1113,   (real_t)125 / 192,
                                   (real_t)-2187 / 6784, (real_t)11 / 84};
  static const real_t embedded[6] = {(real_t)71 / 57600,      0,
                                     (real_t)-71 / 16695,     (real_t)71 / 1920,
                                     (real_t)-17253 / 339200, (real_t)22 / 525};
  point_t rate[6] = {dy};
  for (int i = 0; i < 5; i++)
    rate[i + 1] = contact_rates(k, c, mixed(y, t, rate, stage[i], i + 1));
  return (step_t){mixed(y, t, rate, weight, 6),
                  mixed((point_t){0, 0, 0, 0}, t, rate, embedded, 6)};
}

// The usual way to simulate this machine, for comparison: friction smoothed
// over epsilon, libm's tangents, no branches.
static inline void smooth_rk4(const problem_t *problem, const solver_t *solver,
                              double dt, answer_t *answer) {
  const long steps = harness_steps(problem, dt);
  const real_t t = (real_t)(problem->length / (double)steps);
  const contact_t none = {0, 0};
  model_t k = model_of(problem);
  k.epsilon2 = (real_t)(solver->second * solver->second);
  point_t y = model_start(&k, problem);
  for (long i = 0; i < steps; i++)
    y = rk4_of(smooth_rates, &k, none, y, smooth_rates(&k, none, y), t);
  model_end(&k, y, answer->x);
}
