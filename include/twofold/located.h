/// @file
/// One step of the machine with its events located: a second scheme beside
/// tf_step, of high order, with the same solution set, rule and report. It is
/// event-driven as that of Piiroinen and Kuznetsov (An event-driven method to
/// simulate Filippov systems with accurate computing of sliding motions, 2008).
#ifndef TWOFOLD_LOCATED_H
#define TWOFOLD_LOCATED_H

#include "twofold/step.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Advances the state by dt and locates every event inside the step.
/// Scheme: Taylor series in time from event to event, of as many terms as the
///   tolerance asks for: order 3 to 8 in double, to 6 in float. An event is the
///   first root of a polynomial: of h and g in slip, of mu - |lambda|, g and A
///   in stick. Slip leaves h = g = 0 along a
///   limit direction, and stick passes the two-fold along its weak direction,
///   by series that solve the singular equations there; DESIGN.md section 10.
///   The error goes with the tolerance, whatever dt is and across events too.
///   A step takes at most as many segments as the budget of the machine has:
///   what they leave of it is taken by tf_step.
///   In float a motion may stand still, as with tf_step, even at dt = 1e-2.
/// machine: in, prepared; law JUMP, COULOMB or NONE.
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
///   tf_step; or the motion stands still, as with tf_step);
///   TF_FELL_BACK (the segments made no way from the start: tf_step took the
///   whole step, and the report is its own. Either no series converged there,
///   or the budget is 1 and its segment ended at once, by an event at the start
///   itself, as where h is below rounding; a later event leaves TF_COARSE);
///   TF_COARSE, TF_DEGRADED (the same, or the rest, and tf_step returned that);
///   TF_BAD_PARAMETER (another law), TF_BAD_STATE, TF_DIVERGED,
///   TF_STEP_TOO_LONG (state untouched, report holds the status).
/// Trust: TF_OK promises what it does of tf_step, with an error that follows
///   the tolerance. Not so, by an independent reference: one of 791 motions
///   through h = g = 0 at dt = 1e-4, and past r = 0 2 of 2000 stiff runs gain
///   energy (docs/VERIFICATION.md).
/// Cost: at most 28000 instructions and 87000 a segment of the budget, the
///   worst found by search: the former that leaves h = g = 0 at the start
///   and one in tf_step at the end. No budget takes more than
///   330000 and 570000 by the longest way. One segment where the motion has no
///   event (`make bench`). Stack: 5856 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: located_error_follows_the_tolerance,
///   located_tolerance_holds_across_stick, located_budget_is_kept,
///   located_more_segments_are_better,
///   located_branch_is_independent_of_the_step_size,
///   located_finer_tolerance_is_no_worse, located_two_fold_in_one_step,
///   located_steps_keep_to_the_reference, located_falls_back_and_says_so,
///   located_residual_is_that_of_the_law,
///   located_event_at_the_end_of_a_step,
///   located_angle_is_the_integral_of_the_speed,
///   located_escaping_stick_ends_in_slip_of_the_other_side,
///   located_delassus_is_that_of_the_side_of_g,
///   located_set_holds_the_mode, located_refuses_to_leave_the_range_of_states,
///   no_scheme_stands_still_without_a_word
#define tf_step_located TF_LINK(tf_step_located)
TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report);

#ifdef __cplusplus
}
#endif

#endif
