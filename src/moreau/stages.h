// The parts of a step of set-valued or single-valued friction, inline, for two
// steps: with `more` NULL the plain one, else the compensated one (carry.h).
// Which is known where these are inlined, so neither has a thing of the other.
#ifndef TF_STAGES_H
#define TF_STAGES_H

#include <stddef.h>

#include "../friction/inclusion.h"
#include "../friction/mode_set.h"
#include "../model/tyre_law.h"
#include "compensation.h"
#include "linear.h"
#include "twofold/select.h"
#include "twofold/step.h"

// How near to h = g = 0 the way of a slip must pass, as a share of its length.
#define TF_NEAR TF_R(0.5)

// What the parts of one step read.
typedef struct {
  const tf_machine_t *machine;
  const tf_state_t *state;
  const digits_t *more; // NULL: a plain step
  tf_slip_t now;        // slip at the start, of a compensated step
  tf_linear_t linear;
  tf_real_t r, z;     // end of the step without friction
  tf_slip_t free;     // its slip
  tf_response_t F, M; // answers to F = mu, M = kappa mu
} motion_t;

// The machine of a motion. A build for one scene knows it where it compiles.
#ifndef TF_API_MACHINE
#define TF_API_MACHINE(c) ((c)->machine)
#endif

TF_INLINE motion_t motion(const tf_machine_t *k, const tf_state_t *state,
                          const digits_t *more, const tf_input_t *input) {
  motion_t c = {.machine = k,
                .state = state,
                .more = more,
                .linear = linearise(k, state, input)};
  if (more) c.now = start_slip(more, state, &c.linear);
  const tf_real_t p = c.linear.p + c.linear.free.p;
  c.z = c.linear.z + c.linear.free.z;
  c.r = c.linear.r_explicit + k->theta_dt * (p + k->d * c.z);
  c.free = more ? slip_after(k, state, &c.linear, c.now, c.linear.free)
                : slip_from_pq(k, p, c.r * c.z);
  c.F = response_at_end(k, force_response(k, &c.linear));
  c.M = response_at_end(k, moment_response(k, &c.linear));
  return c;
}

TF_INLINE tf_slip_t slip_now(const motion_t *c) {
  if (c->more) return c->now;
  return slip_from_pq(TF_API_MACHINE(c), c->linear.p,
                      c->state->r * c->linear.z);
}

TF_INLINE tf_slip_t slip_at_theta(const motion_t *c, tf_change_t friction) {
  const tf_real_t r_theta =
      c->state->r + TF_API_MACHINE(c)->theta_dt * c->state->v;
  return theta_slip(TF_API_MACHINE(c), &c->linear, r_theta, friction);
}

TF_INLINE tf_change_t change_by(const motion_t *c, tf_multipliers_t m) {
  return (tf_change_t){m.x * c->F.p + m.y * c->M.p,
                       m.x * c->F.z + m.y * c->M.z};
}

// An end of a step. Of a compensated one only the force, the change of the
// velocities and the slip, until it is taken.
typedef struct {
  tf_end_t at;
  tf_change_t change;
  tf_slip_t slip;
} end_t;

TF_INLINE end_t end_under(const motion_t *c, tf_force_t force,
                          tf_change_t friction) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  if (!c->more) return (end_t){.at = end_after(k, &c->linear, force, friction)};
  const tf_change_t change = {c->linear.free.p + friction.p,
                              c->linear.free.z + friction.z};
  return (end_t){{.force = force},
                 change,
                 slip_after(k, c->state, &c->linear, c->now, change)};
}

TF_INLINE tf_slip_t slip_of(const motion_t *c, const end_t *end) {
  if (c->more) return end->slip;
  return end_slip(TF_API_MACHINE(c), &c->linear, &end->at);
}

TF_INLINE end_t end_by(const motion_t *c, tf_multipliers_t m) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  return end_under(c, (tf_force_t){m.x * k->tyre.mu, m.y * k->kappa_mu},
                   change_by(c, m));
}

// Pinned, the end is what the force was solved for, without its rounding.
TF_INLINE end_t end_pinned(const motion_t *c) {
  const tf_end_t rest = {pinning_force(TF_API_MACHINE(c), &c->linear),
                         c->linear.r_explicit, 0, c->linear.omega0};
  return (end_t){rest, {0, 0}, {0, 0}};
}

TF_INLINE tf_multipliers_t slip_multipliers(const tf_tyre_t *tyre,
                                            tf_real_t side, tf_slip_t at) {
  if (tyre->law == TF_TYRE_COULOMB) return (tf_multipliers_t){side, 0};
  return jump_multipliers(tyre, side, at.h, at.g);
}

