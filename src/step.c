// One step: linearise, enumerate what friction allows, choose, advance.
#include "twofold/step.h"

#include "friction_core.h"
#include "linear.h"
#include "tyre_core.h"

// What the parts of one step read.
typedef struct {
  const tf_machine_t *machine;
  const tf_state_t *state;
  tf_linear_t linear;
  tf_real_t r, z; // end of the step without friction
  tf_slip_t free; // its slip
} motion_t;

TF_INLINE motion_t motion(const tf_machine_t *k, const tf_state_t *state,
                          const tf_input_t *input) {
  motion_t c = {
      .machine = k, .state = state, .linear = linearise(k, state, input)};
  const tf_real_t p = c.linear.p + c.linear.free.p;
  c.z = c.linear.z + c.linear.free.z;
  c.r = c.linear.r_explicit + k->theta_dt * (p + k->d * c.z);
  c.free = turned(k, p, c.r * c.z);
  return c;
}

// Stick with s = +1 (index 0) or -1: moment that goes with F = 1 N.
TF_INLINE tf_force_t stick_direction(const motion_t *c, unsigned s) {
  const tf_real_t kappa = c->machine->stick_kappa;
  return (tf_force_t){1, s ? -kappa : kappa};
}

TF_INLINE tf_slip_t slip_now(const motion_t *c) {
  return turned(c->machine, c->linear.p, c->state->r * c->linear.z);
}

TF_INLINE tf_slip_t slip_at_theta(const motion_t *c, tf_force_t force) {
  const tf_real_t r_theta = c->state->r + c->machine->theta_dt * c->state->v;
  return theta_slip(c->machine, &c->linear, r_theta, force);
}

TF_INLINE tf_force_t slip_force(const motion_t *c, tf_real_t side,
                                tf_slip_t at) {
  const tf_tyre_t *tyre = &c->machine->tyre;
  if (tyre->law == TF_TYRE_COULOMB) return (tf_force_t){side * tyre->mu, 0};
  return jump_force(tyre, side, at.h, at.g);
}

// Slip under a set-valued law on one side of h = 0: the force is predicted
// from the start, then taken at the theta point. Where that would throw the
// wheel across h = 0 although the limit at h -> 0 holds it on its side, the
// true end lies between the two and the limit is taken.
TF_INLINE tf_end_t slip_outcome(const motion_t *c, unsigned mode,
                                tf_real_t tau) {
  const tf_machine_t *k = c->machine;
  const tf_real_t side = mode == TF_SLIP_PLUS ? TF_R(1.0) : TF_R(-1.0);
  const tf_force_t first = slip_force(c, side, slip_now(c));
  const tf_end_t end =
      end_under(k, &c->linear, slip_force(c, side, slip_at_theta(c, first)));
  if (side * end_slip(k, &c->linear, &end).h > 0) return end;
  const tf_real_t limit = side * k->tyre.mu;
  return end_under(k, &c->linear,
                   (tf_force_t){limit, tau * c->machine->stick_kappa * limit});
}

TF_INLINE tf_end_t stick_outcome(const motion_t *c, tf_change_t one,
                                 tf_real_t moment, tf_real_t lambda) {
  return end_after(c->machine, &c->linear,
                   (tf_force_t){lambda, moment * lambda},
                   (tf_change_t){lambda * one.p, lambda * one.z});
}

// Ends at what the force was solved for, without its rounding.
TF_INLINE tf_end_t pinned_outcome(const motion_t *c) {
  return (tf_end_t){pinning_force(c->machine, &c->linear), c->linear.r_explicit,
                    0, c->linear.omega0};
}

// Lambda of a stick, share of the moment of a slip.
TF_INLINE tf_real_t multiplier_of(const tf_solutions_t *from, unsigned mode) {
  if (mode == TF_PINNED) return 0;
  return mode <= TF_SLIP_MINUS ? from->tau[mode]
                               : from->lambda[mode - TF_STICK_PLUS];
}

