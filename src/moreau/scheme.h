// One step of the Moreau-Jean theta scheme, from its start to its end, stage by
// stage. tf_step and tf_step_compensated differ in what they start with and in
// how they store the end.
#ifndef TF_SCHEME_H
#define TF_SCHEME_H

#include "balance.h"
#include "balanced.h"
#include "rare_end.h"

// Validation.
TF_INLINE bool may_step(const tf_state_t *state, const tf_input_t *input) {
  return state->mode < TF_MODES && in_range(state, input);
}

// The end of a step, unless it is rare.
TF_INLINE ending_t end_of_step(const tf_machine_t *k, const tf_state_t *state,
                               const tf_input_t *input, start_t start,
                               step_end_t *to) {
  if (!tf_tyre_is_set_valued(k->tyre.law)) return END_SINGLE_VALUED;
  // Free motion, (1)-(7).
  free_motion_t c = free_motion(k, state, input, start);
  if (!c.linear.definite) return END_TOO_LONG;
  // Inclusion, (8), and every mode that solves it.
  inclusion_t in;
  solutions_t s;
  const unsigned signs = solve_inclusion(&c, &in, &s);
  // Choose.
  if (is_near_codim2(&c, &in, signs, s.set)) return END_NEAR_CODIM2;
  const unsigned mode = choose_mode(k, state, &s);
  if (mode == TF_NO_MODE) return END_LEAST_VIOLATED;
  // End in the mode, (9), (10).
  to->end = mode_end(&c, &s, mode);
  if (to->end.turns) return END_TURNING;
  to->outcome = (outcome_t){.mode = mode, .set = s.set, .status = TF_OK};
  to->outcome.delassus = end_delassus(&c, &in, signs, &to->end);
  // Balance.
  return is_in_doubt(k, state, input, to) ? END_IN_DOUBT : END_IN_MODE;
}

// Commit: status_by_signs() where the signs are not plain to see. A turntable
// that stands may bring the wheel to rest; then h and g are off by the rounding
// of the forces that balance, friction and spring, times dt A. As this is
// called last, it needs no registers of the step.
TF_RARE tf_status_t status_of_end(const tf_machine_t *k,
                                  const tf_state_t *state, tf_real_t omega0,
                                  tf_report_t *report) {
  const tf_real_t rounding =
      slip_rounding(k, state->r, state->v, state->w, omega0);
  const tf_real_t force =
      magnitude(report->force.F) + k->k2 * magnitude(state->r);
  const tf_real_t taken = k->dt * magnitude(report->delassus) * force;
  const tf_real_t of_force = omega0 == 0 ? 32 * TF_REAL_EPSILON * taken : 0;
  return status_by_signs(report, rounding + of_force);
}

#endif
