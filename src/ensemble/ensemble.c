// Many states at once. A block of lanes goes through the stages of tf_step in
// passes, which are loops over the lanes without a branch on their data, so
// that the compiler makes vector instructions of them:
//   solve    (lanes_solve.h) free motion, inclusion, enumerate
//   choose   where a mode does not go on, tf_contact_choose, lane by lane
//   end      the multipliers of the chosen mode; those of slip only where some
//            lane slips, and lane by lane where few do
//   balance  what the step does to the energy
//   commit   the state and the report
// Lanes that a pass marks rare (refused, out of range, without a mode, a root
// without a series, a slip whose force turns, a balance to be checked) are
// done by tf_step from the state that they had.
#include "twofold/ensemble.h"

#include "../friction/mode_set.h"
#include "../moreau/balance.h"
#include "../moreau/report.h"
#include "lanes_solve.h"

// Up to so many slips cost less one by one than all lanes in vectors.
#define FEW 3

static unsigned select_lane(const tf_machine_t *k, const tf_state_block_t *b,
                            const work_t *work, int i) {
  const tf_contact_modes_t solutions = {
      .set = (uint8_t)work->set[i],
      .attracting = (uint8_t)work->attracting[i],
      .near_stick = work->nearer_minus[i] ? TF_STICK_MINUS : TF_STICK_PLUS,
      .departure = {work->departure[0][i], work->departure[1][i]}};
  return tf_contact_choose(&k->contact, &solutions, b->mode[i], b->tick[i],
                           b->seed[i]);
}

// Of the masks of a block, whether all are 0.
static bool none_of(const mask_t mask[TF_LANES]) {
  mask_t all = 0;
  for (int i = 0; i < TF_LANES; i++) all |= mask[i];
  return all == 0;
}

// Whether the bit of a mode is that of one of two.
TF_INLINE mask_t is_either(mask_t bit, unsigned one, unsigned other) {
  return ~(((bit >> one | bit >> other) & 1u) - 1u);
}

// The kinds of the modes, from their bits.
static void kinds_all(work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t bit = work->bit[i];
    work->slips[i] = is_either(bit, TF_SLIP_PLUS, TF_SLIP_MINUS);
    work->rolls[i] = is_either(bit, TF_STICK_PLUS, TF_STICK_MINUS);
    work->minus[i] = is_either(bit, TF_SLIP_MINUS, TF_STICK_MINUS);
  }
}

// Whether the mode of every lane goes on under every rule.
static bool all_continue(work_t *restrict work) {
  mask_t lost = 0; // its highest bit, where one is taken from 0
  for (int i = 0; i < TF_LANES; i++)
    lost |= (work->bit[i] & work->set[i] & ~work->rare[i] &
             (work->attracting[i] | SLIPS)) -
            1;
  return lost >> (8 * sizeof lost - 1) == 0;
}

// Slips that have h = g = 0 within reach are left to tf_step: is_near_codim2().
static void near_codim2_all(const tf_machine_t *restrict k,
                            const tf_state_block_t *restrict b,
                            const tf_input_t *restrict u,
                            work_t *restrict work) {
  const tf_real_t turn = turn_of_step(k, u);
  for (int i = 0; i < TF_LANES; i++) {
    const tf_slip_t now =
        slip_at_instant(k, turn, b->r[i], work->p[i], work->z[i]);
    const tf_form_t h = form_of(&work->h, i), g = form_of(&work->g, i);
    work->rare[i] |= work->slips[i] & lane_may_vanish(&h, now.h) &
                     lane_may_vanish(&g, now.g);
  }
}

// Whether a stick is lost where its g may change its sign: is_near_codim2().
static bool lane_stick_passes(const work_t *work, int i, unsigned mode) {
  const mask_t own = mode == TF_STICK_PLUS ? work->above[i] : work->below[i];
  return !is_slip(mode) && !own && !(work->set[i] & TF_MODE_BIT(mode));
}

