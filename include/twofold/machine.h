/// @file
/// The machine: parameters, prepared constants, state, inputs, kinematics. A
/// wheel under a slider (displacement r, speed v) in a disc (speed w) above a
/// turntable (speed omega0). Generalised velocity u = (v, w).
#ifndef TWOFOLD_MACHINE_H
#define TWOFOLD_MACHINE_H

#include "twofold/contact.h"
#include "twofold/real.h"
#include "twofold/status.h"

TF_BEGIN_C

/// The budget of machines that set none (tf_params_t.segments): into how many
/// segments a step may be split by events (changes of the mode, kinks of the
/// force at g = 0), and where a series does not reach the end of the step.
#ifdef TF_REAL_FLOAT
#define TF_LOCATED_SEGMENTS 32
#else
#define TF_LOCATED_SEGMENTS 128
#endif
/// The largest budget.
#define TF_LOCATED_MAX_SEGMENTS 1000

/// The parameters of a machine and of its scheme. Ranges: tf_parameter_ranges.
typedef struct {
  tf_real_t m;       ///< mass of the slider [kg]
  tf_real_t d;       ///< distance of the slider's line from the axis [m]
  tf_real_t beta;    ///< radius of gyration: inertia of disc = beta^2 m [m]
  tf_real_t k2;      ///< spring of the slider [N/m]
  tf_real_t c1;      ///< damping of the disc against ground [N m s]
  tf_real_t c2;      ///< damping of the slider [N s/m]
  tf_real_t r0;      ///< rest position of the spring [m]
  tf_real_t omega0;  ///< speed of the turntable [rad/s]
  tf_real_t mu;      ///< friction force at h -> 0, no coefficient [N]
  tf_real_t kappa;   ///< moment / force in stick [m] (JUMP, TWO_PIECE, SMOOTH)
  tf_real_t gamma;   ///< angle of the wheel to the slider [rad]
  tf_real_t epsilon; ///< width of the smoothed sign [m/s] (SMOOTH)
  tf_real_t k;       ///< string stiffness / mu [1/m^2] (STRING, TWO_PIECE)
  tf_real_t delta;   ///< static pressure limit / mu [1/m] (STRING)
  tf_real_t sigma;   ///< relaxation length [m] (STRING)
  tf_real_t rho;     ///< dynamic / static pressure, dimensionless (STRING)
  tf_real_t a;       ///< half contact length [m] (STRING)
  tf_real_t theta;   ///< of the theta scheme, dimensionless
  tf_real_t dt;      ///< step [s]
  tf_real_t rate;    ///< exit rate of rule `random` [1/s]
  /// Of tf_step_located: error of a segment of its series, relative to the
  /// velocities, dimensionless; and how many segments a step has at most, its
  /// budget, a whole number (any fraction is cut). 0: TF_LOCATED_SEGMENTS.
  tf_real_t tolerance, segments;
  tf_tyre_law_t law;  ///< which tyre
  tf_rule_t rule;     ///< which of several consistent modes
  tf_rest_law_t rest; ///< at h = g = 0 (JUMP)
  bool with_angle;    ///< integrate phi (it is cyclic: nothing depends on it)
} tf_params_t;

/// Range of one real-valued member of tf_params_t.
typedef struct {
  const char *name;    ///< as on the command line
  const char *unit;    ///< "1" where dimensionless
  uint16_t offset;     ///< of the member in tf_params_t [bytes]
  uint16_t laws;       ///< bit set of tf_tyre_law_t that need the member
  tf_real_t low, high; ///< both ends allowed
} tf_parameter_range_t;

/// One for each parameter: validates, names and documents it.
#define TF_PARAMETERS 22
#define tf_parameter_ranges TF_LINK(tf_parameter_ranges)
TF_API_DATA const tf_parameter_range_t tf_parameter_ranges[TF_PARAMETERS];

/// A machine ready to step: constants only, no pointers, may live in flash.
typedef struct {
  tf_real_t m, d, k2, c1, c2, r0, omega0; ///< as in tf_params_t
  tf_real_t sin_gamma, cos_gamma, minus_sin_gamma;
  tf_real_t d_sin_gamma, beta2; ///< [m], beta^2 [m^2]
  tf_real_t dt, theta;
  tf_real_t theta_dt, explicit_dt; ///< theta dt, (1 - theta) dt [s]
  tf_real_t a;        ///< theta dt (c2 + theta dt k2), implicit mass of
                      ///< spring and damper, (4) [kg]
  tf_real_t d_a;      ///< d a [kg m]
  tf_real_t m_plus_a; ///< [kg]
  tf_real_t m_a_d2;   ///< m a d^2 [kg^2 m^2]
  tf_real_t inertia;  ///< m beta^2 + theta dt c1 [kg m^2]
  tf_real_t mu_sin_gamma, mu_d_sin_gamma; ///< [N], [N m]
  tf_real_t inv_mu_dt; ///< 1/(mu dt), 0 where that is not finite
  tf_real_t tolerance; ///< at least 64 epsilon of the real type
  uint16_t segments;   ///< budget of tf_step_located, at least 1
  bool with_angle;
  tf_contact_t contact;
} tf_machine_t;

