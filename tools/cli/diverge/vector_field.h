/// @file
/// The equations of motion in double precision, for the steppers of `diverge`,
/// in the variables in which the mass matrix of friction is diagonal.
#ifndef TWOFOLD_CLI_VECTOR_FIELD_H
#define TWOFOLD_CLI_VECTOR_FIELD_H

#include "twofold.h"

/// A point of the phase space.
typedef struct {
  double r; ///< [m]
  double p; ///< v - d z [m/s]
  double z; ///< w - omega0 [rad/s]
} cli_point_t;

/// Time derivative of a point under the friction force F and moment M.
cli_point_t cli_vector_field(const tf_machine_t *machine, cli_point_t at,
                             double F, double M);

/// Slip speeds at a point.
tf_slip_t cli_slip_at(const tf_machine_t *machine, cli_point_t at);

/// The state at a point, without a mode; and the point of a state.
tf_state_t cli_state_at(const tf_machine_t *machine, cli_point_t at);
cli_point_t cli_point_of(const tf_machine_t *machine, const tf_state_t *state);

/// Delassus scalar [1/kg] at r for the sign of g.
double cli_delassus(const tf_machine_t *machine, double r, double g);

/// The point of h = 0 at (r, z).
cli_point_t cli_point_on_surface(const tf_machine_t *machine, double r,
                                 double z);

/// Change of h in time when the point moves at a rate [m/s^2].
double cli_slip_rate(const tf_machine_t *machine, cli_point_t at,
                     cli_point_t rate);

/// h' without friction [m/s^2].
double cli_free_slip_rate(const tf_machine_t *machine, cli_point_t at);

/// The sliding vector field multiplied by A, (A r', A z') on h = 0: it is
/// regular where A = 0. s: sign of g.
void cli_sliding_field(const tf_machine_t *machine, double r, double z,
                       double s, double out[2]);

#endif