// The mode of one lane at the end of the step.
static unsigned next_mode(const tf_machine_t *k, const tf_state_block_t *b,
                          work_t *work, int i) {
  unsigned mode = b->mode[i];
  if (mode >= TF_PINNED || work->rare[i] || lane_stick_passes(work, i, mode))
    mode = TF_NO_MODE;
  else if (!continues((unsigned)work->set[i], (unsigned)work->attracting[i],
                      mode))
    mode = select_lane(k, b, work, i);
  if (mode == TF_NO_MODE || loses_slip(b->mode[i], mode))
    work->rare[i] = when(true);
  return mode;
}

// Returns how many lanes slip.
static int choose(const tf_machine_t *restrict k,
                  const tf_state_block_t *restrict b, work_t *restrict work) {
  int slips = 0;
  const bool same = all_continue(work);
  for (int i = 0; i < TF_LANES; i++) work->mode[i] = b->mode[i];
  for (int i = 0; i < TF_LANES && !same; i++) {
    work->mode[i] = (uint8_t)next_mode(k, b, work, i);
    work->bit[i] = TF_MODE_BIT(work->mode[i]);
  }
  if (!same) kinds_all(work);
  if (none_of(work->slips)) return 0;
  for (int i = 0; i < TF_LANES; i++) {
    work->slipping[slips] = (uint8_t)i;
    slips += is_slip(work->mode[i]);
  }
  return slips;
}

TF_INLINE change_t lane_change(const work_t *work, int i, tf_real_t x,
                               tf_real_t y) {
  return change_of(x, y, (change_t){work->p_by_x[i], work->z_by_x[i]},
                   (change_t){work->p_by_y[i], work->z_by_y[i]});
}

// (7) for the multipliers of one lane.
TF_INLINE end_state_t lane_end(const tf_machine_t *k, const work_t *work,
                               tf_real_t omega0, int i, tf_real_t x,
                               tf_real_t y) {
  const linear_t l = linear_of(work, omega0, i);
  return end_after(k, &l, lane_change(work, i, x, y));
}

TF_INLINE tf_slip_t lane_theta_slip(const tf_machine_t *k,
                                    const tf_state_block_t *b,
                                    const tf_input_t *u, const work_t *work,
                                    int i, tf_real_t x, tf_real_t y) {
  const linear_t l = linear_of(work, u->omega0, i);
  return slip_at_theta(k, &l, turn_after_theta(k, u),
                       r_at_theta(k, b->r[i], b->v[i]),
                       lane_change(work, i, x, y));
}

static void stick_all(work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t minus = work->minus[i];
    const tf_real_t x = pick(minus, work->root[1][i], work->root[0][i]);
    work->x[i] = x;
    work->y[i] = flip_sign(minus, x);
  }
}

// slip_end() of stages.h for a lane that slips, in three parts, which are
// passes where many lanes do: the force at the start,
TF_INLINE void slip_first(const tf_machine_t *restrict k,
                          const tf_state_block_t *restrict b,
                          const tf_input_t *restrict u, work_t *restrict work,
                          int i) {
  const tf_slip_t now =
      slip_at_instant(k, turn_of_step(k, u), b->r[i], work->p[i], work->z[i]);
  const lane_multipliers_t m =
      lane_multipliers(&k->contact.tyre, flip_sign(work->minus[i], 1), now);
  work->first_x[i] = m.x;
  work->first_y[i] = m.y;
  work->now_g[i] = now.g;
  work->rare[i] |= work->slips[i] & m.rare;
}

// that at the theta point,
TF_INLINE void slip_theta(const tf_machine_t *restrict k,
                          const tf_state_block_t *restrict b,
                          const tf_input_t *restrict u, work_t *restrict work,
                          int i) {
  const tf_slip_t at =
      lane_theta_slip(k, b, u, work, i, work->first_x[i], work->first_y[i]);
  const lane_multipliers_t m =
      lane_multipliers(&k->contact.tyre, flip_sign(work->minus[i], 1), at);
  work->theta_x[i] = m.x;
  work->theta_y[i] = m.y;
  work->rare[i] |= work->slips[i] & m.rare;
}

