// The equations of motion and their integration by extrapolation: Gragg's
// midpoint rule with 2, 4, 6, ... substeps, extrapolated to order 2 COLUMNS
// (Deuflhard, SIAM Review 27, 1985). It has no table of coefficients, so it is
// as exact as its arithmetic. No line of it is the core's.
#ifndef FINER_MOTION_H
#define FINER_MOTION_H

#include "law.h"

#define STATES 3 // r, v, w

typedef struct {
  law_t law;
  real_t m, d, beta2, k2, c1, c2, r0, omega0, sine, cosine;
  real_t tolerance; // of a step: absolute, in m, m/s, rad/s
  long steps;
  real_t error; // the sum of the estimates of all steps
} motion_t;

typedef struct {
  real_t t, x[STATES];
} point_t;

typedef struct {
  real_t h, g;
} slip_t;

motion_t motion_of(const machine_t *machine, double tolerance);
slip_t slip_at(const motion_t *motion, const real_t x[STATES]);
real_t speed_for(const motion_t *motion, real_t r, real_t w, real_t h);
// The width of the layer in h, and dh'/dh across it; < 0 attracts.
real_t layer_width(const motion_t *motion, real_t g);
real_t layer_rate(const motion_t *motion, const real_t x[STATES]);

// One step of length dt; returns the estimate of its error.
real_t leap(const motion_t *motion, const point_t *from, real_t dt, int columns,
            point_t *to);
// One step that meets the tolerance, or is of 1e-12 s; *dt is what it may take,
// and then what the next one may.
void advance(motion_t *motion, const point_t *from, real_t *dt, point_t *to);

#endif