TF_INLINE tf_end_t mode_outcome(const motion_t *c, unsigned mode,
                                tf_real_t multiplier) {
  if (mode == TF_PINNED) return pinned_outcome(c);
  if (mode <= TF_SLIP_MINUS) return slip_outcome(c, mode, multiplier);
  const tf_force_t one = stick_direction(c, mode - TF_STICK_PLUS);
  return stick_outcome(c, response(c->machine, &c->linear, one), one.M,
                       multiplier);
}

// In slip the angle is not in question: only the side is checked.
TF_INLINE tf_real_t residual(const tf_machine_t *k, unsigned mode,
                             tf_force_t force, tf_slip_t slip) {
  if (mode > TF_SLIP_MINUS)
    return law_residual(k->tyre.mu, k->stick_kappa, force, slip.h, slip.g);
  return law_residual(1, 0, (tf_force_t){mode == TF_SLIP_PLUS ? 1 : -1, 0},
                      slip.h, slip.g);
}

// The inclusion where g+ may have either sign.
TF_INLINE tf_inclusion_t inclusion(const motion_t *c) {
  const tf_machine_t *k = c->machine;
  tf_inclusion_t in = {.mu = k->tyre.mu,
                       .kappa = k->stick_kappa,
                       .h_free = c->free.h,
                       .g_free = c->free.g,
                       .g_now = slip_now(c).g,
                       .pin = pinning_force(k, &c->linear),
                       .signs = 3};
  for (unsigned s = 0; s < 2; s++) {
    const tf_force_t one = stick_direction(c, s);
    const tf_polynomial_t a =
        polynomial_of(k, c->r, c->z, response(k, &c->linear, one));
    in.h1[s] = a.h1;
    in.h2[s] = a.h2;
    in.g1[s] = a.g1;
    in.g2[s] = a.g2;
  }
  const tf_change_t M = response(k, &c->linear, (tf_force_t){0, 1});
  const tf_polynomial_t m = polynomial_of(k, c->r, c->z, M);
  in.h_MM = m.h2;
  in.g_MM = m.g2;
  return in;
}

TF_INLINE tf_status_t refuse(tf_report_t *report, tf_status_t status) {
  report->status = status;
  return status;
}

// What every step ends with: a new state, unless it is out of range.
TF_INLINE tf_status_t commit(const tf_machine_t *k, tf_state_t *state,
                             const tf_input_t *input, tf_end_t end,
                             unsigned mode, unsigned set, tf_real_t delassus,
                             tf_status_t status, tf_report_t *report) {
  static const uint8_t size_of[1u << TF_MODES] = {
      0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4,
      1, 2, 2, 3, 2, 3, 3, 4, 2, 3, 3, 4, 3, 4, 4, 5};
  if (!within(magnitude(end.r) + magnitude(end.v) + magnitude(end.w),
              TF_STATE_LIMIT))
    return refuse(report, TF_DIVERGED);
  const tf_slip_t slip = slip_speeds(k, end.r, end.v, end.w - input->omega0);
  report->mode = (uint8_t)mode;
  report->set = (uint8_t)set;
  report->choices = size_of[set];
  report->force = end.force;
  report->slip = slip;
  report->delassus = delassus;
  report->residual = residual(k, mode, end.force, slip);
  report->status = status;
  if (k->with_angle) // (12)
    state->phi += k->explicit_dt * state->w + k->theta_dt * end.w;
  state->r = end.r;
  state->v = end.v;
  state->w = end.w;
  state->mode = (uint8_t)mode;
  state->tick++;
  return status;
}

// tf_select, from what is in registers.
TF_RARE unsigned select_again(const tf_machine_t *k, const tf_state_t *state,
                              unsigned set, unsigned near_stick,
                              tf_real_t h_plus, tf_real_t h_minus,
                              unsigned attracting) {
  const tf_solutions_t solutions = {.set = (uint8_t)set,
                                    .attracting = (uint8_t)attracting,
                                    .near_stick = (uint8_t)near_stick,
                                    .h_limit = {h_plus, h_minus}};
  return tf_select(k->rule, k->exit_threshold, &solutions, state->mode,
                   state->tick, state->seed);
}

