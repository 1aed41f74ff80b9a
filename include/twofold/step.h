/// @file
/// One step: Moreau-Jean theta scheme.
#ifndef TWOFOLD_STEP_H
#define TWOFOLD_STEP_H

#include "twofold/contact.h"
#include "twofold/machine.h"

TF_BEGIN_C

/// What happened in one step. `set` has every mode that is consistent in the
/// step, with three exceptions:
/// - The step comes to h = g = 0: set has the modes of that point.
/// - A slip passes near h = g = 0: set also has the mode in which it ends.
/// - A slip ends at h = 0: set has the mode that follows there.
typedef struct {
  uint8_t mode;       ///< tf_mode_t, taken
  uint8_t set;        ///< bits TF_MODE_BIT(mode), see above
  uint8_t choices;    ///< number of modes in set
  tf_force_t force;   ///< F [N], M [N m], mean over the step; with
                      ///< tf_step_located, at its end
  tf_slip_t slip;     ///< h, g [m/s] at the end of the step
  tf_real_t delassus; ///< Delassus scalar A of stick at sign(g) [1/kg]; in
                      ///< tf_step: -dh+/dx / (mu dt), with its implicit terms
  tf_real_t residual; ///< distance of force from the law at the end of the step
                      ///< [N] (natural map; in slip the angle is ignored);
                      ///< if the mode changes within the step, distance of the
                      ///< mean from the hull of the law; for a single-valued
                      ///< law |F - law| at the theta point
  tf_status_t status; ///< as returned
} tf_report_t;

/// Finds every mode that may follow an instant, and chooses the one in
/// which a motion starts:
/// - h != 0: slip by the sign of h.
/// - h = 0: stick where |lambda| <= mu, else slip by the sign of dh/dt; in an
///   escaping region all three.
/// - h = g = 0: the modes that leave it, and rest where its law can supply the
///   force (tf_rest_law_t).
/// |h| or |g| within rounding (32 epsilon times its terms) counts as 0.
/// machine, input: in, with omega0 and alpha of that instant. report: out.
/// state: in/out. The caller sets r, v, w, within TF_STATE_LIMIT, and mode: the
///   one preferred where several are possible, or TF_NO_MODE. On return: the
///   mode taken. phi, tick and seed stay.
/// Returns: TF_OK; TF_BAD_STATE (nothing touched).
/// Trust: the set is that of the instant, whatever dt is. It is empty, and the
///   mode pinned, where the law of rest leaves no future.
#define tf_begin TF_LINK(tf_begin)
TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report);

/// As tf_begin, for a start given by its lateral slip speed h:
/// tf_speed_for_slip finds v. Preferred is slip on h's side; if h = 0, none.
/// state: in/out, as there, but v and mode are found. h: in [m/s].
/// Returns: TF_OK; TF_BAD_STATE (nothing touched), also by tf_speed_for_slip.
#define tf_begin_with_slip TF_LINK(tf_begin_with_slip)
TF_API tf_status_t tf_begin_with_slip(const tf_machine_t *machine,
                                      tf_state_t *state,
                                      const tf_input_t *input, tf_real_t h,
                                      tf_report_t *report);

/// Advances the state by dt: Moreau-Jean theta method, linearly implicit in
/// spring, dampers and gyroscopic terms, (1)-(12). The contact mode holds at
/// the end of the step. The order is 2 for theta = 1/2, also where a slip
/// ends, except at h = g = 0. It is 1 there and for other theta.
/// machine, input: in. state: in/out, from tf_begin. report: out.
/// Returns:
///   TF_OK             taken
///   TF_DEGRADED       taken, although no mode is consistent, or none that a
///                     slip may enter (the step takes the one nearest to the
///                     law); or h and g do not end with the mode's signs
///   TF_COARSE         taken, but dt is too long for the motion, see below
///   TF_STALLED        taken, but rounding loses the change of r (still after
///                     32 steps), or of w in stick: use tf_step_compensated
///   TF_BAD_STATE      refused: state or input not finite or out of its range;
///                     the state is untouched, here and below
///   TF_DIVERGED       refused: the end would be out of the range of states
///   TF_STEP_TOO_LONG  refused: the effective mass would be <= 0
/// TF_COARSE, which a smaller dt avoids, has these causes:
///   - Energy: the step would create more than 2^-12 of the energy, or friction
///     would add more than 2^-4. If so, (18) replaces the step.
///   - Turn: the motion turns by more than a right angle, or theta > 1/2 damps
///     a quarter of the energy.
///   - Friction: it reverses a slip and changes the velocities by a third; or
///     it turns: by 3 %; or it ends a slip: by a third, or by 2 % if not split.
///     In firmware with SPLIT=no: the step would be split.
///   - Slip near h = g = 0: several modes may follow there; or no force of 4/3
///     of the hull leads along the slip's course; or the step ends off that by
///     1/4 of the slip; or an earlier change of mode may decide what follows.
///   - Rest: a step that ends at rest may miss an exit, a slip or a stick.
///   - From h = g = 0, or next to it, the motion turns by 0.45 rad, or a spring
///     by 1 rad; or is off its accelerations by 3/16; or comes there too late.
///   - Axis r = 0: a step crosses it by more than 2 beta; or moves or turns the
///     wheel beside it by 1.5 sqrt(beta^2 + r^2) and does not keep its energy.
/// Trust: TF_OK means that the step ends in a mode of the set, with its signs
///   of h and g up to rounding, and creates no more energy than above. By (6),
///   F and M take the start to that end. If a spring is stiff (2^13 theta dt
///   (theta dt k2 + c2) >= m), (18) replaces a slip or frictionless step that
///   would create 2^-20 of its energy; F and M by (6) then lead elsewhere. No
///   truncation error is bounded: see tf_step_estimated and docs/SCHEMES.md.
///   If omega0 changes while alpha is 0, it jumps at the start of the step.
#define tf_step TF_LINK(tf_step)
TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report);

/// Steps as tf_step, to the bit, and estimates the error by two steps of dt/2.
/// machine, input: in. state: in/out, from tf_begin. report: out.
/// accuracy: in, the largest error that is OK, dimensionless.
/// error: out; the difference of the two ends in p = v - d z, R z and r/dt, as
///   a share of |p| + R |z| and the same of their change; z = w - omega0,
///   R^2 = beta^2 + r^2. `tolerance` of the located step is a share of the
///   same. What rounding may contribute is subtracted. TF_REAL_MAX if a half
///   step is refused, 0 if the whole is.
/// Returns: as tf_step; TF_COARSE too where error > accuracy. Under rule RANDOM
///   one draw decides the step and its halves.
/// Trust: an estimate: it misses what the step and its halves have in common.
///   Errors exceeded both 1e-2 and 100 times the estimate in 1 of 412,539 OK
///   steps of moderate machines, and near h = g = 0 in 815 of 428,367
///   (docs/SCHEMES.md). In float the rounding of r/dt is not in the estimate.
#define tf_step_estimated TF_LINK(tf_step_estimated)
TF_API tf_status_t tf_step_estimated(const tf_machine_t *machine,
                                     tf_state_t *state, const tf_input_t *input,
                                     tf_real_t accuracy, tf_report_t *report,
                                     tf_real_t *error);

TF_END_C

#endif
