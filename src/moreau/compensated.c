// The compensated step: its constants as pairs, and the step itself.
#include "twofold/compensated.h"

#include "../model/mechanics.h"
#include "compensation.h"
#include "rare_end.h"
#include "report.h"
#include "scheme.h"

// What a compensated step needs before it starts: what rounding has left out of
// the constants of a machine, and a start whose slip is as precise.

static pair_t integer(int n) { return (pair_t){(tf_real_t)n, 0}; }

// sin and cos of x for |x| <= 3.2: the series at x/8, where its terms fall to
// the square of epsilon (2^-104 in double) within 13 of each, then three times
// the double angle.
static void sine_cosine(tf_real_t x, pair_t *sine, pair_t *cosine) {
  const pair_t y = {x / 8, 0}, minus_y2 = pair_negative(pair_product(y, y));
  pair_t s = y, c = {1, 0}, s_term = s, c_term = c;
  for (int n = 1; n <= 13; n++) {
    c_term = pair_quotient(pair_product(c_term, minus_y2),
                           integer((2 * n - 1) * (2 * n)));
    s_term = pair_quotient(pair_product(s_term, minus_y2),
                           integer(2 * n * (2 * n + 1)));
    c = pair_sum(c, c_term);
    s = pair_sum(s, s_term);
  }
  for (int i = 0; i < 3; i++) {
    const pair_t ss = pair_product(s, s), sc = pair_product(s, c);
    s = pair_sum(sc, sc);
    c = pair_difference((pair_t){1, 0}, pair_sum(ss, ss));
  }
  *sine = s;
  *cosine = c;
}

// What rounding has left out of a constant.
static tf_real_t left_out(pair_t exact, tf_real_t constant) {
  return (exact.hi - constant) + exact.lo;
}

TF_API tf_status_t tf_prepare_compensated(tf_compensated_t *machine,
                                          const tf_params_t *params,
                                          int *offender) {
  tf_machine_t *k = &machine->machine;
  const tf_status_t status = tf_prepare(k, params, offender);
  if (status != TF_OK) return status;
  pair_t sine, cosine;
  sine_cosine(params->gamma, &sine, &cosine);
  const pair_t inertia = pair_sum(disc_inertia_pair(k->m, params->beta),
                                  two_product(k->theta_dt, k->c1));
  machine->low_sin_gamma = k->sin_gamma != 0 ? left_out(sine, k->sin_gamma) : 0;
  machine->low_cos_gamma = left_out(cosine, k->cos_gamma);
  machine->low_inertia = left_out(inertia, k->inertia);
  return TF_OK;
}

TF_API tf_status_t tf_speed_for_slip_compensated(
    const tf_compensated_t *machine, tf_state_t *state,
    tf_compensation_t *compensation, tf_real_t omega0, tf_real_t h) {
  const tf_machine_t *k = &machine->machine;
  if (!(magnitude(k->sin_gamma) >= TF_MIN_SINE)) return TF_BAD_STATE;
  const pair_t r = {state->r, compensation->r}, w = {state->w, compensation->w};
  const pair_t sine = {k->sin_gamma, machine->low_sin_gamma};
  const pair_t cosine = {k->cos_gamma, machine->low_cos_gamma};
  const pair_t z = pair_normalized(pair_plus(w, -omega0));
  const pair_t p = pair_negative(pair_quotient(
      pair_plus(pair_product(pair_product(r, z), cosine), h), sine));
  const pair_t v = pair_normalized(pair_sum(p, pair_times(z, k->d)));
  state->v = v.hi;
  compensation->v = v.lo;
  return TF_OK;
}

// The step that keeps the rounding of its state: the stages of tf_step, with
// the slip at the start and the end of the step in pairs (compensation.h).

// Where the balanced form ends starts from the leading parts; what they leave
// out is carried over.
TF_INLINE state_pair_t balanced_end_in_pairs(end_state_t at,
                                             const tf_compensation_t *low) {
  return (state_pair_t){pair_plus((pair_t){at.r, 0}, low->r),
                        pair_plus((pair_t){at.v, 0}, low->v),
                        pair_plus((pair_t){at.w, 0}, low->w)};
}

