// The step that creates no energy. In s = r - r0, P = v - d w and u = R w, R
// = sqrt(beta^2 + r^2) the radius of gyration, the energy is the sum of squares
// m (P^2 + u^2)/2 + k2 s^2/2, and the smooth forces are a skew matrix times its
// gradient:
//   s' = P + d u/R,  m P' = -k2 s + G u + Q_b,
//   m u' = -(d/R) k2 s - G P + (d Q_b + Q_c)/R,  G = m r w/R            (18)
// with Q_b and Q_c all other forces on the slider and torques on the disc. With
// the matrix held at a guess (r_c, w_c, R_c) of the middle of the step, the
// theta step is linear in its unknowns and balances energy whatever the guess:
//   E+ - E = work at (v_t, w_t) - (theta - 1/2) |change|^2, w_t = u_t/R_c
// Two guesses, each the middle of the step by the guess before, give order 2 at
// theta = 1/2. Only the end is curved: w+ = u+/R(r+).
//
// Friction takes energy out where F h_t >= 0. So M is kept, and F is what ends
// the slip at the theta point, as far as the law allows: h_t falls with F in
// every machine, so there is one such F.
#include "../friction/mode_set.h"
#include "scheme.h"

// The guess of the middle.
typedef struct {
  tf_real_t r, w, R;
} middle_t;

// What one step has been given.
typedef struct {
  const tf_machine_t *machine;
  const tf_state_t *state;
  const tf_input_t *input;
  tf_real_t most, M; // |F| at most, and the moment
} given_t;

// The theta step about one guess.
typedef struct {
  linear_t linear;
  tf_real_t P, u; // at the start
  tf_real_t v, w; // there, as the held matrix has them
} held_t;

static tf_real_t smaller(tf_real_t a, tf_real_t b) { return a < b ? a : b; }

static tf_real_t gyration_at(const tf_machine_t *k, tf_real_t r) {
  return square_root(gyration2_at(k, r));
}

// The weights R make w_t a mean of w and w+.
static middle_t middle_of(const given_t *x, end_state_t end) {
  const tf_machine_t *k = TF_STEP_MACHINE(x);
  const tf_real_t th = k->theta, of_start = 1 - th;
  const tf_real_t before = of_start * gyration_at(k, x->state->r);
  const tf_real_t after = th * gyration_at(k, end.r), R = before + after;
  return (middle_t){of_start * x->state->r + th * end.r,
                    (before * x->state->w + after * end.w) / R, R};
}

// The step without F.
static held_t hold(const given_t *x, middle_t c) {
  const tf_machine_t *k = TF_STEP_MACHINE(x);
  const tf_state_t *from = x->state;
  held_t b = {.P = ground_speed(k, from->v, from->w),
              .u = gyration_at(k, from->r) * from->w};
  b.w = b.u / c.R;
  b.v = slider_velocity(k, b.P, b.w);
  const tf_real_t mrw = k->m * c.r * c.w, e = k->theta_dt * mrw;
  const tf_real_t J = k->m * (c.R * c.R) + k->theta_dt * k->c1;
  linear_t *l = &b.linear;
  invert(k, J, e, l);
  l->arm = c.r * k->cos_gamma;
  const tf_real_t rt = r_at_theta(k, from->r, b.v);
  const tf_real_t Q_r = radial_force(k, x->input, rt, b.v, mrw * b.w);
  const tf_real_t Q_phi = disc_torque(k, x->input, b.w, mrw * b.v) + x->M;
  l->free = change_under(l, Q_r, Q_phi + k->d * Q_r, Q_phi);
  return b;
}

// F as a share of its largest value: it ends the slip h_t or falls short of
// that, and never drives it.
static tf_real_t stopping_share(const given_t *x, const held_t *b, tf_real_t r,
                                change_t by) {
  const tf_machine_t *k = TF_STEP_MACHINE(x);
  const tf_real_t omega0 = speed_at_theta(k, x->input);
  const tf_real_t p = b->P + k->theta * b->linear.free.p + k->d * omega0;
  const tf_real_t z = b->w + k->theta * b->linear.free.z - omega0;
  const tf_real_t h = slip_from_pq(k, p, r * z).h;
  const tf_real_t change = -k->theta * slip_from_pq(k, by.p, r * by.z).h;
  if (magnitude(h) < change) return h / change;
  return (tf_real_t)((h > 0) - (h < 0));
}

// One step about one guess. `excess`: the work of M and of the turntable beyond
// that at either end of the step, where the law bounds it.
static balanced_end_t end_about(const given_t *x, middle_t c,
                                tf_real_t *excess) {
  const tf_machine_t *k = TF_STEP_MACHINE(x);
  const tf_state_t *from = x->state;
  const held_t b = hold(x, c);
  balanced_end_t end = {.force = {0, x->M}};
  change_t to = b.linear.free;
  if (has_friction(k)) {
    const change_t by = response_to(k, &b.linear, (tf_force_t){x->most, 0});
    const tf_real_t share = stopping_share(x, &b, c.r, by);
    end.force.F = share * x->most;
    to = (change_t){to.p + share * by.p, to.z + share * by.z};
  }
  end.at.r =
      from->r + k->dt * (b.v + k->theta * slider_velocity(k, to.p, to.z));
  end.at.w = (b.u + c.R * to.z) / gyration_at(k, end.at.r);
  end.at.v = slider_velocity(k, b.P + to.p, end.at.w);
  *excess = 0;
  if (!has_friction(k)) return end;
  const tf_real_t wt = b.w + k->theta * to.z;
  const tf_real_t arm =
      end.force.F * speed_at_theta(k, x->input) * k->cos_gamma;
  *excess = smaller(x->M * (wt - from->w), x->M * (wt - end.at.w)) +
            smaller(arm * (c.r - from->r), arm * (c.r - end.at.r));
  return end;
}

