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
                      ///< mode in which its course ends
  uint8_t choices;    ///< how many modes that is
  tf_force_t force;   ///< F [N], M [N m], mean over the step; of
                      ///< tf_step_located at its end
  tf_slip_t slip;     ///< h, g [m/s] at the end of the step
  tf_real_t delassus; ///< Delassus scalar of stick at sign(g) [1/kg]: A; of
                      ///< tf_step -dh+/dx / (mu dt), with its implicit terms
  tf_real_t residual; ///< distance of force from the law at the end of the step
                      ///< [N], by the natural map, in slip without the angle;
                      ///< of a single-valued law |F - law| at the theta point
  tf_status_t status; ///< as returned
} tf_report_t;

/// Finds every mode that may follow from an instant and the one in which a
/// state starts, and reports the law then: slip by the sign of h; at h = 0
/// stick where |lambda| <= mu, else slip by the sign of dh/dt, in an escaping
/// region all three; at h = g = 0 the ways out and, where its law has the force
/// (tf_rest_law_t), rest. |h| or |g| within rounding (32 epsilon times its
/// terms) counts as 0.
/// machine, input: in, at that instant: its omega0 and alpha. report: out.
/// state: in/out. r, v, w are set by the caller, within TF_STATE_LIMIT; mode
///   holds the one preferred where several are possible, or TF_NO_MODE for
///   none, and ends as the mode taken: of h = 0 stick, of h = g = 0 pinned, or
///   what the exit rule takes where the wheel cannot rest. phi, tick and seed
///   keep what they hold.
/// Returns: TF_OK; TF_BAD_STATE (nothing touched).
/// Trust: the set is that of the instant, whatever dt is; a step may find
///   another one. It is empty, and the mode pinned, where the law of rest
///   leaves no future; the hull leaves one but at r = 0 (DESIGN.md, section 5).
#define tf_begin TF_LINK(tf_begin)
TF_API tf_status_t tf_begin(const tf_machine_t *machine, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report);

/// As tf_begin, for a start that is given by its lateral slip speed: v by
/// tf_speed_for_slip; the mode preferred is slip on the side that the sign of h
/// names, none where h is 0.
/// state: in/out, as there, but v and mode are found. h: in [m/s].
/// Returns: TF_OK; TF_BAD_STATE (nothing touched), also where h does not
///   depend on v, which tf_speed_for_slip tells apart.
#define tf_begin_with_slip TF_LINK(tf_begin_with_slip)
TF_API tf_status_t tf_begin_with_slip(const tf_machine_t *machine,
                                      tf_state_t *state,
                                      const tf_input_t *input, tf_real_t h,
                                      tf_report_t *report);

/// Advances the state by dt: Moreau-Jean theta method, linearly implicit in
/// spring, dampers and gyroscopic terms, (1)-(12); the friction law holds at
/// the end of the step. Order 2 in smooth phases for theta = 1/2, else 1.
/// - A step that comes to h = g = 0 goes on from there in the mode that follows
///   (tf_rule_t): its force is a mean of those before and behind, its residual
///   the distance of that from their convex hull.
/// - Where the linearisation would make more than 2^-12 of the energy, or
///   friction put in more than 2^-4, the step is taken in a form that balances
///   energy, and ends in slip on the side on which it is; the set stays that of
///   the consistent modes. So n steps make at most exp(n/4096) - 1 of it; a
///   slip whose spring turns by 1/45 rad a step or more takes that form from
///   2^-20 on.
/// - A step that leaves r as it was while the machine moves, as 32 more would,
///   stalls: its change is less than the rounding of the state. In float at dt
///   <= 1e-4 s every motion departs from rest like that, and some never do: use
///   tf_step_compensated, or a longer dt.
/// machine, input: in. state: in/out, from tf_begin. report: out.
/// Returns: TF_OK; TF_DEGRADED (advanced, although no mode was consistent and
///   admissible: report->set holds the consistent ones); TF_COARSE (advanced,
///   but too long for the motion: taken in the form that balances energy; or
///   the state turns by more than a right angle in it, in the norm of the
///   energy; or theta > 1/2 damps a quarter of the energy; or an impulse of
///   friction ends a slip and changes the velocities by more than a third, or
///   its force changes direction within it and that alone changes them by 3 %;
///   or a slip that several modes may follow passes by h = g = 0, or no force
///   leads along its course there; or a rest ends for less than the step; or
///   the wheel crosses the axis by more than 2 beta); TF_STALLED (advanced, but
///   stalls); TF_BAD_STATE, TF_DIVERGED, TF_STEP_TOO_LONG (state untouched,
///   report holds the status).
/// Trust: TF_OK means that the step ends in a mode of the set; that h and g
///   have the signs which this mode asks for, or are 0 within their rounding;
///   that the step makes no more energy than the shares above; and that law and
///   rule allow what follows h = g = 0. A slip that comes near h = g = 0
///   follows its course there, and the set has the mode in which that ends,
///   although the inclusion of the step may lack it next to r = 0. TF_OK bounds
///   no truncation error. docs/VERIFICATION.md has the steps that were found to
///   break the rest, and how often. All of this holds for the inputs that the
///   step was given: where alpha is 0 and omega0 is not that of the step
///   before, the turntable jumps. So a ramp without alpha (tf_turntable_to) is
///   a chain of jumps, each at the start of its step, and another motion.
#define tf_step TF_LINK(tf_step)
TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report);

// A step that says how far it is off. TF_OK of tf_step excludes causes of a
// wrong step that are known by their symptoms; it does not bound the error of
// a step that is merely too long. This one is taken twice, whole and in
// halves, at three times the cost. A program that does not call it contains
// none of it.

/// tf_step, to the bit, and beside it two steps of dt/2 from the same state.
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
