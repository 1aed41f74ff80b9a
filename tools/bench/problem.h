/// @file
/// The problems that all schemes and peers solve: a machine, its start and
/// where the reference says that it ends.
#ifndef TWOFOLD_BENCH_PROBLEM_H
#define TWOFOLD_BENCH_PROBLEM_H

#include "twofold.h"

typedef struct {
  const char *name;
  tf_params_t params;        // law jump, rule persist
  double alpha;              // of the turntable [rad/s^2], whose speed moves
  long double start[3];      // r [m], v [m/s], w [rad/s]
  double h;                  // slip speed at the start [m/s]; not of windows
  double length;             // [s]
  uint8_t mode, mode_at_end; // tf_mode_t
  double end[3];             // r, v, w
  double branch_error;       // an error above it is another branch
} problem_t;

#define PEER_PROBLEMS 4 // the first ones, which peers solve as well
#define PROBLEMS 9
#define REAL (sizeof(tf_real_t) == 8 ? "double" : "float")

/// The problem number i, 0 <= i < PROBLEMS.
problem_t problem_number(int i);

/// The problem of that name. Returns 0 where there is none.
int problem_named(const char *name, problem_t *problem);

/// Largest error of (r, v, w) [m, m/s, rad/s]; infinite where x is not a
/// number.
double problem_error(const problem_t *problem, const double x[3]);

/// Sign of the slip speed at the start, 0 in stick.
static inline int problem_side(const problem_t *problem) {
  if (problem->mode > TF_SLIP_MINUS) return 0;
  return problem->mode == TF_SLIP_PLUS ? 1 : -1;
}

#endif