static balanced_end_t end_with(const given_t *x, tf_real_t *excess) {
  const tf_machine_t *k = TF_STEP_MACHINE(x);
  const tf_real_t rt = r_at_theta(k, x->state->r, x->state->v);
  middle_t c = {rt, x->state->w, gyration_at(k, rt)};
  c = middle_of(x, end_about(x, c, excess).at);
  c = middle_of(x, end_about(x, c, excess).at);
  return end_about(x, c, excess);
}

TF_API balanced_end_t tf_balanced_end(const tf_machine_t *k,
                                      const tf_state_t *state,
                                      const tf_input_t *input, unsigned mode,
                                      tf_force_t force) {
  given_t x = {k, state, input, magnitude(force.F), force.M};
  if (tf_tyre_is_set_valued(k->contact.tyre.law)) {
    if (!is_slip(mode)) x.most = k->contact.tyre.mu;
    x.M = clip(force.M, -k->contact.kappa_mu, k->contact.kappa_mu);
  }
  tf_real_t excess;
  balanced_end_t end = end_with(&x, &excess);
  const end_state_t from = {state->r, state->v, state->w};
  const tf_real_t energy = mean_energy(k, input, from, end.at);
  if (has_friction(k) && // an impulse of the moment
      k->dt * excess > TF_CREATED_SHARE * energy) {
    x.M = 0;
    end = end_with(&x, &excess);
  }
  const tf_slip_t slip =
      slip_speeds(k, end.at.r, end.at.v, end.at.w - input->omega0);
  const unsigned side =
      is_slip(state->mode) ? state->mode : slip_with(sign_of(end.force.F));
  end.mode = slip_of_sign(slip.h, side);
  if (tf_tyre_is_set_valued(k->contact.tyre.law))
    end.delassus = delassus_at(k, end.at.r * k->cos_gamma, sign_of(slip.g),
                               inertia_at(k, end.at.r));
  return end;
}

static void take_balanced_end(const balanced_end_t *end, step_end_t *to) {
  to->outcome.residual += magnitude(end->force.F - to->end.force.F);
  to->end.at = end->at;
  to->end.force = end->force;
  to->outcome.mode = end->mode;
  to->outcome.is_mean = false;
  to->outcome.is_balanced = true;
  to->outcome.delassus = end->delassus;
}

TF_API bool tf_changes_much(const tf_machine_t *k, const tf_state_t *from,
                            end_state_t to, tf_real_t dP, tf_real_t dw,
                            tf_real_t share) {
  const tf_real_t P0 = ground_speed(k, from->v, from->w);
  const tf_real_t P1 = ground_speed(k, to.v, to.w);
  const tf_real_t R2 = gyration2_at(k, to.r);
  const tf_real_t of_both =
      P0 * P0 + P1 * P1 + R2 * (from->w * from->w + to.w * to.w);
  return !(dP * dP + R2 * (dw * dw) <= share * of_both);
}

TF_API bool tf_step_changes_much(const tf_machine_t *k, const tf_state_t *from,
                                 end_state_t to, tf_real_t share) {
  const tf_real_t dw = to.w - from->w;
  return tf_changes_much(k, from, to, ground_speed(k, to.v - from->v, dw), dw,
                         share);
}

TF_API void tf_checked_end(const tf_machine_t *k, const tf_state_t *state,
                           const tf_input_t *input, step_end_t *to) {
  const end_state_t from = {state->r, state->v, state->w};
  const end_state_t at = to->end.at;
  const unsigned mode = to->outcome.mode;
  const tf_force_t force = to->end.force;
  const balance_t b = balance_of(k, is_midpoint(k), input, from, at, force.F);
  const bool ends = tf_tyre_is_set_valued(k->contact.tyre.law) &&
                    ends_slip(state->mode, mode);
  if (is_balanced(&b) && !ends) return;
  const tf_real_t energy = mean_energy(k, input, from, at);
  const bool coarse =
      is_too_coarse(k, &b, energy, from, at) ||
      (ends && tf_step_changes_much(k, state, at, TF_IMPULSE_SHARE));
  const bool creates = creates_energy(&b, energy);
  const bool slips_on = force.F == 0 || (is_slip(mode) && mode == state->mode);
  if (creates || (!coarse && grows(k, &b, energy, slips_on))) {
    const balanced_end_t end = tf_balanced_end(k, state, input, mode, force);
    // Near h = 0 its force is not that of the slip, which then goes on; beside
    // the axis it may end on the other side, and b is that of one end.
    if (creates || (end.mode == mode && end.force.F == force.F &&
                    (end.at.r > 0) == (at.r > 0)))
      take_balanced_end(&end, to);
  }
  const bool jumps = jumps_axis(k, &b, from, at);
  if ((creates || coarse || jumps) && to->outcome.status == TF_OK)
    to->outcome.status = TF_COARSE;
}