/// The state: everything that the future depends on. No pointers: memcpy is
/// snapshot, rollback and log record. <= 64 B in double.
typedef struct {
  tf_real_t r;   ///< displacement of the slider [m]
  tf_real_t v;   ///< speed of the slider [m/s]
  tf_real_t w;   ///< speed of the disc [rad/s]
  tf_real_t phi; ///< angle of the disc [rad], 0 unless with_angle; unchecked
  uint64_t tick; ///< steps taken; the counter of the random generator
  uint32_t seed; ///< key of the random generator
  uint8_t mode;  ///< tf_mode_t
} tf_state_t;

/// The inputs, constant over one step but for the speed of the turntable, which
/// goes from omega0 - alpha dt to omega0. Where that is not the omega0 of the
/// step before, the turntable jumps at the start of the step.
typedef struct {
  tf_real_t omega0; ///< speed of the turntable at the end of the step [rad/s]
  tf_real_t r0;     ///< rest position of the spring [m]
  tf_real_t force;  ///< on the slider, along r [N]
  tf_real_t torque; ///< on the disc [N m]
  tf_real_t alpha;  ///< acceleration of the turntable, its mean over the step
                    ///< [rad/s^2] (tf_turntable_to); 0: omega0 throughout, with
                    ///< a jump where it changes. Set it to 0 again when omega0
                    ///< stays
} tf_input_t;

/// Largest sum of |r| [m], |v| [m/s] and |w| [rad/s] that is accepted, and of
/// the magnitudes of the inputs; a step that would leave it returns
/// TF_DIVERGED. Products of four of them stay finite.
#define TF_STATE_LIMIT TF_R(1e9)

/// Smallest |sin(gamma)| with which v follows from h.
#define TF_MIN_SINE TF_R(1e-6)

/// Validates the parameters and derives the constants of a machine.
/// machine: out. params: in, ranges in tf_parameter_ranges.
/// offender: out, may be NULL; index of the first member out of range, or
///   TF_PARAMETERS where law, rule or rest is no member of its enum.
/// Returns: TF_OK; TF_BAD_PARAMETER (machine untouched).
#define tf_prepare TF_LINK(tf_prepare)
TF_API tf_status_t tf_prepare(tf_machine_t *machine, const tf_params_t *params,
                              int *offender);

/// The inputs of a machine that nothing drives: omega0 and r0 of the
/// parameters, no force, no torque.
#define tf_input_default TF_LINK(tf_input_default)
TF_API tf_input_t tf_input_default(const tf_machine_t *machine);

/// Moves the turntable on, as it moves during the next step: to a new omega0,
/// with alpha = (omega0 - its last value)/dt. For a jump do
/// not call this: set omega0, and alpha to 0.
/// input: in/out, of the last step, or of the start. omega0: in, at the end of
///   the step [rad/s]. dt: in, of the machine, > 0 [s].
#define tf_turntable_to TF_LINK(tf_turntable_to)
TF_API void tf_turntable_to(tf_input_t *input, tf_real_t omega0, tf_real_t dt);

/// Slip speeds, (h) and (g): with z = w - omega0 and p = v - d z
///   h = -p sin(gamma) - r z cos(gamma), g = -p cos(gamma) + r z sin(gamma).
/// machine: in. r [m], v [m/s], w, omega0 [rad/s]: in, finite.
#define tf_slip TF_LINK(tf_slip)
TF_API tf_slip_t tf_slip(const tf_machine_t *machine, tf_real_t r, tf_real_t v,
                         tf_real_t w, tf_real_t omega0);

/// Speed v for a given lateral slip speed h at (r, w): (h) solved for v.
/// machine, r, w, omega0, h: in. v: out [m/s].
/// Returns: TF_OK; TF_BAD_STATE where |sin(gamma)| < TF_MIN_SINE: h does not
///   depend on v (v untouched).
#define tf_speed_for_slip TF_LINK(tf_speed_for_slip)
TF_API tf_status_t tf_speed_for_slip(const tf_machine_t *machine, tf_real_t r,
                                     tf_real_t w, tf_real_t omega0, tf_real_t h,
                                     tf_real_t *v);

/// Mechanical energy [J]. Programs watch its balance; no step reads it.
///   m (v - d w)^2/2 + m (beta^2 + r^2) w^2/2 + k2 (r - r0)^2/2
/// machine, state: in. r0: in [m].
#define tf_energy TF_LINK(tf_energy)
TF_API tf_real_t tf_energy(const tf_machine_t *machine, const tf_state_t *state,
                           tf_real_t r0);

TF_END_C

#endif