// Slip under a set-valued law on one side of h = 0: the force is predicted
// from the start, then taken at the theta point. Where that would throw the
// wheel across h = 0 although the limit at h -> 0 holds it on its side, the
// true end lies between the two and the limit is taken.
TF_INLINE end_t slip_end(const motion_t *c, tf_real_t side, tf_real_t tau) {
  const tf_tyre_t *tyre = &TF_API_MACHINE(c)->tyre;
  const tf_multipliers_t first = slip_multipliers(tyre, side, slip_now(c));
  const tf_slip_t at = slip_at_theta(c, change_by(c, first));
  const end_t end = end_by(c, slip_multipliers(tyre, side, at));
  if (side * slip_of(c, &end).h > 0) return end;
  return end_by(c, (tf_multipliers_t){side, tau * side});
}

// The end of the step in one of the modes that solve it.
TF_INLINE end_t mode_end(const motion_t *c, const tf_solutions_t *s,
                         unsigned mode) {
  if (mode == TF_PINNED) return end_pinned(c);
  // No index that is known only at run time: the arrays stay in registers.
  if (mode == TF_SLIP_PLUS || mode == TF_SLIP_MINUS)
    return slip_end(c, mode == TF_SLIP_PLUS ? TF_R(1.0) : TF_R(-1.0),
                    mode == TF_SLIP_PLUS ? s->tau[0] : s->tau[1]);
  const tf_real_t x = mode == TF_STICK_PLUS ? s->x[0] : s->x[1];
  return end_by(c, (tf_multipliers_t){x, mode == TF_STICK_PLUS ? x : -x});
}

TF_INLINE tf_inclusion_t inclusion(const motion_t *c) {
  tf_inclusion_t in = {.has_moment = TF_API_MACHINE(c)->stick_kappa > 0};
  slip_forms(TF_API_MACHINE(c), c->r, c->z, c->free, &c->F, &c->M, &in.h,
             &in.g);
  return in;
}

// What is read only where g+ can have both signs.
TF_INLINE void complete(const motion_t *c, tf_inclusion_t *in) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const tf_force_t pin = pinning_force(k, &c->linear);
  in->g_now = slip_now(c).g;
  in->pin_x = pin.F * k->inv_mu;
  in->pin_y = pin.M * k->inv_kappa_mu;
}

// In slip the angle is not in question: only the side is checked.
TF_INLINE tf_real_t residual(const tf_machine_t *k, unsigned mode,
                             tf_force_t force, tf_slip_t slip) {
  if (mode > TF_SLIP_MINUS)
    return law_residual(k->tyre.mu, k->stick_kappa, force, slip.h, slip.g);
  return law_residual(1, 0, (tf_force_t){mode == TF_SLIP_PLUS ? 1 : -1, 0},
                      slip.h, slip.g);
}

TF_INLINE tf_status_t refuse(tf_report_t *report, tf_status_t status) {
  report->status = status;
  return status;
}

