// The step that creates no energy. In s = r - r0, p = v - d w and sigma = rho
// w, rho = sqrt(beta^2 + r^2), the energy is the sum of squares m (p^2 +
// sigma^2)/2 + k2 s^2/2, and the smooth forces are a skew matrix times its
// gradient:
//   s' = p + d sigma/rho,  m p' = -k2 s + G sigma + Q_b,
//   m sigma' = -(d/rho) k2 s - G p + (d Q_b + Q_c)/rho,  G = m r w/rho  (18)
// with Q_b and Q_c all other forces on the slider and torques on the disc. With
// the matrix held at a guess (r_c, w_c, rho_c) of the middle of the step, the
// theta step is linear in its unknowns and balances energy whatever the guess:
//   E+ - E = work at (v_t, w_t) - (theta - 1/2) |change|^2, w_t = sigma_t/rho_c
// Two guesses, each the middle of the step by the guess before, give order 2 at
// theta = 1/2. Only the end is curved: w+ = sigma+/rho(r+).
//
// Friction takes energy out where F h_t >= 0. So M is kept, and F is what ends
// the slip at the theta point, as far as the law allows: h_t falls with F in
// every machine, so there is one such F.
#include "balanced.h"

#include "../friction/mode_set.h"

// The guess of the middle.
typedef struct {
  tf_real_t r, w, rho;
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
  tf_real_t p, sigma; // at the start
  tf_real_t V, W;     // v and w there, as the held matrix has them
} held_t;

static tf_real_t smaller(tf_real_t a, tf_real_t b) { return a < b ? a : b; }

static tf_real_t rho_at(const tf_machine_t *k, tf_real_t r) {
  return square_root(gyration2_at(k, r));
}

// The weights rho make w_t a mean of w and w+.
static middle_t middle_of(const given_t *x, end_state_t end) {
  const tf_machine_t *k = x->machine;
  const tf_real_t th = k->theta, rest = 1 - th;
  const tf_real_t before = rest * rho_at(k, x->state->r);
  const tf_real_t after = th * rho_at(k, end.r), rho = before + after;
  return (middle_t){rest * x->state->r + th * end.r,
                    (before * x->state->w + after * end.w) / rho, rho};
}

// The step without F.
static held_t hold(const given_t *x, middle_t c) {
  const tf_machine_t *k = x->machine;
  const tf_state_t *from = x->state;
  held_t b = {.p = from->v - k->d * from->w,
              .sigma = rho_at(k, from->r) * from->w};
  b.W = b.sigma / c.rho;
  b.V = b.p + k->d * b.W;
  const tf_real_t mrw = k->m * c.r * c.w, e = k->theta_dt * mrw;
  const tf_real_t J = k->m * (c.rho * c.rho) + k->theta_dt * k->c1;
  const tf_real_t scale = k->dt / (k->m_plus_a * J + k->m_a_d2 + e * e);
  linear_t *l = &b.linear;
  l->p_b = scale * J;
  l->p_t = scale * e;
  l->p_c = scale * k->d_a;
  l->z_t = scale * k->m;
  l->z_c = scale * k->a;
  l->arm = c.r * k->cos_gamma;
  const tf_real_t rt = from->r + k->theta_dt * b.V;
  const tf_real_t Q_r = radial_force(k, x->input, rt, b.V, mrw * b.W);
  const tf_real_t Q_phi = disc_torque(k, x->input, b.W, mrw * b.V) + x->M;
  l->free = change_under(l, Q_r, Q_phi + k->d * Q_r, Q_phi);
  return b;
}

// F as a share of its largest value: it ends the slip h_t or falls short of
// that, and never drives it.
static tf_real_t stopping_share(const given_t *x, const held_t *b, tf_real_t r,
                                change_t by) {
  const tf_machine_t *k = x->machine;
  const tf_real_t omega0 = x->input->omega0;
  const tf_real_t p = b->p + k->theta * b->linear.free.p + k->d * omega0;
  const tf_real_t z = b->W + k->theta * b->linear.free.z - omega0;
  const tf_real_t h = slip_from_pq(k, p, r * z).h;
  const tf_real_t change = -k->theta * slip_from_pq(k, by.p, r * by.z).h;
  if (magnitude(h) < change) return h / change;
  return (tf_real_t)((h > 0) - (h < 0));
}

