/// @file
/// One step of the machine with its events located: a second scheme beside
/// tf_step, of high order, with the same solution set, rule and report. It is
/// event-driven as that of Piiroinen and Kuznetsov (An event-driven method to
/// simulate Filippov systems with accurate computing of sliding motions, 2008).
/// Cost, which is bounded by the budget of segments, and stack: docs/BOUNDS.md.
#ifndef TWOFOLD_LOCATED_H
#define TWOFOLD_LOCATED_H

#include "twofold/step.h"

TF_BEGIN_C

/// Advances the state by dt and locates every event inside the step: Taylor
/// series in time from event to event, of as many terms as the tolerance asks
/// for (order 3 to 8 in double, to 6 in float). An event is the first root of a
/// polynomial: of h and g in slip, of mu - |lambda|, g and A in stick. Slip
/// leaves h = g = 0 along a limit direction, and stick passes the two-fold
/// along its weak direction, by series that solve the singular equations there;
/// DESIGN.md section 10. The error goes with the tolerance, whatever dt is and
/// across events too. A step takes at most as many segments as the budget of
/// the machine has: what they leave of it is taken by tf_step. In float a
/// motion may stall, as with tf_step, even at dt = 1e-2.
/// machine: in, of law JUMP, COULOMB or NONE.
/// state: in/out, from tf_begin, tf_step or tf_step_located.
/// input: in, within TF_STATE_LIMIT together with the state.
/// report: out; force at the end of the step; set and choices: the largest set
///   of consistent modes met in the step, and the mode taken. residual: how far
///   force is from the law at the end of the step, by the law itself and not by
///   the series: in stick and pinned that of tf_step, in slip |F - law| + |M -
///   law| of tf_tyre_force at report->slip, and |h| where it has not the sign
///   that the mode asks for [N]. It falls with the tolerance. Near h = g = 0 it
///   is epsilon over the slip, because the angle is known no better.
/// Returns: TF_OK; TF_COARSE (the segments of the budget, or a series, did not
///   reach the end: the rest of the step was done by tf_step, from where they
///   had come to, force is the mean over that rest and residual that of
///   tf_step; or the motion stalls, as with tf_step);
///   TF_FELL_BACK (the segments made no way from the start: tf_step took the
///   whole step, and the report is its own. Either no series converged there,
///   or the budget is 1 and its segment ended at once, by an event at the start
///   itself, as where h is below rounding; a later event leaves TF_COARSE);
///   TF_COARSE, TF_DEGRADED (the same, or the rest, and tf_step returned that);
///   TF_BAD_PARAMETER (another law), TF_BAD_STATE, TF_DIVERGED,
///   TF_STEP_TOO_LONG (state untouched, report holds the status).
/// Trust: TF_OK promises what it does of tf_step, with an error that follows
///   the tolerance; where it was found not to, docs/VERIFICATION.md says.
#define tf_step_located TF_LINK(tf_step_located)
TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report);

TF_END_C

#endif
