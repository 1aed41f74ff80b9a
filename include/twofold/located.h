/// @file
/// One step of the machine with its switches located: a second scheme beside
/// tf_step, of high order, with the same solution set, rule and report.
#ifndef TWOFOLD_LOCATED_H
#define TWOFOLD_LOCATED_H

#include "twofold/step.h"

/// Segments that one step is split into at its tolerance, by switches of mode,
/// by kinks of the force at g = 0 and where the series does not reach to the
/// end. Where they are not enough the tolerance grows with what is left to do.
#define TF_LOCATED_SEGMENTS 32
/// Most segments of one step.
#define TF_LOCATED_MOST_SEGMENTS (4 * TF_LOCATED_SEGMENTS)

/// Advances the state by dt, with every switch of mode located inside.
/// Scheme: Taylor series in time, of order 8 in double and 6 in float, from
///   switch to switch. A switch is the first root of a polynomial: h = 0 in
///   slip, |lambda| = mu, g = 0 and A = 0 in stick. Slip leaves h = g = 0 along
///   a limit direction, and stick passes the two-fold along its weak
///   direction, by series that solve the singular equations there; DESIGN.md
///   section 10. The error falls with dt in its order, across switches too, but
///   for h = g = 0 and two-folds: there the tolerance holds it, not the step.
///   In float it may stand still after a rest, as tf_step, even at dt = 1e-2.
/// machine: in, prepared; law JUMP, COULOMB or NONE.
/// state: in/out, from tf_begin, tf_step or tf_step_located.
/// input: in, within TF_STATE_LIMIT together with the state.
/// report: out; force at the end of the step; set and choices: the largest set
///   of futures met in the step, and the mode taken. residual: how far force is
///   from the law at the end of the step, by the law itself and not by the
///   series: in stick and pinned tf_law_residual, in slip |F - law| + |M - law|
///   of tf_tyre_force at report->slip, and |h| where its side is not that of
///   the mode [N]. It falls with the tolerance; near h = g = 0 it is epsilon
///   over the slip, which the angle is known to.
/// Returns: TF_OK; TF_COARSE (TF_LOCATED_SEGMENTS segments were not enough: what
///   was left of the step was done with a coarser tolerance, as fine as the
///   segments up to TF_LOCATED_MOST_SEGMENTS allow and 1e-6 at most, 1e-3 in
///   float); TF_FELL_BACK (nor were those, or a series did not converge: the
///   whole step was taken by tf_step, whose report this is); TF_DEGRADED (the
///   same, and tf_step said so);
///   TF_BAD_PARAMETER (another law), TF_BAD_STATE, TF_DIVERGED,
///   TF_STEP_TOO_LONG (state untouched, report holds the status).
/// Cost: at most 3800000 instructions, the worst found by search, of
///   TF_LOCATED_MOST_SEGMENTS segments and a tf_step; one segment where the
///   motion does not switch (`make bench`). Stack: 2832 B.
/// Memory: caller's, no overlap, reentrant.
/// Claims: located_order_of_convergence, located_order_across_stick,
///   located_branch_and_events,
///   located_finer_tolerance_is_no_worse, located_two_fold_in_one_step,
///   located_steps_keep_to_the_reference, located_falls_back_and_says_so,
///   located_residual_is_that_of_the_law,
///   located_switch_at_the_end_of_a_step,
///   located_angle_is_the_integral_of_the_speed,
///   located_escaping_stick_lets_go_to_the_other_side,
///   located_delassus_is_that_of_the_side_of_g,
///   located_set_holds_the_mode, located_is_coarse_only_where_it_has_to_be,
///   located_refuses_to_leave_the_range_of_states
#define tf_step_located TF_LINK(tf_step_located)
TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report);

#endif
