/// @file
/// The two-fold that stick passes through, from the sliding to the escaping
/// region, and the motion that does so along the weak direction: a canard.
#ifndef TWOFOLD_CLI_CANARD_H
#define TWOFOLD_CLI_CANARD_H

#include <stdbool.h>

#include "vector_field.h"

/// A two-fold that stick passes through.
typedef struct {
  double r, omega, g; ///< [m], [rad/s], [m/s]
  double v;           ///< [m/s]
  double slope;       ///< dw/dr of the weak direction [rad/(s m)]
} cli_two_fold_t;

/// Finds the first one of a machine.
/// Returns: whether there is one.
bool cli_find_two_fold(const tf_machine_t *machine, cli_two_fold_t *out);

/// Stick on the weak direction, at a distance [m] before the two-fold.
tf_state_t cli_before_two_fold(const tf_machine_t *machine,
                               const cli_two_fold_t *two_fold, double distance);

/// The canard, a curve z(r) on h = 0.
#define CLI_CANARD_TERMS 14
typedef struct {
  const tf_machine_t *machine;
  double r, z;                ///< two-fold
  double s;                   ///< sign of g
  double reach;               ///< the curve is valid within r +- reach [m]
  double c[CLI_CANARD_TERMS]; ///< z - z* = x sum c[n] x^n, x = (r - r*) / reach
} cli_canard_t;

/// Computes it.
/// Returns: whether the iteration converged.
bool cli_canard_solve(const tf_machine_t *machine,
                      const cli_two_fold_t *two_fold, cli_canard_t *canard);

/// Follows it from the two-fold for a time t.
/// at: out, the point then. reached: out, t, or when |lambda| = mu ended it.
/// Returns: whether it is still in the escaping region at t.
bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached);

#endif
