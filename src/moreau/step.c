// One step: linearise, enumerate what friction allows, choose, advance.
#include "twofold/step.h"

#include "stages.h"

TF_INLINE tf_status_t commit(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, tf_end_t end,
                             unsigned mode, unsigned set, tf_real_t delassus,
                             tf_status_t status, tf_report_t *report) {
  // A Delassus scalar that overflows tells that the slopes of h and g did.
  if (!in_reach(end.r, end.v, end.w) || !within(delassus, TF_REAL_MAX))
    return refuse(report, TF_DIVERGED);
  const tf_slip_t slip = slip_speeds(k, end.r, end.v, end.w - input->omega0);
  const tf_real_t rest = residual(k, mode, end.force, slip);
  if (k->with_angle) // (12)
    state->phi += k->explicit_dt * state->w + k->theta_dt * end.w;
  return record(state, end, slip, rest, mode, set, delassus, status, report);
}

TF_RARE tf_status_t step_degraded(const tf_machine_t *k, tf_state_t *state,
                                  const tf_input_t *input,
                                  tf_report_t *report) {
  const motion_t c = motion(k, state, NULL, input);
  const least_t best = least_violating(&c);
  return commit(k, state, input, best.end.at, best.mode, best.set,
                best.delassus, TF_DEGRADED, report);
}

TF_RARE bool met_rest(const tf_machine_t *k, const tf_state_t *state,
                      const tf_input_t *input, unsigned set,
                      unsigned attracting) {
  const motion_t c = motion(k, state, NULL, input);
  tf_inclusion_t in = inclusion(&c);
  complete(&c, &in);
  return meets_rest(&c, &in, set, attracting);
}

// Apart from the search of the force for the sake of the stack.
TF_RARE tf_status_t step_under(const tf_machine_t *k, tf_state_t *state,
                               const tf_input_t *input, tf_report_t *report,
                               tf_real_t F, tf_real_t M) {
  const motion_t c = motion(k, state, NULL, input);
  end_t end;
  tf_real_t rest;
  const unsigned mode = mode_under(&c, (tf_force_t){F, M}, &end, &rest);
  const tf_status_t status = commit(k, state, input, end.at, mode,
                                    TF_MODE_BIT(mode), 0, TF_OK, report);
  if (status == TF_OK) report->residual = rest;
  return status;
}

TF_RARE tf_status_t step_single_valued(const tf_machine_t *k, tf_state_t *state,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const motion_t c = motion(k, state, NULL, input);
  if (!c.linear.definite) return refuse(report, TF_STEP_TOO_LONG);
  const tf_force_t force = single_valued_force(&c);
  return step_under(k, state, input, report, force.F, force.M);
}

TF_API tf_status_t tf_step(const tf_machine_t *machine, tf_state_t *state,
                           const tf_input_t *input, tf_report_t *report) {
  const tf_machine_t *k = machine;
  unsigned mode = state->mode;
  if (mode >= TF_MODES || !in_range(state, input))
    return refuse(report, TF_BAD_STATE);
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return step_single_valued(k, state, input, report);
  const motion_t c = motion(k, state, NULL, input);
  if (!c.linear.definite) return refuse(report, TF_STEP_TOO_LONG);
  tf_inclusion_t in = inclusion(&c);
  const unsigned signs = signs_of(&in.g);
  if (signs == 3) complete(&c, &in);
  tf_solutions_t s = {0};
  solve(&in, signs, &s);
  // What goes on under every rule is not asked of tf_select.
  if (signs == 3 && !(s.set & TF_MODE_BIT(mode)) &&
      met_rest(k, state, input, s.set, s.attracting))
    s.set |= (uint8_t)TF_MODE_BIT(mode = TF_PINNED);
  else if (!(s.set & TF_MODE_BIT(mode) & (SLIPS | s.attracting)))
    mode = select_again(k, state, s.set, s.near_stick, s.h_limit[0],
                        s.h_limit[1], s.attracting);
  if (mode == TF_MODES) return step_degraded(k, state, input, report);
  const end_t end = mode_end(&c, &s, mode);
  const bool minus = signs == 3 ? slip_of(&c, &end).g < 0 : signs == 2;
  const tf_real_t h1 = minus ? in.h.F - in.h.M : in.h.F + in.h.M;
  return commit(k, state, input, end.at, mode, s.set, -h1 * k->inv_mu_dt, TF_OK,
                report);
}
