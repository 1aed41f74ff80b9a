// The stages of one step under a set-valued law, inline, in the order in which
// a step takes them: free motion (1)-(7), inclusion (8), choice, end in the
// mode (9), (10). scheme.h is the list of them.
#ifndef TF_STAGES_H
#define TF_STAGES_H

#include "../friction/inclusion.h"
#include "../friction/mode_set.h"
#include "../friction/tyre_law.h"
#include "linear.h"
#include "report.h"

// The machine of a step. A build for one scene defines this as its constant
// machine (port/core.h).
#ifndef TF_STEP_MACHINE
#define TF_STEP_MACHINE(c) ((c)->machine)
#endif

// The velocities that a step starts with, against the turntable of its end, and
// its slip at the start. An incremental step has its slip to more digits than p
// and z are stored in: it adds the change over the step to the slip at the
// start. A plain step computes the slip from the state that it will store, so
// that its report is the slip of that state.
typedef struct {
  tf_real_t p, z;
  tf_slip_t slip; // where known
  bool incremental, known;
} start_t;

// That of a plain step.
TF_INLINE start_t start_of(const tf_machine_t *k, const tf_state_t *state,
                           const tf_input_t *input) {
  const change_t at = velocities(k, state, input->omega0);
  return (start_t){.p = at.p, .z = at.z};
}

// The motion without friction, and how it responds to friction.
typedef struct {
  const tf_machine_t *machine;
  const tf_state_t *state;
  const tf_input_t *input;
  start_t start;
  linear_t linear;
  free_end_t end;
  tf_slip_t slip; // at the end, without friction
} free_motion_t;

// The slip after a change of p and z, from that at the start: q changes by
// r dz + z+ dr, while the turntable turns faster by so much.
TF_INLINE tf_slip_t slip_by_increment(const tf_machine_t *k,
                                      const tf_state_t *state,
                                      const start_t *start, tf_real_t turn,
                                      change_t c) {
  const tf_real_t dr =
      k->dt * state->v + k->theta_dt * slider_velocity(k, c.p, c.z);
  const tf_slip_t by = slip_from_pq(
      k, c.p + k->d * turn, state->r * (c.z - turn) + (start->z + c.z) * dr);
  return (tf_slip_t){start->slip.h + by.h, start->slip.g + by.g};
}

// Free motion, (1)-(7).
TF_INLINE free_motion_t free_motion(const tf_machine_t *k,
                                    const tf_state_t *state,
                                    const tf_input_t *input, start_t start) {
  const linear_t linear =
      linearise(k, state, input, (change_t){start.p, start.z});
  if (!has_friction(k))
    return (free_motion_t){.machine = k,
                           .state = state,
                           .input = input,
                           .start = start,
                           .linear = linear};
  const free_end_t end = free_end(k, &linear);
  return (free_motion_t){
      .machine = k,
      .state = state,
      .input = input,
      .start = start,
      .linear = linear,
      .end = end,
      .slip = start.incremental
                  ? slip_by_increment(k, state, &start, turn_of_step(k, input),
                                      linear.free)
                  : slip_from_pq(k, end.p, end.r * end.z)};
}

TF_INLINE tf_slip_t start_slip(const free_motion_t *c) {
  if (c->start.known) return c->start.slip;
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  return slip_at_instant(k, turn_of_step(k, c->input), c->state->r, c->start.p,
                         c->start.z);
}

// In memory, for parts of a step that read it more than once.
TF_INLINE void know_start_slip(free_motion_t *c) {
  c->start.slip = start_slip(c);
  c->start.known = true;
}

// Where a step ends under a force. Of an incremental step r, v, w are what a
// plain step would store: compensated.c computes them in pairs.
typedef struct {
  tf_force_t force;
  change_t friction; // of the velocities, unless pinned
  end_state_t at;
  bool pinned;
  bool reverses, turns, held; // see slip_end()
} forced_end_t;

// Where a step ends, and what it has decided.
typedef struct {
  forced_end_t end;
  outcome_t outcome;
} step_end_t;

