// Steps that begin at h = g = 0, and steps that come there in a mode that is
// lost. What follows that point is asked of tf_leave_codim2, which knows
// nothing of where a step happens to end, so that the branch does not depend on
// it.
#include "../friction/codim2.h"
#include "rare_end.h"

// The rest of a step behind h = g = 0 is not shorter than 1/32 of it, so that
// the direction of the slip is not lost in rounding.
#define MOST_SHARE TF_R(0.96875)
// A force of the hull may be larger by a third, for the curvature of a path
// within its step.
#define HULL_SHARE TF_R(0.75)

// What rounding makes of g where forces balance, step after step: that of the
// state, which an incremental step does not have, and that of the terms of (2)
// and (3), whose sum goes into p and q; friction, which balances them, is no
// larger.
static tf_real_t rounding_of_g(const free_motion_t *c,
                               const tf_input_t *input) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const linear_t *l = &c->linear;
  const tf_state_t *x = c->state;
  const tf_real_t r = magnitude(x->r), v = magnitude(x->v);
  const tf_real_t w = magnitude(x->w), mrw = k->m * r * w;
  const tf_real_t outward = k->k2 * magnitude(input->r0 - x->r) + k->c2 * v +
                            mrw * w + magnitude(input->force);
  const tf_real_t around = magnitude(input->torque) + k->c1 * w + 2 * mrw * v;
  const tf_real_t both = around + magnitude(k->d) * outward;
  const tf_real_t p =
      l->p_b * outward + magnitude(l->p_t) * both + magnitude(l->p_c) * around;
  const tf_real_t z =
      l->z_t * both + l->z_c * around + magnitude(l->p_t) * outward;
  return 64 * TF_REAL_EPSILON * (p + r * z) +
         (c->start.incremental ? 0
                               : slip_rounding(k, x->r, x->v, x->w, l->omega0));
}

// Whether a stick that ends on the other side of g = 0 does so by rounding
// alone: it is at rest at g = 0, or comes to it for ever, and goes on. One that
// passes g = 0 changes g by more than the rounding of one step, a quarter of
// that of several, and does not decay.
static bool rests_at_g_zero(const free_motion_t *c, const inclusion_t *in,
                            const solutions_t *s, unsigned mode,
                            tf_real_t rounding) {
  const bool minus = mode == TF_STICK_MINUS;
  const quadratic_t h = along(&in->h, minus);
  const tf_real_t x = minus ? s->x[1] : s->x[0];
  if (!(s->attracting & TF_MODE_BIT(mode)) ||
      (h.at_upper > 0) != (h.at_lower < 0))
    return false;
  const forced_end_t end = end_by(c, (multipliers_t){x, minus ? -x : x});
  const tf_real_t g = end_slip(c, &end).g;
  const tf_real_t change = g - in->g_now;
  const bool decays = within(g, magnitude(in->g_now));
  return within(g, rounding) && (decays || within(change, rounding / 4));
}

// Whether a motion comes to h = g = 0 in a step, in which share of it, and
// under which multipliers.
typedef struct {
  bool comes;
  tf_real_t share;
  multipliers_t under;
} arrival_t;

// A slip that follows its limit direction comes there if that leads in and the
// step is long enough.
static arrival_t arrival_of_slip(const codim2_way_t *way, tf_real_t distance) {
  const bool comes = way->mode != TF_NO_MODE && distance <= -way->rate;
  return (arrival_t){comes, comes ? distance / -way->rate : 0, way->under};
}

// A stick comes there if it solves but with the other sign of g. One whose g is
// already past 0, and not by rounding, has left that point.
static arrival_t arrival_of_stick(const inclusion_t *in, int s,
                                  tf_real_t rounding) {
  const quadratic_t h = along(&in->h, s), g = along(&in->g, s);
  const tf_real_t x = root_within(h.c0, h.c1, h.c2);
  const tf_real_t end = g.c0 + x * (g.c1 + x * g.c2);
  const bool comes =
      s ? in->g_now < rounding && end >= 0 : in->g_now > -rounding && end <= 0;
  const tf_real_t change = in->g_now - end;
  return (arrival_t){comes && (h.at_upper > 0) == (h.at_lower < 0),
                     comes && change != 0 ? clip(in->g_now / change, 0, 1) : 0,
                     {x, s ? -x : x}};
}

// The multipliers under which neither h nor g changes; too large where friction
// cannot do that. Those of in->pin also stop what h and g are at the start.
static multipliers_t balancing_multipliers(affine_t h, affine_t g) {
  const tf_real_t det = h.cx * g.cy - h.cy * g.cx;
  const tf_real_t x = h.cy * g.c0 - h.c0 * g.cy;
  const tf_real_t y = h.c0 * g.cx - h.cx * g.c0;
  if (det == 0) return (multipliers_t){TF_REAL_MAX, TF_REAL_MAX};
  return (multipliers_t){x / det, y / det};
}