// and which of both the step ends under; other lanes keep their values.
TF_INLINE void slip_end_lane(const tf_machine_t *restrict k,
                             const tf_input_t *restrict u,
                             work_t *restrict work, int i) {
  const tf_real_t omega0 = u->omega0;
  const mask_t slips = work->slips[i], minus = work->minus[i];
  const tf_real_t side = flip_sign(minus, 1);
  const tf_real_t tau = pick(minus, work->tau[1][i], work->tau[0][i]);
  const multipliers_t first = {work->first_x[i], work->first_y[i]};
  const multipliers_t theta = {work->theta_x[i], work->theta_y[i]};
  const end_state_t end = lane_end(k, work, omega0, i, theta.x, theta.y);
  const tf_slip_t slip = slip_speeds(k, end.r, end.v, end.w - omega0);
  const mask_t stays = when(side * slip.h > 0);
  const multipliers_t limit = {side, tau * side};
  work->x[i] = pick(slips, pick(stays, theta.x, limit.x), work->x[i]);
  work->y[i] = pick(slips, pick(stays, theta.y, limit.y), work->y[i]);
  const mask_t turns = when(force_turns(first, theta)) |
                       (~stays & when(force_turns(first, limit)));
  const mask_t reverses =
      ~stays & when(k->contact.kappa_mu * tau * work->now_g[i] < 0);
  work->rare[i] |= slips & (reverses | turns);
}

static void slip_all(const tf_machine_t *restrict k,
                     const tf_state_block_t *restrict b,
                     const tf_input_t *restrict u, work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) slip_first(k, b, u, work, i);
  for (int i = 0; i < TF_LANES; i++) slip_theta(k, b, u, work, i);
  for (int i = 0; i < TF_LANES; i++) slip_end_lane(k, u, work, i);
}

static void slip_few(const tf_machine_t *restrict k,
                     const tf_state_block_t *restrict b,
                     const tf_input_t *restrict u, work_t *restrict work,
                     int slips) {
  for (int n = 0; n < slips; n++) {
    const int i = work->slipping[n];
    slip_first(k, b, u, work, i);
    slip_theta(k, b, u, work, i);
    slip_end_lane(k, u, work, i);
  }
}

static void ends_all(const tf_machine_t *restrict k,
                     const tf_state_block_t *restrict b, tf_real_t omega0,
                     work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const mask_t slips = work->slips[i], rolls = work->rolls[i];
    const mask_t moves = slips | rolls;
    const end_state_t by = lane_end(k, work, omega0, i, work->x[i], work->y[i]);
    const tf_real_t r = pick(moves, by.r, work->r_explicit[i]);
    const tf_real_t v = keep(moves, by.v), omega = pick(moves, by.w, omega0);
    const tf_real_t size = magnitude(r) + magnitude(v) + magnitude(omega);
    work->F[i] = pick(moves, work->x[i] * k->contact.tyre.mu, work->pin_F[i]);
    work->M[i] = pick(moves, work->y[i] * k->contact.kappa_mu, work->pin_M[i]);
    work->r[i] = r;
    work->v[i] = v;
    work->w[i] = omega;
    const tf_slip_t slip = slip_speeds(k, r, v, omega - omega0);
    const tf_real_t rounding = slip_rounding(k, r, v, omega, omega0);
    work->rare[i] |=
        ~(when(within(size, TF_STATE_LIMIT)) &
          lane_has_signs(slips, rolls, work->minus[i], slip, rounding));
    work->end_h[i] = slip.h;
    work->end_g[i] = slip.g;
    work->stays[i] = moves & when(r == b->r[i]);
  }
}

// A lane whose balance needs a check is rare.
TF_INLINE void balance_lanes(const tf_machine_t *restrict k, bool midpoint,
                             const tf_state_block_t *restrict b,
                             const tf_input_t *restrict u,
                             work_t *restrict work) {
  for (int i = 0; i < TF_LANES; i++) {
    const end_state_t from = {b->r[i], b->v[i], b->w[i]};
    const end_state_t end = {work->r[i], work->v[i], work->w[i]};
    const balance_t balance = balance_of(k, midpoint, u, from, end, work->F[i]);
    work->rare[i] |= ~when(is_balanced(&balance));
  }
}

