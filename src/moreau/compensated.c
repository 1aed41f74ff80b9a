// The step that carries the rounding of its state along. Its own object file:
// a program that does not call it has none of it.
#include "twofold/compensated.h"

#include "stages.h"

// All digits of the end of a step under a force, and of the change c of p and z
// that answers it. It derives the inverse anew: as a function of its own, which
// a step ends with, its pairs and those of the step need no stack together.
// `figure` is the Delassus scalar or, of a single-valued law, the residual.
static __attribute__((noinline)) tf_status_t finish(
    const tf_compensated_t *more, tf_state_t *state, tf_compensation_t *carry,
    const tf_input_t *input, tf_report_t *report, unsigned set_and_mode,
    tf_status_t status, tf_real_t F, tf_real_t M, tf_real_t dp, tf_real_t dz,
    tf_real_t figure) {
  const tf_machine_t *k = &more->machine;
  const unsigned mode = set_and_mode % 8, set = set_and_mode / 8;
  const bool jumps = tf_tyre_is_set_valued(k->tyre.law);
  const tf_linear_t l = linearise(k, state, input);
  const whole_t x = whole(state, carry);
  const tf_force_t force = {F, M};
  const whole_t to = mode == TF_PINNED ? whole_rest(k, &x, input->omega0)
                                       : whole_end(more, &x, input, &l, force,
                                                   moment_rest(k, mode, force),
                                                   (tf_change_t){dp, dz});
  if (!in_reach(to.r.hi, to.v.hi, to.w.hi) || !within(figure, TF_REAL_MAX))
    return refuse(report, TF_DIVERGED);
  const tf_slip_t slip = motion_at(more, &to, input->omega0).slip;
  carry_on(more, state, carry, &to);
  return record(state, (tf_end_t){force, to.r.hi, to.v.hi, to.w.hi}, slip,
                jumps ? residual(k, mode, force, slip) : figure, mode, set,
                jumps ? figure : 0, status, report);
}

TF_RARE tf_status_t step_degraded(const tf_compensated_t *k, tf_state_t *state,
                                  tf_compensation_t *carry,
                                  const tf_input_t *input,
                                  tf_report_t *report) {
  const motion_t c = motion(&k->machine, state, &(digits_t){k, carry}, input);
  const least_t best = least_violating(&c);
  const end_t *to = &best.end;
  return finish(k, state, carry, input, report, best.mode + 8 * best.set,
                TF_DEGRADED, to->at.force.F, to->at.force.M, to->change.p,
                to->change.z, best.delassus);
}

TF_RARE bool met_rest(const tf_compensated_t *k, const tf_state_t *state,
                      const tf_compensation_t *carry, const tf_input_t *input,
                      unsigned set, unsigned attracting) {
  const motion_t c = motion(&k->machine, state, &(digits_t){k, carry}, input);
  tf_inclusion_t in = inclusion(&c);
  complete(&c, &in);
  return meets_rest(&c, &in, set, attracting);
}

// Apart from the search of the force for the sake of the stack.
TF_RARE tf_status_t step_under(const tf_compensated_t *k, tf_state_t *state,
                               tf_compensation_t *carry,
                               const tf_input_t *input, tf_report_t *report,
                               tf_real_t F, tf_real_t M) {
  const motion_t c = motion(&k->machine, state, &(digits_t){k, carry}, input);
  end_t to;
  tf_real_t rest;
  const unsigned mode = mode_under(&c, (tf_force_t){F, M}, &to, &rest);
  return finish(k, state, carry, input, report, mode + 8 * TF_MODE_BIT(mode),
                TF_OK, F, M, to.change.p, to.change.z, rest);
}

TF_RARE tf_status_t step_single_valued(const tf_compensated_t *k,
                                       tf_state_t *state,
                                       tf_compensation_t *carry,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const motion_t c = motion(&k->machine, state, &(digits_t){k, carry}, input);
  if (!c.linear.definite) return refuse(report, TF_STEP_TOO_LONG);
  const tf_force_t force = single_valued_force(&c);
  return step_under(k, state, carry, input, report, force.F, force.M);
}

TF_API tf_status_t tf_step_compensated(const tf_compensated_t *machine,
                                       tf_state_t *state,
                                       tf_compensation_t *carry,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const tf_machine_t *k = &machine->machine;
  const digits_t more = {machine, carry};
  unsigned mode = state->mode;
  const tf_real_t beside = magnitude(carry->r) + magnitude(carry->v) +
                           magnitude(carry->w) + magnitude(carry->phi);
  if (mode >= TF_MODES || !in_range(state, input) ||
      !within(beside, TF_STATE_LIMIT))
    return refuse(report, TF_BAD_STATE);
  if (!tf_tyre_is_set_valued(k->tyre.law))
    return step_single_valued(machine, state, carry, input, report);
  const motion_t c = motion(k, state, &more, input);
  if (!c.linear.definite) return refuse(report, TF_STEP_TOO_LONG);
  tf_inclusion_t in = inclusion(&c);
  const unsigned signs = signs_of(&in.g);
  if (signs == 3) complete(&c, &in);
  tf_solutions_t s = {0};
  solve(&in, signs, &s);
  // What goes on under every rule is not asked of tf_select.
  if (signs == 3 && !(s.set & TF_MODE_BIT(mode)) &&
      met_rest(machine, state, carry, input, s.set, s.attracting))
    s.set |= (uint8_t)TF_MODE_BIT(mode = TF_PINNED);
  else if (!(s.set & TF_MODE_BIT(mode) & (SLIPS | s.attracting)))
    mode = select_again(k, state, s.set, s.near_stick, s.h_limit[0],
                        s.h_limit[1], s.attracting);
  if (mode == TF_MODES)
    return step_degraded(machine, state, carry, input, report);
  const end_t end = mode_end(&c, &s, mode);
  const bool minus = signs == 3 ? slip_of(&c, &end).g < 0 : signs == 2;
  const tf_real_t h1 = minus ? in.h.F - in.h.M : in.h.F + in.h.M;
  return finish(machine, state, carry, input, report, mode + 8u * s.set, TF_OK,
                end.at.force.F, end.at.force.M, end.change.p, end.change.z,
                -h1 * k->inv_mu_dt);
}