// What every step ends with: a new state and the report on it.
TF_INLINE tf_status_t record(tf_state_t *state, tf_end_t end, tf_slip_t slip,
                             tf_real_t rest, unsigned mode, unsigned set,
                             tf_real_t delassus, tf_status_t status,
                             tf_report_t *report) {
  report->mode = (uint8_t)mode;
  report->set = (uint8_t)set;
  report->choices = (uint8_t)size_of(set);
  report->force = end.force;
  report->slip = slip;
  report->delassus = delassus;
  report->residual = rest;
  report->status = status;
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

// Whether the straight way of the slip from one place to another passes h = g =
// 0 within a share of its length.
TF_INLINE bool passes_near(tf_slip_t from, tf_slip_t to) {
  const tf_real_t h = to.h - from.h, g = to.g - from.g;
  const tf_real_t length2 = h * h + g * g;
  const tf_real_t ahead = clip(-(from.h * h + from.g * g), 0, length2);
  const tf_real_t share = length2 > 0 ? ahead / length2 : 0;
  const tf_real_t off_h = from.h + share * h, off_g = from.g + share * g;
  return off_h * off_h + off_g * off_g <= TF_NEAR * TF_NEAR * length2;
}

// Whether a motion whose mode is lost in this step meets h = g = 0 in it, and
// finds neither an attracting stick to roll on in nor a force of the law that
// keeps it at rest: a stick that solves, but with the other sign of g; a slip
// whose present force would take both h and g past 0. What comes of it is
// decided at h = g = 0 and not by where a step happens to end: this one ends
// there, under a mean of the forces before and behind, which is within the
// square that is the convex hull of the law at h = g = 0.
TF_INLINE bool meets_rest(const motion_t *c, const tf_inclusion_t *in,
                          unsigned set, unsigned attracting) {
  const unsigned mode = c->state->mode;
  const unsigned going_on = attracting | TF_MODE_BIT(TF_PINNED);
  if (mode == TF_PINNED || set & going_on || !in->has_moment ||
      !within(in->pin_x, 1) || !within(in->pin_y, 1))
    return false;
  if (mode > TF_SLIP_MINUS) {
    const ray_t h = along(&in->h, mode == TF_STICK_MINUS);
    // One that g = 0 is already behind of has left it: it does not go back.
    const bool comes = mode == TF_STICK_MINUS ? in->g_now < 0 : in->g_now > 0;
    return comes && (h.plus > 0) == (h.minus < 0);
  }
  const tf_slip_t now = slip_now(c);
  const end_t end = end_by(
      c, slip_multipliers(&TF_API_MACHINE(c)->tyre,
                          mode == TF_SLIP_PLUS ? TF_R(1.0) : TF_R(-1.0), now));
  const tf_slip_t then = slip_of(c, &end);
  return passes_near(now, then);
}

// What the step falls back on where no mode is consistent, or none that a slip
// may enter: of all those that it may, the one that violates the law least.
typedef struct {
  end_t end;
  unsigned mode, set;
  tf_real_t delassus;
} least_t;

TF_INLINE least_t least_violating(const motion_t *c) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  tf_inclusion_t in = inclusion(c);
  tf_solutions_t s = {0};
  const unsigned signs = signs_of(&in.g);
  complete(c, &in);
  solve(&in, signs, &s);
  least_t best = {mode_end(c, &s, TF_PINNED), TF_PINNED, s.set, 0};
  tf_real_t least = TF_REAL_MAX;
  solve_both_signs(&in, &s); // candidates, whatever g would be
  const bool slipping = c->state->mode <= TF_SLIP_MINUS;
  for (unsigned mode = 0; mode < TF_MODES; mode++) {
    const bool sticks = mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
    if (slipping && sticks && !(s.attracting & TF_MODE_BIT(mode))) continue;
    const end_t end = mode_end(c, &s, mode);
    const tf_real_t rest = residual(k, mode, end.at.force, slip_of(c, &end));
    if (!(rest < least)) continue;
    least = rest;
    best.mode = mode;
    best.end = end;
  }
  const tf_real_t h1 =
      slip_of(c, &best.end).g < 0 ? in.h.F - in.h.M : in.h.F + in.h.M;
  best.delassus = -h1 * k->inv_mu_dt;
  return best;
}

// A single-valued law does not read the side.
TF_INLINE tf_force_t single_valued_law(const tf_machine_t *k, tf_slip_t at) {
  return tf_tyre_force(&k->tyre, at.h, at.h, at.g);
}

// (11): a single-valued law may still be stiff in h. Its secant F = c h at the
// predicted slip is taken implicitly where that damps (the end of the step
// answers with E < 0) and explicitly where it drives. The secant never
// extrapolates: |share| <= 1.
TF_INLINE tf_force_t secant_force(const motion_t *c, tf_slip_t at,
                                  tf_real_t h_now) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const tf_force_t f = single_valued_law(k, at);
  if (at.h == 0) return f;
  const tf_response_t a = response_at_end(k, response(k, &c->linear, f));
  const tf_real_t E = slip_from_pq(k, a.p, c->r * a.z + c->z * a.r).h / at.h;
  if (!(E < 0)) return f;
  const tf_real_t h =
      (h_now + k->theta * (c->free.h - h_now)) / (1 - k->theta * E);
  const tf_real_t share = clip(h / at.h, -1, 1);
  return (tf_force_t){share * f.F, share * f.M};
}

// The end under a force of a single-valued law, its mode and how far the force
// is from the law at the theta point.
TF_INLINE unsigned mode_under(const motion_t *c, tf_force_t force, end_t *end,
                              tf_real_t *rest) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const tf_change_t change = response(k, &c->linear, force);
  *end = end_under(c, force, change);
  const tf_real_t h = slip_of(c, end).h;
  const tf_slip_t slip = slip_at_theta(c, change);
  *rest = magnitude(force.F - single_valued_law(k, slip).F);
  return h > 0   ? TF_SLIP_PLUS
         : h < 0 ? TF_SLIP_MINUS
                 : c->state->mode & 1u; // as it was at h = 0
}

// The force of a single-valued law for a step.
TF_INLINE tf_force_t single_valued_force(const motion_t *c) {
  const tf_slip_t now = slip_now(c);
  const tf_force_t first = secant_force(c, now, now.h);
  const tf_slip_t at =
      slip_at_theta(c, response(TF_API_MACHINE(c), &c->linear, first));
  return secant_force(c, at, now.h);
}

#endif