// What one step is given.
typedef struct {
  const tf_compensated_t *constants;
  tf_state_t *state;
  tf_compensation_t *low;
  const tf_input_t *input;
} compensated_step_t;

// Where a step ends, in pairs.
TF_INLINE state_pair_t pairs_at_end(const compensated_step_t *step,
                                    tf_force_t force, change_t friction,
                                    outcome_t outcome, end_state_t at) {
  const tf_machine_t *k = &step->constants->machine;
  const state_pair_t from = paired(step->state, step->low);
  if (outcome.is_balanced) return balanced_end_in_pairs(at, step->low);
  if (outcome.mode == TF_PINNED)
    return end_at_rest_in_pairs(k, &from, step->input->omega0);
  // A mean over a passage of h = g = 0 has a moment of its own.
  const unsigned law = outcome.is_mean ? TF_MODES : outcome.mode;
  const linear_t l = linearise(k, step->state, step->input);
  return end_in_pairs(step->constants, &from, step->input, &l, law, force,
                      friction);
}

// Commit: the end of the step in pairs, the state and the report, or the
// refusal. It derives the inverse of (6) anew: as a function of its own, which
// a step ends with, its pairs and those of the step need no stack together.
static __attribute__((noinline)) tf_status_t commit_pairs(
    compensated_step_t *step, const step_end_t *to, tf_report_t *report) {
  const tf_machine_t *k = &step->constants->machine;
  tf_state_t *state = step->state;
  outcome_t outcome = to->outcome;
  const tf_force_t force = to->end.force;
  const state_pair_t end =
      pairs_at_end(step, force, to->end.friction, outcome, to->end.at);
  if (!in_reach(end.r.hi, end.v.hi, end.w.hi) ||
      !within(outcome.delassus + outcome.residual, TF_REAL_MAX))
    return refuse_step(report, TF_DIVERGED); // one of the two is 0
  const pair_t omega0 = {step->input->omega0, 0};
  const tf_slip_t slip = slip_in_pairs(step->constants, &end, omega0).slip;
  const end_state_t at = {end.r.hi, end.v.hi, end.w.hi};
  if (outcome.is_balanced) outcome.mode = slip_of_sign(slip.h, state->mode);
  const tf_real_t residual = mode_residual(k, &outcome, force, slip);
  store_compensation(k, state, step->low, &end);
  record(state, at, slip, force, residual, outcome, report);
  if (plainly_has_signs(k, outcome.mode, slip, at)) return outcome.status;
  return tf_status_of_end(k, state, step->input, report);
}

TF_API tf_status_t tf_step_compensated(const tf_compensated_t *machine,
                                       tf_state_t *state,
                                       tf_compensation_t *compensation,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const tf_machine_t *k = &machine->machine;
  const tf_real_t low =
      magnitude(compensation->r) + magnitude(compensation->v) +
      magnitude(compensation->w) + magnitude(compensation->phi);
  if (!may_step(state, input) || !within(low, TF_STATE_LIMIT))
    return refuse_step(report, TF_BAD_STATE);
  const state_pair_t pairs = paired(state, compensation);
  const tf_real_t turn = turn_of_step(k, input);
  const pair_t omega0 = two_sum(input->omega0, -turn);
  start_t start = slip_in_pairs(machine, &pairs, omega0);
  start.p += k->d * turn; // now against the turntable of the end
  start.z -= turn;
  step_end_t to;
  const end_kind_t kind = end_of_step(k, state, input, start, &to);
  if (kind != END_COMMON) {
    const tf_status_t status = tf_rare_end(kind, k, state, input, &start, &to);
    if (status < TF_OK) return refuse_step(report, status);
  }
  compensated_step_t step = {machine, state, compensation, input};
  return commit_pairs(&step, &to, report);
}