// No mode is consistent: of all of them the one that violates the law least.
TF_RARE tf_status_t step_degraded(const tf_machine_t *k, tf_state_t *state,
                                  const tf_input_t *input,
                                  tf_report_t *report) {
  const motion_t c = motion(k, state, input);
  const tf_inclusion_t in = inclusion(&c);
  tf_solutions_t solutions = {0};
  unsigned best = state->mode;
  tf_end_t best_end = pinned_outcome(&c);
  tf_real_t least = TF_REAL_MAX;
  solve_both_signs(&in, &solutions);
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    const tf_end_t end =
        mode_outcome(&c, mode, multiplier_of(&solutions, mode));
    const tf_real_t rest =
        residual(k, mode, end.force, end_slip(k, &c.linear, &end));
    if (!(rest < least)) continue;
    least = rest;
    best = mode;
    best_end = end;
  }
  return commit(k, state, input, best_end, best, 0, 0, TF_DEGRADED, report);
}

// The end of a step whose mode and multiplier (lambda of a stick, moment share
// of a slip) are known. The motion is computed again: keeping it across the
// selection would cost 200 B of stack.
TF_RARE tf_status_t step_as(const tf_machine_t *k, tf_state_t *state,
                            const tf_input_t *input, tf_report_t *report,
                            unsigned mode, unsigned set, tf_real_t multiplier,
                            tf_real_t h1_plus, tf_real_t h1_minus) {
  const motion_t c = motion(k, state, input);
  const tf_end_t end = mode_outcome(&c, mode, multiplier);
  const tf_real_t h1 = end_slip(k, &c.linear, &end).g < 0 ? h1_minus : h1_plus;
  return commit(k, state, input, end, mode, set, -h1 * k->inv_dt, TF_OK,
                report);
}

// Codimension two is within reach of the step: both signs of g+.
TF_RARE tf_status_t step_both_signs(const tf_machine_t *k, tf_state_t *state,
                                    const tf_input_t *input,
                                    tf_report_t *report) {
  const motion_t c = motion(k, state, input);
  const tf_inclusion_t in = inclusion(&c);
  tf_solutions_t solutions = {.near_stick = in.g_now >= 0 ? TF_STICK_PLUS
                                                          : TF_STICK_MINUS};
  solve_both_signs(&in, &solutions);
  const unsigned mode = select_again(
      k, state, solutions.set, solutions.near_stick, solutions.h_limit[0],
      solutions.h_limit[1], solutions.attracting);
  if (mode == TF_MODES) return step_degraded(k, state, input, report);
  return step_as(k, state, input, report, mode, solutions.set,
                 multiplier_of(&solutions, mode), in.h1[0], in.h1[1]);
}

// Whether g+ keeps the sign of g_free under every force of the law: at the
// corners of {(F, M): |F| <= mu, |M| <= kappa |F|}, since g+ is affine in
// (F, M) but for R Z sin(gamma), which is bounded.
TF_INLINE bool one_sign(const motion_t *c, const tf_polynomial_t *a,
                        tf_real_t moment) {
  const tf_machine_t *k = c->machine;
  const tf_linear_t *l = &c->linear;
  const tf_change_t M = {l->p_t - l->p_c, l->z_t + l->z_c};
  const tf_real_t R = k->theta_dt * (M.p + k->d * M.z);
  const tf_real_t twice = moment + moment, mu = k->tyre.mu;
  const tf_real_t other =
      a->g1 - twice * turned(k, M.p, c->r * M.z + c->z * R).g;
  const tf_real_t bend = (magnitude(a->R) + magnitude(twice * R)) *
                         (magnitude(a->Z) + magnitude(twice * M.z));
  const tf_real_t here = magnitude(a->g1), there = magnitude(other);
  return magnitude(c->free.g) >
         mu * ((here > there ? here : there) + mu * bend);
}

