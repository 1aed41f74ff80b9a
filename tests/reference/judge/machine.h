/// @file
/// A machine as the judge draws it.
#ifndef REFERENCE_MACHINE_H
#define REFERENCE_MACHINE_H

#include <stdbool.h>

/// Inputs at a time; linear in between.
enum { LIB_KNOTS = 16 };
typedef struct {
  double t, omega0, force, torque;
} lib_knot_t;

/// Parameters of a machine, where it starts and what drives it; enough to
/// replay a run.
typedef struct {
  double m, d, beta, k2, c1, c2, r0, omega0, mu, kappa, gamma;
  bool coulomb;
  double r, v, omega;
  bool on_surface; ///< v is to make h = 0
  double dt;
  int rest;  ///< law at h = g = 0, numbered as by the library
  int knots; ///< 0: omega0 is constant
  lib_knot_t knot[LIB_KNOTS];
  double swing, swing_rate; ///< a sine on top of omega0 [rad/s]
} lib_machine_t;

#endif
