/// @file
/// The problems that all peers solve, and how an answer is judged.
#ifndef TWOFOLD_PEERS_PROBLEM_H
#define TWOFOLD_PEERS_PROBLEM_H

#include "twofold.h"

typedef struct {
  const char *name;
  tf_params_t params;  // law jump, rule persist
  double alpha;        // of the turntable [rad/s^2], whose speed moves
  double r, omega, h;  // start; v follows from h
  int side;            // sign of h at the start
  double t_end;        // [s]
  double end[3];       // reference r, v, w at t_end
  double branch_error; // an error above it is another branch
} problem_t;

#define PROBLEMS 4

/// The problem number i, 0 <= i < PROBLEMS.
problem_t problem_number(int i);

/// Speed v at the start.
double problem_speed(const problem_t *problem);

/// Largest error of (r, v, w) [m, m/s, rad/s]; infinite where x is not a
/// number.
double problem_error(const problem_t *problem, const double x[3]);

#endif
