/// @file
/// One step of the machine with its events located: a second scheme beside
/// tf_step, of high order, with the same solution set, rule and report. It is
/// event-driven as that of Piiroinen and Kuznetsov (An event-driven method to
/// simulate Filippov systems with accurate computing of sliding motions, 2008).
#ifndef TWOFOLD_LOCATED_H
#define TWOFOLD_LOCATED_H

#include "twofold/step.h"

TF_BEGIN_C

/// Advances the state by dt and locates every event inside the step: Taylor
/// series in time from event to event (order 3 to 8 in double, to 10 below the
/// tolerance 1e-8, to 6 in float), DESIGN.md section 9. An event is the first
/// root of a polynomial: of h and g in slip, of mu - |lambda|, g and A in
/// stick; a rest ends where F and M leave its law or another mode takes it
/// over. The error goes with the tolerance, whatever dt is and across events
/// too. If the budget of segments runs out, tf_step finishes the step. In float
/// a motion may stall, as with tf_step, even at dt = 1e-2.
/// machine: in, of law JUMP, COULOMB or NONE. state: in/out, from tf_begin,
///   tf_step or tf_step_located. input: in.
/// report: out; force at the end of the step; set and choices: the largest set
///   of consistent modes met in the step, and the mode taken. residual: how far
///   force is from the law at the end of the step, which falls with the
///   tolerance: in stick and pinned that of tf_step, in slip |F - law| + |M -
///   law| of tf_tyre_force at report->slip, and |h| where its sign is not that
///   of the mode [N]; near h = g = 0 epsilon over the slip, because
///   the angle is known no better.
/// Returns: TF_OK; TF_COARSE (the segments of the budget, or a series, did not
///   reach the end: tf_step did the rest of the step, over which force is the
///   mean and whose residual it is; or a slip comes to h = g = 0 within the
///   error, and would rest there had it stuck before); TF_STALLED (it stalls);
///   TF_FELL_BACK (they made no way from the start, where no series converged
///   or the one segment of the budget met an event: tf_step took the whole
///   step, and the report is its own); TF_COARSE, TF_STALLED, TF_DEGRADED (the
///   same, or the rest, and tf_step returned that); TF_BAD_PARAMETER (another
///   law), TF_BAD_STATE, TF_DIVERGED, TF_STEP_TOO_LONG (state untouched, report
///   holds the status).
/// Trust: TF_OK promises what it does of tf_step, with an error that follows
///   the tolerance; where it was found not to, docs/VERIFICATION.md says.
#define tf_step_located TF_LINK(tf_step_located)
TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report);

/// A change of the contact within a step: its mode changes, a stick passes
/// through a two-fold, or a motion comes to h = g = 0 and has several modes.
typedef struct {
  tf_real_t time;     ///< since the step began [s]
  tf_state_t state;   ///< there, in the mode that follows; tick: of the start
  tf_report_t report; ///< likewise: force at its begin, g of its sign, delassus
                      ///< 0 at a two-fold; set: consistent there; residual 0
} tf_located_change_t;

/// tf_step_located, to the bit, with the changes within the step in their
/// order. A step that tf_step takes or finishes has none from there on.
/// machine, input: in. state: in/out, likewise. report: out.
/// list: out, [room]. count: out; how many there were: what is beyond room is
///   not in the list.
/// Returns: as tf_step_located.
#define tf_step_located_changes TF_LINK(tf_step_located_changes)
TF_API tf_status_t tf_step_located_changes(
    const tf_machine_t *machine, tf_state_t *state, const tf_input_t *input,
    tf_report_t *report, tf_located_change_t *list, size_t room, size_t *count);

TF_END_C

#endif