static void balance_all(const tf_machine_t *restrict k,
                        const tf_state_block_t *restrict b,
                        const tf_input_t *restrict u, work_t *restrict work) {
  if (is_midpoint(k))
    balance_lanes(k, true, b, u, work);
  else
    balance_lanes(k, false, b, u, work);
}

static void finish_all(const tf_machine_t *restrict k,
                       tf_state_block_t *restrict b,
                       const work_t *restrict work,
                       tf_report_block_t *restrict out) {
  if (k->with_angle) // (12)
    for (int i = 0; i < TF_LANES; i++)
      b->phi[i] += angle_change(k, b->w[i], work->w[i]);
  for (int i = 0; i < TF_LANES; i++) {
    const tf_force_t force = {work->F[i], work->M[i]};
    const tf_slip_t slip = {work->end_h[i], work->end_g[i]};
    const mask_t minus = work->below[i] | (~work->above[i] & when(slip.g < 0));
    const tf_real_t h1 = work->h.cx[i] + flip_sign(minus, work->h.cy[i]);
    b->r[i] = work->r[i];
    b->v[i] = work->v[i];
    b->w[i] = work->w[i];
    out->F[i] = force.F;
    out->M[i] = force.M;
    out->h[i] = slip.h;
    out->g[i] = slip.g;
    out->delassus[i] = delassus_of_slope(k, h1);
    out->residual[i] =
        lane_residual(k, work->slips[i], work->minus[i], force, slip);
  }
}

// Lanes that have left r as it was may stall: the last test of tf_step as well.
static __attribute__((noinline)) void judge_stalls(const tf_machine_t *k,
                                                   const tf_state_block_t *b,
                                                   const tf_input_t *u,
                                                   const work_t *work,
                                                   tf_report_block_t *out) {
  for (size_t i = 0; i < TF_LANES; i++) {
    if (!work->stays[i] || work->rare[i]) continue;
    const tf_state_t state = tf_ensemble_get(b, i);
    tf_report_t report = tf_ensemble_report(out, i);
    const tf_status_t status = tf_status_of_stall(k, u, &state, &report);
    out->status[i] = (int8_t)status;
  }
}

// tf_step for one lane, from the state and the report that it had.
static void step_lane(const tf_machine_t *k, const tf_state_block_t *before,
                      const tf_report_block_t *last, const tf_input_t *u,
                      tf_state_block_t *b, tf_report_block_t *out, size_t i) {
  tf_state_t state = tf_ensemble_get(before, i);
  tf_report_t report = tf_ensemble_report(last, i);
  (void)tf_step(k, &state, u, &report);
  tf_ensemble_put(b, i, &state);
  out->F[i] = report.force.F;
  out->M[i] = report.force.M;
  out->h[i] = report.slip.h;
  out->g[i] = report.slip.g;
  out->delassus[i] = report.delassus;
  out->residual[i] = report.residual;
  out->mode[i] = report.mode;
  out->set[i] = report.set;
  out->choices[i] = report.choices;
  out->status[i] = (int8_t)report.status;
}

// Modes, sets and ticks. The number of modes is size_of() without its table,
// which vectors cannot look up.
static void record_all(tf_state_block_t *restrict b,
                       const work_t *restrict work,
                       tf_report_block_t *restrict out) {
  for (int i = 0; i < TF_LANES; i++) out->set[i] = (uint8_t)work->set[i];
  for (int i = 0; i < TF_LANES; i++) {
    const uint8_t set = out->set[i];
    out->choices[i] = (uint8_t)((set & 1) + (set >> 1 & 1) + (set >> 2 & 1) +
                                (set >> 3 & 1) + (set >> 4));
    out->mode[i] = b->mode[i] = work->mode[i];
    out->status[i] = TF_OK;
  }
  for (int i = 0; i < TF_LANES; i++) b->tick[i]++;
}

