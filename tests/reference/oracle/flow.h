// Follows a leg to what ends it first. Two integrators that share no idea: one
// extrapolates, the other collocates. A switch is located by taking the last
// step again with a smaller length, which costs no accuracy.
#ifndef ORACLE_FLOW_H
#define ORACLE_FLOW_H

#include "leg.h"

// One step: writes the end, returns an estimate of the error.
typedef real (*step_t)(const leg_t *leg, const real y[DIM], real length,
                       real end[DIM]);

typedef struct {
  const char *name;
  step_t step;
  real allowed; // error of a step
  int order;    // of the estimate
} method_t;

// Gragg's midpoint rule, Bulirsch-Stoer extrapolation to order 28.
real step_extrapolated(const leg_t *leg, const real y[DIM], real length,
                       real end[DIM]);
// Gauss-Legendre collocation in 14 points, order 28, by fixed-point iteration.
// Its estimate is the error of the interpolation, far above that of the end.
real step_collocated(const leg_t *leg, const real y[DIM], real length,
                     real end[DIM]);

// Follows the leg from y until a guard falls to 0 or t = until. y becomes the
// end. Stops the program with a message where it cannot.
end_t follow(const method_t *method, const leg_t *leg, real y[DIM], real until);

#endif
