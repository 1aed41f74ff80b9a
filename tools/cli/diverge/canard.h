/// The core's equations of motion in double, whatever its number type is; and
/// the stick that passes a two-fold along its weak direction, from the sliding
/// to the escaping region: a canard.
#pragma once

#include "twofold.h"

/// The members of a machine that they need.
typedef struct {
  double m, d, beta2, k2, c1, c2, r0, omega0, mu, stick_kappa;
  double sin_gamma, cos_gamma, minus_sin_gamma;
} cli_wide_t;

/// Those of one name in both, from either.
#define CLI_WIDE(k)                                                         \
  .m = (double)(k)->m, .d = (double)(k)->d, .beta2 = (double)(k)->beta2,    \
  .k2 = (double)(k)->k2, .c1 = (double)(k)->c1, .c2 = (double)(k)->c2,      \
  .r0 = (double)(k)->r0, .omega0 = (double)(k)->omega0,                     \
  .sin_gamma = (double)(k)->sin_gamma, .cos_gamma = (double)(k)->cos_gamma, \
  .minus_sin_gamma = (double)(k)->minus_sin_gamma

static inline cli_wide_t cli_widen(const tf_machine_t *k) {
  return (cli_wide_t){CLI_WIDE(k), .mu = (double)k->contact.tyre.mu,
                      .stick_kappa = (double)k->contact.stick_kappa};
}

/// A point of the phase space.
typedef struct {
  double r; ///< [m]
  double p; ///< v - d z [m/s]
  double z; ///< w - omega0 [rad/s]
} cli_point_t;

/// The state at a point, without a mode.
static inline tf_state_t cli_state_at(const cli_wide_t *k, cli_point_t at) {
  return (tf_state_t){.r = (tf_real_t)at.r,
                      .v = (tf_real_t)(at.p + k->d * at.z),
                      .w = (tf_real_t)(at.z + k->omega0),
                      .mode = TF_NO_MODE};
}

/// At a point. [2]: for g > 0, for g < 0.
typedef struct {
  cli_point_t rate;    ///< time derivative without friction
  double h, g;         ///< slip speeds [m/s]
  double N, A[2];      ///< h' = N - A lambda [m/s^2], [1/kg]
  double p_F;          ///< p' of F = 1 N
  double stick_arm[2]; ///< of lambda about the axis [m]
  double J;            ///< [kg m^2]
} cli_field_t;
cli_field_t cli_field_at(const cli_wide_t *k, cli_point_t at);

/// Delassus scalar [1/kg] at r for the sign of g.
double cli_delassus(const cli_wide_t *k, double r, double g);

/// The point of h = 0 at (r, z).
cli_point_t cli_point_on_surface(const cli_wide_t *k, double r, double z);

/// A two-fold that stick passes through.
typedef struct {
  double r, omega, g; ///< [m], [rad/s], [m/s]
  double v;           ///< [m/s]
  double slope;       ///< dw/dr of the weak direction [rad/(s m)]
  double ratio;       ///< eigenvalue across it / eigenvalue along it, > 1
} cli_two_fold_t;

/// A point of the canard.
typedef struct {
  double t;    ///< since the two-fold [s]
  double r, z; ///< on h = 0 [m], [rad/s]
} cli_canard_node_t;

/// The canard, from a point in the escaping region back to the two-fold.
#define CLI_CANARD_NODES 2048
typedef struct {
  const cli_wide_t *machine;
  double r, z, v;     ///< two-fold
  double slope;       ///< dz/dr there
  double s;           ///< sign of g
  double rest, decay; ///< r that it tends to [m], z's decay; 0 if it ends
  int steps;          ///< of the integration, from node to node
  int nodes;
  cli_canard_node_t node[CLI_CANARD_NODES]; ///< the last one first
} cli_canard_t;

/// Computes it. machine: in, kept.
/// Returns: NULL, or why it was not computed, as a clause.
const char *cli_canard_solve(const cli_wide_t *machine,
                             const cli_two_fold_t *two_fold,
                             cli_canard_t *canard);

/// Follows it from the two-fold for a time t.
/// at: out, the point then. reached: out, t, or when it ended.
/// Returns: whether it is still in the escaping region at t.
bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached);
