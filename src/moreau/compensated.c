// What the compensated step computes in pairs of tf_real_t. The machine is at
// state + compensation. The step is solved in tf_real_t, but
// * h at the start is that of their sum: an error of epsilon there would be one
//   of epsilon h / dt in the force that holds the stick, while one of epsilon
//   in a coefficient is no more than that in an increment;
// * at the end the increments of p and z are refined once: the residual of (6)
//   is formed in pairs, and the inverse that solved for them solves for what
//   is missing. So an epsilon in a coefficient costs an epsilon of an epsilon.
#include "twofold/compensated.h"

#include "../model/mechanics.h"
#include "../num/pair.h"
#include "report.h"
#include "scheme.h"
#include "stages.h"

// The state in pairs.
typedef struct {
  pair_t r, v, w;
} state_pair_t;

TF_INLINE state_pair_t paired(const tf_state_t *state,
                              const tf_compensation_t *low) {
  return (state_pair_t){
      {state->r, low->r}, {state->v, low->v}, {state->w, low->w}};
}

TF_INLINE pair_t sine_pair(const tf_compensated_t *k) {
  return (pair_t){k->machine.sin_gamma, k->low_sin_gamma};
}

TF_INLINE pair_t cosine_pair(const tf_compensated_t *k) {
  return (pair_t){k->machine.cos_gamma, k->low_cos_gamma};
}

// (h), (g). In stick h is the small difference of p sin gamma and q cos gamma,
// so it is formed in pairs. g is small beside p and q only where h is not, and
// then it decides nothing: the leading parts of p and q are enough.
TF_INLINE start_t slip_in_pairs(const tf_compensated_t *k,
                                const state_pair_t *state, pair_t omega0) {
  const pair_t z = pair_normalized(pair_difference(state->w, omega0));
  const pair_t p =
      pair_normalized(pair_difference(state->v, pair_times(z, k->machine.d)));
  const pair_t q = pair_product(state->r, z);
  const pair_t h =
      pair_sum(pair_product(sine_pair(k), p), pair_product(cosine_pair(k), q));
  const tf_real_t g = slip_from_pq(&k->machine, p.hi, q.hi).g;
  return (start_t){p.hi, z.hi, {-(h.hi + h.lo), g}, true, true};
}

// (6) in pairs: by how much the change c of p and z fails to solve its rows
//   m dp + a dv - e dz   = dt b,  b = Q_r + F sin gamma
//   J dz + e dp + d a dv = dt t,  t = Q_phi + d Q_r + F r_theta cos gamma + M,
// solved for the change that is missing. theta dt v, a and e are small beside
// r, m and J: tf_real_t is enough for them. M_low is what the rounding of M
// left out.
TF_INLINE change_t refinement(const tf_compensated_t *constants,
                              const state_pair_t *state, const tf_input_t *u,
                              const linear_t *l, tf_force_t f, tf_real_t M_low,
                              change_t c) {
  const tf_machine_t *k = &constants->machine;
  const tf_real_t theta_dt_v = k->theta_dt * state->v.hi;
  const pair_t r_theta = pair_plus(state->r, theta_dt_v),
               mr = pair_times(r_theta, k->m);
  const pair_t mrw = pair_product(mr, state->w),
               mrwv = pair_product(mrw, state->v);
  const pair_t Q_r =
      radial_force_pair(k, u, r_theta, state->v, pair_product(mrw, state->w));
  const pair_t Q_phi = disc_torque_pair(k, u, state->w, pair_sum(mrwv, mrwv));
  const pair_t arm = pair_product(r_theta, cosine_pair(constants));
  const pair_t moment = pair_plus(pair_times(arm, f.F), f.M);
  const pair_t b = pair_sum(Q_r, pair_times(sine_pair(constants), f.F));
  const pair_t t = pair_sum(pair_sum(Q_phi, pair_times(Q_r, k->d)),
                            pair_plus(moment, M_low));
  const pair_t J =
      pair_sum((pair_t){k->inertia, constants->low_inertia},
               pair_product(mr, pair_plus(r_theta, 2 * theta_dt_v)));
  const tf_real_t e = 2 * k->theta_dt * mrw.hi;
  const tf_real_t a_dv = k->a * slider_velocity(k, c.p, c.z);
  const pair_t row_b = pair_difference(
      pair_times(b, k->dt), pair_plus(two_product(k->m, c.p), a_dv - e * c.z));
  const pair_t row_t =
      pair_difference(pair_times(t, k->dt),
                      pair_plus(pair_times(J, c.z), e * c.p + k->d * a_dv));
  const tf_real_t residual_b = (row_b.hi + row_b.lo) / k->dt;
  const tf_real_t residual_t = (row_t.hi + row_t.lo) / k->dt;
  return change_under(l, residual_b, residual_t,
                      residual_t - k->d * residual_b);
}