// Returns how many lanes were done one by one.
static size_t step_block(const tf_machine_t *k, tf_state_block_t *b,
                         const tf_input_t *u, tf_report_block_t *out) {
  work_t work;
  tf_state_block_t before;
  tf_report_block_t last;
  solve(k, b, u, &work);
  kinds_all(&work);
  if (!none_of(work.slips)) near_codim2_all(k, b, u, &work);
  const int slips = choose(k, b, &work);
  stick_all(&work);
  if (slips > FEW)
    slip_all(k, b, u, &work);
  else
    slip_few(k, b, u, &work, slips);
  ends_all(k, b, u->omega0, &work);
  balance_all(k, b, u, &work);
  const bool rare = !none_of(work.rare);
  if (rare) {
    before = *b;
    last = *out;
  }
  finish_all(k, b, &work, out);
  record_all(b, &work, out);
  if (!none_of(work.stays)) judge_stalls(k, b, u, &work, out);
  size_t alone = 0;
  for (size_t i = 0; i < TF_LANES && rare; i++) {
    if (!work.rare[i]) continue;
    step_lane(k, &before, &last, u, b, out, i);
    alone++;
  }
  return alone;
}

TF_API void tf_ensemble_put(tf_state_block_t *blocks, size_t index,
                            const tf_state_t *state) {
  tf_state_block_t *b = blocks + index / TF_LANES;
  const size_t i = index % TF_LANES;
  b->r[i] = state->r;
  b->v[i] = state->v;
  b->w[i] = state->w;
  b->phi[i] = state->phi;
  b->tick[i] = state->tick;
  b->seed[i] = state->seed;
  b->mode[i] = state->mode;
}

TF_API tf_state_t tf_ensemble_get(const tf_state_block_t *blocks,
                                  size_t index) {
  const tf_state_block_t *b = blocks + index / TF_LANES;
  const size_t i = index % TF_LANES;
  return (tf_state_t){.r = b->r[i],
                      .v = b->v[i],
                      .w = b->w[i],
                      .phi = b->phi[i],
                      .tick = b->tick[i],
                      .seed = b->seed[i],
                      .mode = b->mode[i]};
}

TF_API tf_report_t tf_ensemble_report(const tf_report_block_t *blocks,
                                      size_t index) {
  const tf_report_block_t *b = blocks + index / TF_LANES;
  const size_t i = index % TF_LANES;
  return (tf_report_t){.mode = b->mode[i],
                       .set = b->set[i],
                       .choices = b->choices[i],
                       .force = {b->F[i], b->M[i]},
                       .slip = {b->h[i], b->g[i]},
                       .delassus = b->delassus[i],
                       .residual = b->residual[i],
                       .status = (tf_status_t)b->status[i]};
}

TF_API size_t tf_ensemble_run(const tf_machine_t *machine,
                              tf_state_block_t *states, size_t n,
                              const tf_input_t *input, uint32_t steps,
                              tf_report_block_t *reports) {
  const bool fast = machine->contact.stick_kappa > 0; // of the jump law alone
  size_t alone = 0;
  for (size_t i = 0; i < TF_BLOCKS(n); i++) {
    const size_t left = n - i * TF_LANES;
    tf_input_t u = *input;
    // Vectors do neither a block that is not full nor one of another law.
    for (uint32_t at = 0; at < steps; at++, u.alpha = 0) {
      if (fast && left >= TF_LANES) {
        alone += step_block(machine, states + i, &u, reports + i);
        continue;
      }
      for (size_t j = 0; j < TF_LANES && j < left; j++, alone++)
        step_lane(machine, states + i, reports + i, &u, states + i, reports + i,
                  j);
    }
  }
  return alone;
}

TF_API size_t tf_ensemble_step(const tf_machine_t *machine,
                               tf_state_block_t *states, size_t n,
                               const tf_input_t *input,
                               tf_report_block_t *reports) {
  return tf_ensemble_run(machine, states, n, input, 1, reports);
}