// (11): a single-valued law may still be stiff in h. Its secant F = c h at the
// predicted slip is taken implicitly where that damps (the end of the step
// answers with E < 0) and explicitly where it drives. The secant never
// extrapolates: |share| <= 1.
TF_INLINE tf_force_t secant_force(const motion_t *c, tf_slip_t at,
                                  tf_real_t h_now) {
  const tf_machine_t *k = c->machine;
  const tf_force_t f = tf_tyre_force(&k->tyre, at.h < 0 ? -1 : 1, at.h, at.g);
  if (at.h == 0) return f;
  const tf_change_t change = response(k, &c->linear, f);
  const tf_real_t E = polynomial_of(k, c->r, c->z, change).h1 / at.h;
  if (!(E < 0)) return f;
  const tf_real_t h =
      (h_now + k->theta * (c->free.h - h_now)) / (1 - k->theta * E);
  const tf_real_t share = clip(h / at.h, -1, 1);
  return (tf_force_t){share * f.F, share * f.M};
}

// The end under a force of a single-valued law, and how far the force is from
// the law there. Apart from its search for the sake of the stack.
TF_RARE tf_status_t step_under(const tf_machine_t *k, tf_state_t *state,
                               const tf_input_t *input, tf_report_t *report,
                               tf_real_t F, tf_real_t M) {
  const motion_t c = motion(k, state, input);
  const tf_force_t force = {F, M};
  const tf_end_t end = end_under(k, &c.linear, force);
  const tf_real_t h = end_slip(k, &c.linear, &end).h;
  const unsigned mode = h > 0   ? TF_SLIP_PLUS
                        : h < 0 ? TF_SLIP_MINUS
                                : state->mode & 1u; // as it was at h = 0
  const tf_slip_t slip = slip_at_theta(&c, force);
  const tf_real_t law =
      tf_tyre_force(&k->tyre, slip.h < 0 ? -1 : 1, slip.h, slip.g).F;
  const tf_status_t status =
      commit(k, state, input, end, mode, TF_MODE_BIT(mode), 0, TF_OK, report);
  if (status == TF_OK) report->residual = magnitude(F - law);
  return status;
}

TF_RARE tf_status_t step_single_valued(const tf_machine_t *k, tf_state_t *state,
                                       const tf_input_t *input,
                                       tf_report_t *report) {
  const motion_t c = motion(k, state, input);
  if (!c.linear.definite) return refuse(report, TF_STEP_TOO_LONG);
  const tf_slip_t now = slip_now(&c);
  const tf_force_t first = secant_force(&c, now, now.h);
  const tf_force_t force = secant_force(&c, slip_at_theta(&c, first), now.h);
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
  const motion_t c = motion(k, state, input);
  if (!c.linear.definite) return refuse(report, TF_STEP_TOO_LONG);
  const unsigned s = c.free.g < 0;
  const tf_force_t direction = stick_direction(&c, s);
  const tf_change_t one = response(k, &c.linear, direction);
  const tf_polynomial_t a = polynomial_of(k, c.r, c.z, one);
  if (!one_sign(&c, &a, direction.M))
    return step_both_signs(k, state, input, report);
  tf_solutions_t solutions;
  const unsigned set =
      solve_one_sign(k->tyre.mu, c.free.h, a.h1, a.h2, s, &solutions);
  if (set != TF_MODE_BIT(mode)) // else tf_select would say the same
    mode = select_again(k, state, set, TF_STICK_PLUS + s, solutions.h_limit[0],
                        solutions.h_limit[1], solutions.attracting);
  const tf_end_t end =
      mode > TF_SLIP_MINUS
          ? stick_outcome(&c, one, direction.M, solutions.lambda[s])
          : slip_outcome(&c, mode, solutions.tau[0]);
  return commit(k, state, input, end, mode, set, -a.h1 * k->inv_dt, TF_OK,
                report);
}