// How h and g change at h = g = 0 over a whole step. Where the turntable under
// a wheel at rest changes its speed, that is part of the change.
static codim2_field_t field_of_step(const free_motion_t *c,
                                    const inclusion_t *in) {
  const bool rests = c->state->mode == TF_PINNED;
  const tf_slip_t from = rests ? (tf_slip_t){0, 0} : c->start.slip;
  const affine_t h = {in->h.c0 - from.h, in->h.cx, in->h.cy};
  const affine_t g = {in->g.c0 - from.g, in->g.cx, in->g.cy};
  const multipliers_t pin = {in->pin_x, in->pin_y};
  return (codim2_field_t){h, g, rests ? pin : balancing_multipliers(h, g)};
}

// The multipliers of a slip or stick that leaves h = g = 0.
static multipliers_t leaving_multipliers(const tf_machine_t *k,
                                         const consistent_modes_t *modes,
                                         unsigned mode) {
  if (mode > TF_SLIP_MINUS) {
    const tf_real_t x = modes->lambda[mode == TF_STICK_MINUS] * k->inv_mu;
    return (multipliers_t){x, mode == TF_STICK_MINUS ? -x : x};
  }
  const tf_real_t side = mode == TF_SLIP_PLUS ? TF_R(1.0) : TF_R(-1.0);
  const multipliers_t m = multipliers_at(&k->tyre, modes->T[mode]);
  return (multipliers_t){side * m.x,
                         side * (tf_real_t)modes->sign_g[mode] * m.y};
}

static tf_real_t value_under(affine_t f, multipliers_t m) {
  return f.c0 + f.cx * m.x + f.cy * m.y;
}

// The multipliers that end the step at the slip (h, g), from a guess, by one
// step of Newton's method on (8).
static multipliers_t multipliers_to(const inclusion_t *in, tf_slip_t to,
                                    multipliers_t m) {
  const form_t h = in->h, g = in->g;
  const tf_real_t hx = h.cx + 2 * h.cxx * m.x + h.cxy * m.y;
  const tf_real_t hy = h.cy + h.cxy * m.x + 2 * h.cyy * m.y;
  const tf_real_t gx = g.cx + 2 * g.cxx * m.x + g.cxy * m.y;
  const tf_real_t gy = g.cy + g.cxy * m.x + 2 * g.cyy * m.y;
  const tf_real_t missed_h = form_value(&h, m.x, m.y) - to.h;
  const tf_real_t missed_g = form_value(&g, m.x, m.y) - to.g;
  const tf_real_t det = hx * gy - hy * gx;
  return (multipliers_t){m.x + (hy * missed_g - gy * missed_h) / det,
                         m.y + (gx * missed_h - hx * missed_g) / det};
}

// Ends the step at a slip in a mode, under multipliers that are found from a
// guess. False where no force of the law's convex hull leads there: the path
// has missed h = g = 0 by much, or friction cannot steer (r = 0, gamma = 0).
static bool end_at(const free_motion_t *c, const inclusion_t *in, unsigned mode,
                   tf_slip_t to, multipliers_t guess, step_end_t *out) {
  const multipliers_t m = multipliers_to(in, to, multipliers_to(in, to, guess));
  if (!rests_under(TF_REST_HULL, HULL_SHARE * m.x, HULL_SHARE * m.y))
    return false;
  out->end = end_by(c, m);
  out->outcome.mode = mode;
  out->outcome.is_mean = true;
  const tf_machine_t *k = TF_API_MACHINE(c);
  const end_state_t at = out->end.at;
  return has_signs_of_mode(
      mode, end_slip(c, &out->end),
      slip_rounding(k, at.r, at.v, at.w, c->linear.omega0));
}

// A step that comes to h = g = 0 goes on from there: in the rest of the step it
// goes as far as the mode that follows takes it, under a mean of the forces
// before and behind, which lies in the convex hull of the law.
static bool go_on_from_codim2(const free_motion_t *c, const inclusion_t *in,
                              const codim2_field_t *field,
                              const arrival_t *arrival, step_end_t *out) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  consistent_modes_t modes;
  const bool arrives = arrival->share > 0;
  const unsigned mode =
      tf_leave_codim2(k, field, c->state->mode, arrives, c->state, &modes);
  if (mode == TF_NO_MODE) return false;
  out->outcome.set = modes.solutions.set;
  if (mode == TF_PINNED) {
    out->end = pinned_end(c);
    out->outcome.mode = mode;
    // It also stops what is left of h and g, with a force of the hull.
    return rests_under(TF_REST_HULL, HULL_SHARE * in->pin_x,
                       HULL_SHARE * in->pin_y);
  }
  const multipliers_t leaving = leaving_multipliers(k, &modes, mode);
  const tf_real_t share = clip(arrival->share, 0, MOST_SHARE), rest = 1 - share;
  const multipliers_t mean = {share * arrival->under.x + rest * leaving.x,
                              share * arrival->under.y + rest * leaving.y};
  const tf_slip_t to = {rest * value_under(field->h, leaving),
                        rest * value_under(field->g, leaving)};
  return end_at(c, in, mode, to, mean, out);
}

