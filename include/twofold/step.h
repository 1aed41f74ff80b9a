/// @file
/// One step: Moreau-Jean theta scheme.
#ifndef TWOFOLD_STEP_H
#define TWOFOLD_STEP_H

#include "twofold/contact.h"
#include "twofold/machine.h"

TF_BEGIN_C

/// What happened in one step.
typedef struct {
  uint8_t mode;       ///< tf_mode_t, taken
  uint8_t set;        ///< every consistent mode, bits TF_MODE_BIT(mode); of a
                      ///< step that comes to h = g = 0, those of that point;
                      ///< of a slip that passes it within reach, also the
                      ///< mode in which its course ends; of a slip that is
                      ///< lost at h = 0, the one that follows there
  uint8_t choices;    ///< how many modes that is
  tf_force_t force;   ///< F [N], M [N m], mean over the step; of
                      ///< tf_step_located at its end
  tf_slip_t slip;     ///< h, g [m/s] at the end of the step
  tf_real_t delassus; ///< Delassus scalar of stick at sign(g) [1/kg]: A; of
                      ///< tf_step -dh+/dx / (mu dt), with its implicit terms
  tf_real_t residual; ///< distance of force from the law at the end of the step
                      ///< [N], by the natural map, in slip without the angle;
                      ///< of a mean over a change of mode from its hull;
                      ///< of a single-valued law |F - law| at the theta point
  tf_status_t status; ///< as returned
} tf_report_t;

/// Finds every mode that may follow from an instant and the one in which a
/// state starts: slip by the sign of h; at h = 0 stick where |lambda| <= mu,
/// else slip by the sign of dh/dt, in an escaping region all three; at h = g =
/// 0 the ways out and, where its law has the force (tf_rest_law_t), rest. |h|
/// or |g| within rounding (32 epsilon times its terms) counts as 0.
/// machine, input: in, at that instant: its omega0 and alpha. report: out.
/// state: in/out. The caller sets r, v, w, within TF_STATE_LIMIT, and mode: the
///   one preferred where several are possible, or TF_NO_MODE. It ends as the
///   mode taken. phi, tick and seed keep what they hold.
/// Returns: TF_OK; TF_BAD_STATE (nothing touched).
/// Trust: the set is that of the instant, whatever dt is. It is empty, and the
///   mode pinned, where the law of rest leaves no future.
#define tf_begin TF_LINK(tf_begin)
TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report);

/// As tf_begin, for a start that is given by its lateral slip speed: v by
/// tf_speed_for_slip; the mode preferred is slip on the side that the sign of h
/// names, none where h is 0.
/// state: in/out, as there, but v and mode are found. h: in [m/s].
/// Returns: TF_OK; TF_BAD_STATE (nothing touched), also where h does not
///   depend on v, as tf_speed_for_slip reports.
#define tf_begin_with_slip TF_LINK(tf_begin_with_slip)
TF_API tf_status_t tf_begin_with_slip(const tf_machine_t *machine,
                                      tf_state_t *state,
                                      const tf_input_t *input, tf_real_t h,
                                      tf_report_t *report);

/// Advances the state by dt: Moreau-Jean theta method, linearly implicit in
/// spring, dampers and gyroscopic terms, (1)-(12); the friction law holds at
/// the end of the step. Order 2 for theta = 1/2, also where a slip is lost away
/// from h = g = 0, and 1 else.
/// machine, input: in. state: in/out, from tf_begin. report: out.
/// Returns:
///   TF_OK        the step is taken
///   TF_DEGRADED  taken, although no mode was consistent and admissible
///   TF_COARSE    taken, but too long for the motion; a smaller dt resolves it:
///     - it would create more than 2^-12 of the energy, or friction put in more
///       than 2^-4 (a stiff spring in slip: 2^-20); it then balances energy
///     - the state turns by more than a right angle, or theta > 1/2 damps a
///       quarter of the energy
///     - an impulse of friction reverses a slip and changes the velocities by
///       more than a third; or it ends one at h = g = 0 and changes them by
///       2 %; or its force turns and that changes them by 3 %
///     - a slip that several modes may follow passes by h = g = 0, or no force
///       leads along its course there, or its end is a quarter off that of its
///       course, or its course has changed its mode and that decides the end
///     - a rest ends for less than the step, or the motion behind it turns by
///       0.45 rad or more
///     - the wheel crosses the axis by more than 2 beta; or it moves or turns
///       beside it by more than 1.5 sqrt(beta^2 + r^2) in a step that does not
///       keep its energy
///   TF_STALLED   taken, but rounding loses the change of r, as it would in 32
///                more steps: use tf_step_compensated or a longer dt
///   TF_BAD_STATE, TF_DIVERGED, TF_STEP_TOO_LONG  state untouched
/// Trust: TF_OK means that the step ends in a mode of the set, with the signs
///   of h and g of that mode up to rounding, and creates no more energy than
///   above. F and M lead from the start to that end by (6). But on a stiff
///   spring, 2^13 theta dt (theta dt k2 + c2) >= m, a slip that goes on, or a
///   motion without friction, may take them by (18), which balances energy; (6)
///   ends elsewhere then, by up to the velocities themselves. TF_OK bounds no
///   truncation error (tf_step_estimated does);
///   docs/SCHEMES.md has how often a step is wrong all the same. Where alpha is
///   0 and omega0 is not that of the step before, the turntable jumps.
#define tf_step TF_LINK(tf_step)
TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report);

/// tf_step, to the bit, and beside it two steps of dt/2 from the same state, at
/// three times the cost: an estimate of its error.
/// machine, input: in. state: in/out, from tf_begin. report: out.
/// accuracy: in, the largest error that is OK, dimensionless.
/// error: out; by how much the two ends differ, in p = v - d z, R z and r/dt,
///   as a share of |p| + R |z| and of their change in the step, with R^2 =
///   beta^2 + r^2: what `tolerance` of the located step is a share of. What
///   rounding may make of it is taken off. TF_REAL_MAX where a half is refused,
///   0 where the step is.
/// Returns: as tf_step; TF_COARSE too where error > accuracy. Under rule RANDOM
///   one draw decides the step and its halves.
/// Trust: an estimate, of the end that the halves do not share with the step;
///   what it sees and what it does not: docs/SCHEMES.md, "An estimate".
#define tf_step_estimated TF_LINK(tf_step_estimated)
TF_API tf_status_t tf_step_estimated(const tf_machine_t *machine,
                                     tf_state_t *state, const tf_input_t *input,
                                     tf_real_t accuracy, tf_report_t *report,
                                     tf_real_t *error);

TF_END_C

#endif
