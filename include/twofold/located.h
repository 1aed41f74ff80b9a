/// @file
/// One step with its events located: a second scheme beside tf_step, of high
/// order, with the same solution set, rule and report. It is event-driven, like
/// the method of Piiroinen and Kuznetsov (An event-driven method to simulate
/// Filippov systems with accurate computing of sliding motions, 2008).
#ifndef TWOFOLD_LOCATED_H
#define TWOFOLD_LOCATED_H

#include "twofold/step.h"

TF_BEGIN_C

/// Advances the state by dt and locates every event inside the step: Taylor
/// series in time from event to event (order 3 to 8 in double, to 10 below the
/// tolerance 1e-8, to 6 in float), DESIGN.md section 9. An event is the first
/// root of a polynomial: of h and g in slip, of mu - |lambda|, g and A in
/// stick. A rest ends where F and M leave its law or another mode takes it
/// over. The error follows the tolerance, whatever dt is, also across events.
/// If the budget of segments runs out, tf_step finishes the step. In float a
/// motion may stall, as with tf_step, even at dt = 1e-2.
/// machine: in, of law JUMP, COULOMB or NONE. state: in/out, from tf_begin,
///   tf_step or tf_step_located. input: in.
/// report: out; force and residual at the end of the step.
///   set, choices: the largest set met in the step, and the mode taken.
///   residual: distance of force from the law [N]; it falls with the tolerance.
///   In stick and pinned: as in tf_step. In slip |F - law| + |M - law| at
///   report->slip, and |h| where its sign is wrong; near h = g = 0 the angle's
///   rounding, epsilon over the slip.
/// Returns:
///   TF_OK             taken
///   TF_COARSE         taken, but
///     - tf_step finished the step, because the budget ran out or a series did
///       not reach the end: force is the mean over that part, residual its own
///     - or a slip reaches h = g = 0 within the error, where a stick would
///       come to rest
///   TF_FELL_BACK      tf_step took the whole step: no series converged at the
///                     start, or the only segment of the budget met an event
///   TF_STALLED        rounding loses the motion, as in tf_step
///   TF_DEGRADED       as in tf_step; likewise TF_COARSE and TF_STALLED
///   TF_BAD_PARAMETER  refused: another law
///   TF_BAD_STATE, TF_DIVERGED, TF_STEP_TOO_LONG  refused, as in tf_step: the
///                     state is untouched, the report holds the status
/// Trust: TF_OK promises the same as in tf_step, and an error that follows the
///   tolerance. docs/SCHEMES.md lists the known exceptions.
#define tf_step_located TF_LINK(tf_step_located)
TF_API tf_status_t tf_step_located(const tf_machine_t *machine,
                                   tf_state_t *state, const tf_input_t *input,
                                   tf_report_t *report);

/// A change of the contact within a step: its mode changes, a stick passes
/// through a two-fold, or a motion comes to h = g = 0 and has several modes.
typedef struct {
  tf_real_t time;     ///< since the step began [s]
  tf_state_t state;   ///< there, in the mode that follows; tick: of the start
  tf_report_t report; ///< likewise: force at the start of the mode, g with its
                      ///< sign, delassus 0 at a two-fold, set of that instant,
                      ///< residual 0
} tf_located_change_t;

/// tf_step_located, to the bit, which also lists the changes within the step in
/// order. It lists none after tf_step takes over.
/// machine, input: in. state: in/out, likewise. report: out.
/// list: out, [room]. count: out; the number of changes. The list has the first
///   room of them.
/// Returns: as tf_step_located.
#define tf_step_located_changes TF_LINK(tf_step_located_changes)
TF_API tf_status_t tf_step_located_changes(
    const tf_machine_t *machine, tf_state_t *state, const tf_input_t *input,
    tf_report_t *report, tf_located_change_t *list, size_t room, size_t *count);

TF_END_C

#endif
