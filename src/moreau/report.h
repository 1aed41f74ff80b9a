// What a step leaves behind: state and report, or the refusal, and the status
// by which they say how far the step can be trusted: whether its end has the
// signs of its mode, and whether it stalls. Every scheme ends with it.
#ifndef TF_REPORT_H
#define TF_REPORT_H

#include "../friction/inclusion.h"
#include "../friction/mode_set.h"
#include "../model/mechanics.h"
#include "twofold/step.h"

// What a step has decided.
typedef struct {
  unsigned mode, set;
  tf_status_t status; // below TF_OK: it is refused
  tf_real_t delassus;
  tf_real_t residual; // of a single-valued law
  bool is_mean;       // the force is a mean of those before and behind a change
  bool is_balanced;   // it ends in the form that creates no energy
} outcome_t;

// Of a slip only the side is checked, not the angle. The mean force of a step
// that passes h = g = 0 is compared with the convex hull of the law.
TF_INLINE tf_real_t mode_residual(const tf_machine_t *k,
                                  const outcome_t *outcome, tf_force_t force,
                                  tf_slip_t slip) {
  const unsigned mode = outcome->mode;
  if (!tf_tyre_is_set_valued(k->contact.tyre.law)) return outcome->residual;
  if (outcome->is_mean && k->contact.stick_kappa > 0)
    return rest_residual(TF_REST_HULL, k->contact.tyre.mu,
                         k->contact.stick_kappa, force);
  if (outcome->is_mean) // |F| <= mu, |M| = 0
    return force_residual(k->contact.tyre.mu, force.F, 0);
  if (mode == TF_PINNED && k->contact.stick_kappa > 0)
    return rest_residual(k->contact.rest, k->contact.tyre.mu,
                         k->contact.stick_kappa, force);
  if (!is_slip(mode))
    return law_residual(k->contact.tyre.mu, k->contact.stick_kappa, force,
                        slip.h, slip.g);
  return law_residual(1, 0, (tf_force_t){unit(sign_in(mode)), 0}, slip.h,
                      slip.g);
}

TF_INLINE tf_status_t refuse_step(tf_report_t *report, tf_status_t status) {
  report->status = status;
  return status;
}

TF_INLINE void record(tf_state_t *state, end_state_t end, tf_slip_t slip,
                      tf_force_t force, tf_real_t residual, outcome_t outcome,
                      tf_report_t *report) {
  report->mode = (uint8_t)outcome.mode;
  report->set = (uint8_t)outcome.set;
  report->choices = (uint8_t)size_of(outcome.set);
  report->force = force;
  report->slip = slip;
  report->delassus = outcome.delassus;
  report->residual = residual;
  report->status = outcome.status;
  state->r = end.r;
  state->v = end.v;
  state->w = end.w;
  state->mode = (uint8_t)outcome.mode;
  state->tick++;
}

// Whether h and g have the signs of the mode, but for their rounding: off h = 0
// that of h, on it h = 0 and that of g.
TF_INLINE bool has_signs_of_mode(unsigned mode, tf_slip_t slip,
                                 tf_real_t rounding) {
  if (mode == TF_SLIP_PLUS) return slip.h >= -rounding;
  if (mode == TF_SLIP_MINUS) return slip.h <= rounding;
  if (!within(slip.h, rounding)) return false;
  if (mode == TF_STICK_PLUS) return slip.g >= -rounding;
  if (mode == TF_STICK_MINUS) return slip.g <= rounding;
  return within(slip.g, rounding);
}

// The same where it is plain to see: with one term of the rounding of h and
// none of that of g. Rest, which is rare, is left to has_signs_of_mode().
TF_INLINE bool plainly_has_signs(const tf_machine_t *k, unsigned mode,
                                 tf_slip_t slip, end_state_t at) {
  const tf_real_t least = SLIP_ROUNDINGS * magnitude(k->d * at.w);
  if (mode == TF_STICK_MINUS) return slip.g < 0 && within(slip.h, least);
  if (mode == TF_STICK_PLUS) return slip.g > 0 && within(slip.h, least);
  if (mode == TF_PINNED) return false;
  return mode == TF_SLIP_PLUS ? slip.h > 0 : slip.h < 0;
}

// The status of a step that has been taken, by the signs of its end.
TF_INLINE tf_status_t status_by_signs(tf_report_t *report, tf_real_t rounding) {
  if (!has_signs_of_mode(report->mode, report->slip, rounding))
    report->status = TF_DEGRADED;
  return report->status;
}

// status_by_signs() where the signs are not plain to see, of a step that is
// recorded in state and report.
#define tf_status_of_end TF_LINK(tf_status_of_end)
__attribute__((noinline, cold)) TF_API tf_status_t
tf_status_of_end(const tf_machine_t *k, const tf_state_t *state,
                 const tf_input_t *u, tf_report_t *report);

// The status of a step that is recorded likewise and has left r as it was:
// whether the motion stalls.
#define tf_status_of_stall TF_LINK(tf_status_of_stall)
__attribute__((noinline)) TF_API tf_status_t
tf_status_of_stall(const tf_machine_t *k, const tf_input_t *u,
                   const tf_state_t *x, tf_report_t *report);

#endif
