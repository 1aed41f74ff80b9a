// The status of a step whose end is recorded in state and report.
#ifndef TF_COMMIT_H
#define TF_COMMIT_H

#include "outcome.h"

// status_by_signs() where the signs are not plain to see. A turntable that
// stands may bring the wheel to rest; then h and g are off by the rounding of
// the forces that balance, friction and spring, times dt A. As this is called
// last, it needs no registers of the step.
TF_RARE tf_status_t status_of_end(const tf_machine_t *k,
                                  const tf_state_t *state, tf_real_t omega0,
                                  tf_report_t *report) {
  const tf_real_t rounding =
      slip_rounding(k, state->r, state->v, state->w, omega0);
  const tf_real_t force =
      magnitude(report->force.F) + k->k2 * magnitude(state->r);
  const tf_real_t taken = k->dt * magnitude(report->delassus) * force;
  const tf_real_t of_force = omega0 == 0 ? SLIP_ROUNDINGS * taken : 0;
  return status_by_signs(report, rounding + of_force);
}

#endif
