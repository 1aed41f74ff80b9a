/// The problems that all schemes and peers solve: a machine, its start and
/// where the reference says that it ends.
#pragma once

#include "twofold.h"

typedef struct {
  const char *name;
  tf_params_t params;        // rule persist
  double alpha;              // of the turntable [rad/s^2], whose speed moves
  long double start[3];      // r [m], v [m/s], w [rad/s]
  double h;                  // slip speed at the start [m/s]
  double length;             // [s]
  uint8_t mode, mode_at_end; // tf_mode_t
  double end[3];             // r, v, w
  double branch_error;       // an error above it is another branch
} problem_t;

#define PROBLEMS 9

/// The problem number i, 0 <= i < PROBLEMS.
problem_t problem_number(int i);

/// The problem of that name. Returns 0 where there is none.
int problem_named(const char *name, problem_t *problem);

/// Largest error of (r, v, w) [m, m/s, rad/s]; infinite where x is not a
/// number.
double problem_error(const problem_t *problem, const double x[3]);