// One step about one guess. `excess`: the work of M and of the turntable beyond
// that at either end of the step, where the law bounds it.
static balanced_end_t end_about(const given_t *x, middle_t c,
                                tf_real_t *excess) {
  const tf_machine_t *k = x->machine;
  const tf_state_t *from = x->state;
  const held_t b = hold(x, c);
  const change_t by = response_to(k, &b.linear, (tf_force_t){x->most, 0});
  const tf_real_t share = stopping_share(x, &b, c.r, by);
  const tf_real_t F = share * x->most;
  const change_t to = {b.linear.free.p + share * by.p,
                       b.linear.free.z + share * by.z};
  balanced_end_t end = {.force = {F, x->M}};
  end.at.r = from->r + k->dt * (b.V + k->theta * (to.p + k->d * to.z));
  end.at.w = (b.sigma + c.rho * to.z) / rho_at(k, end.at.r);
  end.at.v = b.p + to.p + k->d * end.at.w;
  const tf_real_t wt = b.W + k->theta * to.z;
  const tf_real_t arm = F * x->input->omega0 * k->cos_gamma;
  *excess = smaller(x->M * (wt - from->w), x->M * (wt - end.at.w)) +
            smaller(arm * (c.r - from->r), arm * (c.r - end.at.r));
  return end;
}

static balanced_end_t end_with(const given_t *x, tf_real_t *excess) {
  const tf_machine_t *k = x->machine;
  const tf_real_t rt = x->state->r + k->theta_dt * x->state->v;
  middle_t c = {rt, x->state->w, rho_at(k, rt)};
  c = middle_of(x, end_about(x, c, excess).at);
  c = middle_of(x, end_about(x, c, excess).at);
  return end_about(x, c, excess);
}

TF_API balanced_end_t tf_balanced_end(const tf_machine_t *k,
                                      const tf_state_t *state,
                                      const tf_input_t *input, unsigned mode,
                                      tf_force_t force) {
  given_t x = {k, state, input, magnitude(force.F), force.M};
  if (tf_tyre_is_set_valued(k->tyre.law)) {
    if (mode > TF_SLIP_MINUS) x.most = k->tyre.mu;
    x.M = clip(force.M, -k->kappa_mu, k->kappa_mu);
  }
  tf_real_t excess;
  balanced_end_t end = end_with(&x, &excess);
  const end_state_t from = {state->r, state->v, state->w};
  const tf_real_t energy = mean_energy(k, input, from, end.at);
  if (k->dt * excess > TF_CREATED_SHARE * energy) { // a blow of the moment
    x.M = 0;
    end = end_with(&x, &excess);
  }
  const tf_slip_t slip =
      slip_speeds(k, end.at.r, end.at.v, end.at.w - input->omega0);
  end.mode = slip_of_sign(slip.h, state->mode);
  if (tf_tyre_is_set_valued(k->tyre.law))
    end.delassus = delassus_at(k, end.at.r * k->cos_gamma, slip.g < 0,
                               inertia_at(k, end.at.r));
  return end;
}

TF_API step_end_t tf_judged_end(const tf_machine_t *k, const tf_state_t *state,
                                const tf_input_t *input, step_end_t to) {
  const end_state_t from = {state->r, state->v, state->w};
  const end_state_t at = to.end.at;
  const tf_force_t force = to.end.force;
  const tf_real_t energy = mean_energy(k, input, from, at);
  const balance_t b = balance_of(k, is_midpoint(k), input, from, at, force.F);
  if (creates_energy(&b, energy)) {
    const balanced_end_t end =
        tf_balanced_end(k, state, input, to.outcome.mode, force);
    to.end.at = end.at;
    to.end.force = end.force;
    to.outcome.residual += magnitude(end.force.F - force.F);
    to.outcome.mode = end.mode;
    to.outcome.is_mean = false;
    to.outcome.is_balanced = true;
    to.outcome.delassus = end.delassus;
  } else if (!is_too_coarse(k, &b, energy, from, at) &&
             !(ends_slip(state->mode, to.outcome.mode) &&
               is_blow(k, from, at))) {
    return to;
  }
  if (to.outcome.status == TF_OK) to.outcome.status = TF_COARSE;
  return to;
}