// (7)
TF_INLINE forced_end_t end_under(const free_motion_t *c, tf_force_t force,
                                 change_t friction) {
  const end_state_t at = end_after(TF_STEP_MACHINE(c), &c->linear, friction);
  return (forced_end_t){.force = force, .friction = friction, .at = at};
}

TF_INLINE tf_slip_t end_slip(const free_motion_t *c, const forced_end_t *end) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const linear_t *l = &c->linear;
  if (!c->start.incremental)
    return slip_speeds(k, end->at.r, end->at.v, end->at.w - l->omega0);
  if (end->pinned) return (tf_slip_t){0, 0};
  return slip_by_increment(
      k, c->state, &c->start, turn_of_step(k, c->input),
      (change_t){l->free.p + end->friction.p, l->free.z + end->friction.z});
}

// (8): the change of the velocities and the end under multipliers x and y.
TF_INLINE change_t change_by(const free_motion_t *c, multipliers_t m) {
  return change_of(m.x, m.y, (change_t){c->end.by_x.p, c->end.by_x.z},
                   (change_t){c->end.by_y.p, c->end.by_y.z});
}

TF_INLINE forced_end_t end_by(const free_motion_t *c, multipliers_t m) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  return end_under(c, force_under(&k->contact, m), change_by(c, m));
}

// Both as functions of rare ends, which are many: this saves code size.
#define tf_end_by TF_LINK(tf_end_by)
TF_API forced_end_t tf_end_by(const free_motion_t *c, multipliers_t m);

#define tf_slip_of_end TF_LINK(tf_slip_of_end)
TF_API tf_slip_t tf_slip_of_end(const free_motion_t *c,
                                const forced_end_t *end);

// Inclusion, (8).
TF_INLINE inclusion_t inclusion(const free_motion_t *c) {
  inclusion_t in = {.has_moment = TF_STEP_MACHINE(c)->contact.stick_kappa > 0,
                    .rest = TF_STEP_MACHINE(c)->contact.rest};
  slip_forms(TF_STEP_MACHINE(c), &c->end, c->slip, &in.h, &in.g);
  return in;
}

// Adds the point at which the step would end at rest, which is read only where
// g+ can have both signs.
TF_INLINE void add_pinned_point(free_motion_t *c, inclusion_t *in) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_force_t pin = pinning_force(k, &c->linear);
  know_start_slip(c);
  in->g_now = c->start.slip.g;
  in->pin_x = pin.F * k->contact.inv_mu;
  in->pin_y = pin.M * k->contact.inv_kappa_mu;
}

// Inclusion (8) and enumeration: every mode that solves it. Returns: the signs
// that g+ can have.
TF_INLINE unsigned solve_inclusion(free_motion_t *c, inclusion_t *in,
                                   tf_contact_modes_t *s) {
  *in = inclusion(c);
  const unsigned signs = signs_of(&in->g);
  if (signs == BOTH_SIGNS) add_pinned_point(c, in);
  *s = (tf_contact_modes_t){0};
  enumerate(in, signs, s);
  return signs;
}

// Choice. Whether a step that does not begin at rest has h = g = 0 within
// reach; codim2_end.c has what follows.
TF_INLINE bool is_near_codim2(const free_motion_t *c, const inclusion_t *in,
                              unsigned signs, unsigned set) {
  const unsigned mode = c->state->mode;
  if (is_slip(mode)) return slip_reaches_codim2(&in->h, &in->g, start_slip(c));
  return stick_reaches_codim2(mode, signs, set);
}

// tf_contact_choose, from what is in registers.
TF_RARE unsigned select_mode(const tf_machine_t *k, const tf_state_t *state,
                             unsigned set, unsigned near_stick,
                             tf_real_t h_plus, tf_real_t h_minus,
                             unsigned attracting) {
  const tf_contact_modes_t solutions = {.set = (uint8_t)set,
                                        .attracting = (uint8_t)attracting,
                                        .near_stick = (uint8_t)near_stick,
                                        .departure = {h_plus, h_minus}};
  return tf_contact_choose(&k->contact, &solutions, state->mode, state->tick,
                           state->seed);
}

