/// The core's equations of motion, in double whatever its number type is, for
/// the steppers of `diverge`; the two-fold that stick passes through, from the
/// sliding to the escaping region; and the motion that does so along the weak
/// direction: a canard.
#pragma once

#include "twofold.h"

/// A point of the phase space.
typedef struct {
  double r; ///< [m]
  double p; ///< v - d z [m/s]
  double z; ///< w - omega0 [rad/s]
} cli_point_t;

/// At a point. [2]: for g > 0, for g < 0.
typedef struct {
  cli_point_t rate;    ///< time derivative without friction
  double h, g;         ///< slip speeds [m/s]
  double N, A[2];      ///< h' = N - A lambda [m/s^2], [1/kg]
  double p_F;          ///< p' of F = 1 N
  double stick_arm[2]; ///< of lambda about the axis [m]
  double J;            ///< [kg m^2]
} cli_field_t;
cli_field_t cli_field_at(const tf_machine_t *machine, cli_point_t at);

/// The members of tf_machine_t that it follows from, in double; CLI_WIDE has
/// all but stick_kappa, which belongs to the contact of a machine.
typedef struct {
  double m, d, beta2, k2, c1, c2, r0, omega0, stick_kappa;
  double sin_gamma, cos_gamma, minus_sin_gamma;
} cli_wide_t;
#define CLI_WIDE(k)                                                         \
  .m = (double)(k)->m, .d = (double)(k)->d, .beta2 = (double)(k)->beta2,    \
  .k2 = (double)(k)->k2, .c1 = (double)(k)->c1, .c2 = (double)(k)->c2,      \
  .r0 = (double)(k)->r0, .omega0 = (double)(k)->omega0,                     \
  .sin_gamma = (double)(k)->sin_gamma, .cos_gamma = (double)(k)->cos_gamma, \
  .minus_sin_gamma = (double)(k)->minus_sin_gamma
cli_field_t cli_wide_field_at(const cli_wide_t *machine, cli_point_t at);

/// The state at a point, without a mode.
tf_state_t cli_state_at(const tf_machine_t *machine, cli_point_t at);

/// Delassus scalar [1/kg] at r for the sign of g.
double cli_delassus(const tf_machine_t *machine, double r, double g);

/// The point of h = 0 at (r, z).
cli_point_t cli_point_on_surface(const tf_machine_t *machine, double r,
                                 double z);

/// A two-fold that stick passes through.
typedef struct {
  double r, omega, g; ///< [m], [rad/s], [m/s]
  double v;           ///< [m/s]
  double slope;       ///< dw/dr of the weak direction [rad/(s m)]
  double ratio;       ///< eigenvalue across it / eigenvalue along it, > 1
} cli_two_fold_t;

/// Finds the first one of a machine.
/// Returns: whether there is one.
bool cli_find_two_fold(const tf_machine_t *machine, cli_two_fold_t *out);

/// A point of the canard.
typedef struct {
  double t;    ///< since the two-fold [s]
  double r, z; ///< on h = 0 [m], [rad/s]
} cli_canard_node_t;

/// The canard, from a point in the escaping region back to the two-fold.
#define CLI_CANARD_NODES 2048
typedef struct {
  const tf_machine_t *machine;
  double r, z, v;     ///< two-fold
  double slope;       ///< dz/dr there
  double s;           ///< sign of g
  double rest, decay; ///< r that it tends to [m], z's decay; 0 if it ends
  int steps;          ///< of the integration, from node to node
  int nodes;
  cli_canard_node_t node[CLI_CANARD_NODES]; ///< the last one first
} cli_canard_t;

/// How its computation ended.
typedef enum {
  CLI_CANARD_SOLVED,
  CLI_CANARD_STIFF, ///< the ratio asks for too many steps
  CLI_CANARD_ENTERS ///< nowhere stick comes from the two-fold
} cli_canard_status_t;

/// Computes it.
cli_canard_status_t cli_canard_solve(const tf_machine_t *machine,
                                     const cli_two_fold_t *two_fold,
                                     cli_canard_t *canard);

/// Why it was not computed, as a clause; status: in, not CLI_CANARD_SOLVED.
const char *cli_canard_failure(cli_canard_status_t status);

/// Follows it from the two-fold for a time t.
/// at: out, the point then. reached: out, t, or when it ended.
/// Returns: whether it is still in the escaping region at t.
bool cli_canard_after(const cli_canard_t *canard, double t, cli_point_t *at,
                      double *reached);