// What M leaves out: in stick it is s kappa F, which has to be rounded to M.
TF_INLINE tf_real_t moment_remainder(const tf_machine_t *k, unsigned mode,
                                     tf_force_t f) {
  const pair_t M = two_product(k->contact.stick_kappa, f.F);
  if (mode == TF_STICK_PLUS) return (M.hi - f.M) + M.lo;
  if (mode == TF_STICK_MINUS) return -(M.hi + f.M) - M.lo;
  return 0;
}

// from + change, however different their sizes.
TF_INLINE pair_t moved(pair_t from, pair_t change) {
  const pair_t s = two_sum(from.hi, change.hi);
  return fast_two_sum(s.hi, s.lo + (from.lo + change.lo));
}

// (7), (12): from + dt v + theta dt dv. dt v is formed exactly: its rounding
// would have the same sign for as long as v is the same.
TF_INLINE pair_t travelled(const tf_machine_t *k, pair_t from, pair_t v,
                           tf_real_t dv) {
  const pair_t travel = two_product(k->dt, v.hi);
  return moved(
      from, (pair_t){travel.hi, travel.lo + (k->dt * v.lo + k->theta_dt * dv)});
}

// (7): the end of a step under a force and the change that responds to it.
TF_INLINE state_pair_t end_in_pairs(const tf_compensated_t *constants,
                                    const state_pair_t *state,
                                    const tf_input_t *u, const linear_t *l,
                                    unsigned mode, tf_force_t f,
                                    change_t friction) {
  const tf_machine_t *k = &constants->machine;
  const change_t c = {l->free.p + friction.p, l->free.z + friction.z};
  const change_t low =
      refinement(constants, state, u, l, f, moment_remainder(k, mode, f), c);
  const pair_t dz = {c.z, low.z};
  const pair_t dv = pair_sum((pair_t){c.p, low.p}, pair_times(dz, k->d));
  return (state_pair_t){travelled(k, state->r, state->v, dv.hi),
                        moved(state->v, dv), moved(state->w, dz)};
}

// The compensation of the new state and, where wanted, its angle (12).
TF_INLINE void store_compensation(const tf_machine_t *k, tf_state_t *state,
                                  tf_compensation_t *low,
                                  const state_pair_t *to) {
  pair_t phi = {state->phi, low->phi};
  if (k->with_angle) {
    const pair_t w = {state->w, low->w};
    phi = travelled(k, phi, w, pair_difference(to->w, w).hi);
  }
  state->phi = phi.hi;
  *low = (tf_compensation_t){to->r.lo, to->v.lo, to->w.lo, phi.lo};
}

// The compensated step: its constants as pairs, and the step itself.

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
// the slip at the start and the end of the step in pairs.

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
  if (outcome.mode == TF_PINNED) { // (10): v = 0 and w = omega0 exactly
    const pair_t travel = two_product(k->explicit_dt, from.v.hi);
    return (state_pair_t){
        moved(from.r, travel), {0, 0}, {step->input->omega0, 0}};
  }
  // A mean over a change of mode has a moment of its own.
  const unsigned law = outcome.is_mean ? TF_MODES : outcome.mode;
  const linear_t l = linearise(k, step->state, step->input,
                               velocities(k, step->state, step->input->omega0));
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