// Choice: the mode that the step ends in; TF_NO_MODE where none is consistent,
// or none that a slip may enter.
TF_INLINE unsigned choose_mode(const tf_machine_t *k, const tf_state_t *state,
                               const tf_contact_modes_t *s) {
  if (continues(s->set, s->attracting, state->mode)) return state->mode;
  return select_mode(k, state, s->set, s->near_stick, s->departure[0],
                     s->departure[1], s->attracting);
}

// End in slip on one side of h = 0, (9): the force is predicted from the start,
// then taken at the theta point. Where that would carry the wheel across h = 0
// although the limit at h -> 0 holds it on its side, the true end lies between
// the two, and the limit is taken. It reverses the slip if its moment belongs
// to the other sign of g than that at the start: then h and g both pass 0
// within the step, which cannot see which of them does so first. The force
// turns if it is not that of the start: the true one changes its direction
// within the step and may differ from both.
TF_INLINE forced_end_t slip_end(const free_motion_t *c, sign_t side,
                                tf_real_t tau, bool rare) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_slip_t now = start_slip(c);
  const multipliers_t first =
      slip_multipliers(&k->contact.tyre, side, now, rare);
  const tf_real_t r_theta = r_at_theta(k, c->state->r, c->state->v);
  const tf_slip_t at =
      slip_at_theta(k, &c->linear, turn_after_theta(k, c->input), r_theta,
                    change_by(c, first));
  const multipliers_t theta =
      slip_multipliers(&k->contact.tyre, side, at, rare);
  forced_end_t end = rare ? tf_end_by(c, theta) : end_by(c, theta);
  end.turns = force_turns(first, theta);
  if (unit(side) * end_slip(c, &end).h > 0) return end;
  const multipliers_t limit = limit_multipliers(side, tau);
  end = rare ? tf_end_by(c, limit) : end_by(c, limit);
  end.turns = force_turns(first, theta) || force_turns(first, limit);
  end.reverses = k->contact.kappa_mu * tau * now.g < 0;
  end.held = true;
  return end;
}

// End at rest, (10): what the force was solved for, without its rounding.
TF_INLINE forced_end_t pinned_end(const free_motion_t *c) {
  const linear_t *l = &c->linear;
  const end_state_t at = {l->r_explicit, 0, l->omega0};
  return (forced_end_t){
      .force = pinning_force(TF_STEP_MACHINE(c), l), .at = at, .pinned = true};
}

// End in one of the modes that solve the inclusion.
TF_INLINE forced_end_t mode_end(const free_motion_t *c,
                                const tf_contact_modes_t *s, unsigned mode,
                                bool rare) {
  if (mode == TF_PINNED) return pinned_end(c);
  // No index that is known only at run time: the arrays stay in registers.
  if (is_slip(mode)) {
    const bool up = mode == TF_SLIP_PLUS;
    return slip_end(c, up ? PLUS : MINUS, up ? s->tau[PLUS] : s->tau[MINUS],
                    rare);
  }
  const bool up = mode == TF_STICK_PLUS;
  const multipliers_t m =
      stick_multipliers(up ? s->x[PLUS] : s->x[MINUS], up ? PLUS : MINUS);
  return rare ? tf_end_by(c, m) : end_by(c, m);
}

// The Delassus scalar of stick at the end of the step, by the sign of g.
TF_INLINE tf_real_t step_delassus(const tf_machine_t *k, const inclusion_t *in,
                                  sign_t s) {
  return delassus_of_slope(
      k, s == PLUS ? in->h.cx + in->h.cy : in->h.cx - in->h.cy);
}

// The same where g+ can have these signs, at the end of the step.
TF_INLINE tf_real_t end_delassus(const free_motion_t *c, const inclusion_t *in,
                                 unsigned signs, const forced_end_t *end) {
  const sign_t s = signs == BOTH_SIGNS   ? sign_of(end_slip(c, end).g)
                   : signs == MINUS_SIGN ? MINUS
                                         : PLUS;
  return step_delassus(TF_STEP_MACHINE(c), in, s);
}

#endif