// The motion passes h = g = 0 by. It is held there if it would run to a rest
// there. If a force of the law takes it there and it has no other way, it comes
// there at the end of the step.
static void pass_codim2(const free_motion_t *c, const inclusion_t *in,
                        const codim2_field_t *field,
                        const solutions_t *solutions, step_end_t *out) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const tf_state_t *x = c->state;
  const unsigned pinned = solutions->set & TF_MODE_BIT(TF_PINNED);
  solutions_t s = *solutions;
  consistent_modes_t modes;
  if (pinned && !has(s.set, x->mode) &&
      tf_leave_codim2(k, field, x->mode, true, x, &modes) != TF_PINNED)
    s.set &= (uint8_t)~pinned;
  const unsigned mode =
      tf_select(k->rule, k->exit_threshold, &s, x->mode, x->tick, x->seed);
  out->outcome.set = solutions->set;
  out->outcome.mode = mode;
  out->outcome.is_mean = false;
  if (mode != TF_NO_MODE) {
    out->end = mode_end(c, &s, mode);
  } else if (pinned) {
    const arrival_t arrival = {true, 1, {in->pin_x, in->pin_y}};
    if (!go_on_from_codim2(c, in, field, &arrival, out))
      out->outcome.mode = TF_NO_MODE;
  }
}

// A slip turns to its limit direction much faster than it moves along it where
// it is so near that h = g = 0 is within reach of the step. There the step
// takes it to that direction if it leads in, because (9) would throw it from
// side to side, or if the slip has lost its mode: which mode follows is then
// decided by the limit directions and not by where the step happens to end.
static bool follow_limit_direction(const free_motion_t *c,
                                   const inclusion_t *in,
                                   const codim2_way_t *way, tf_real_t distance,
                                   const solutions_t *solutions,
                                   step_end_t *out) {
  const bool lost = !has(solutions->set, c->state->mode);
  if (way->mode == TF_NO_MODE || !(way->rate < 0 || lost)) return false;
  const tf_real_t left = distance + way->rate;
  const tf_slip_t to = {left * way->along.h, left * way->along.g};
  out->outcome.set = solutions->set | TF_MODE_BIT(way->mode);
  return end_at(c, in, way->mode, to, way->under, out);
}

// Whether a slip that passes h = g = 0 by turns there within the step, by how
// much the step does not know, while it has more than one future: it is not on
// its limit direction yet, and loses its mode or comes nearer by more than a
// quarter.
static bool turns_by(const codim2_way_t *way, tf_slip_t now, tf_slip_t end,
                     tf_real_t distance, bool is_lost, unsigned set) {
  if (way->mode == TF_NO_MODE || size_of(set) < 2) return false;
  const tf_real_t aligned = now.h * way->along.h + now.g * way->along.g;
  const tf_real_t left = end.h * end.h + end.g * end.g;
  const bool nears = left < TF_R(0.5) * distance * distance;
  return (is_lost || nears) && !(aligned > distance * TF_R(0.875));
}

TF_API void tf_codim2_end(free_motion_t *c, const tf_input_t *input,
                          inclusion_t *in, solutions_t *s, step_end_t *to) {
  const tf_machine_t *k = TF_API_MACHINE(c);
  const unsigned mode = c->state->mode;
  add_pinned_point(c, in);
  // The hull reaches beyond the forces by which signs_of() judges.
  enumerate(in, BOTH_SIGNS, s);
  const codim2_field_t field = field_of_step(c, in);
  const tf_slip_t now = c->start.slip;
  const tf_real_t distance = square_root(now.h * now.h + now.g * now.g);
  *to = (step_end_t){.outcome = {.status = TF_OK}};
  codim2_way_t way = {.mode = TF_NO_MODE};
  bool rests = false;
  arrival_t arrival = {.comes = mode == TF_PINNED || distance == 0};
  if (mode <= TF_SLIP_MINUS && distance > 0) {
    way = tf_codim2_destination(k, &field, now, mode == TF_SLIP_PLUS ? 1 : -1);
    arrival = arrival_of_slip(&way, distance);
  } else if (!arrival.comes) {
    const tf_real_t rounding = rounding_of_g(c, input);
    rests = rests_at_g_zero(c, in, s, mode, rounding);
    arrival = arrival_of_stick(in, mode == TF_STICK_MINUS, rounding);
  }
  if (rests) {
    to->outcome.mode = mode;
    to->outcome.set = s->set | TF_MODE_BIT(mode);
    to->end = mode_end(c, s, mode);
  } else if (!(arrival.comes &&
               go_on_from_codim2(c, in, &field, &arrival, to)) &&
             !follow_limit_direction(c, in, &way, distance, s, to)) {
    pass_codim2(c, in, &field, s, to);
    if (mode <= TF_SLIP_MINUS &&
        turns_by(&way, now, end_slip(c, &to->end), distance,
                 to->outcome.mode != mode, to->outcome.set))
      to->outcome.status = TF_COARSE;
  }
  if (to->outcome.mode == TF_NO_MODE)
    tf_least_violation(c, in, s, to);
  else
    to->outcome.delassus = step_delassus(k, in, end_slip(c, &to->end).g < 0);
}
