// Steps that begin at h = g = 0, and steps that come there in a mode that is
// lost. tf_leave_codim2 decides what follows, wherever the step happens to end.
#include "../model/rates.h"
#include "scheme.h"

// The rest of a step behind h = g = 0 is not shorter than 1/32 of it, so that
// the direction of the slip is not lost in rounding.
#define MAX_SHARE TF_R(0.96875)
// A force of the hull may be larger by a third, for the curvature of a path
// within its step.
#define HULL_SHARE TF_R(0.75)
// A motion turns by less than 1/sqrt(5) rad in the step in which a rest ends.
#define DEPARTURES 5

// What rounding makes of g where forces balance, step after step: that of the
// state, unless the step is incremental, and of the terms of (2) and (3).
static tf_real_t rounding_of_g(const free_motion_t *c) {
  const tf_input_t *input = c->input;
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const linear_t *l = &c->linear;
  const tf_state_t *x = c->state;
  const tf_real_t turn = magnitude(turn_of_step(k, input));
  const force_terms_t size =
      force_terms(k, input, input->r0 - x->r, x->r, x->v, x->w);
  const tf_real_t both = size.torque + magnitude(k->d) * size.radial;
  const tf_real_t p = l->p_b * size.radial + magnitude(l->p_t) * both +
                      magnitude(l->p_c) * size.torque + magnitude(k->d) * turn;
  const tf_real_t z = l->z_t * both + l->z_c * size.torque +
                      magnitude(l->p_t) * size.radial + turn;
  return 64 * TF_REAL_EPSILON * (p + magnitude(x->r) * z) +
         (c->start.incremental ? 0
                               : slip_rounding(k, x->r, x->v, x->w,
                                               magnitude(l->omega0) + turn));
}

static bool signs_agree(const free_motion_t *c, unsigned mode,
                        const forced_end_t *end) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const end_state_t at = end->at;
  return has_signs_of_mode(
      mode, tf_slip_of_end(c, end),
      slip_rounding(k, at.r, at.v, at.w, c->linear.omega0));
}

// Whether a stick that ends on the other side of g = 0 does so by rounding
// alone: it is at rest there, or tends to it. One that passes g = 0 changes g
// by more than the rounding of one step, a quarter of that of several.
static bool rests_at_g_zero(const free_motion_t *c, const inclusion_t *in,
                            const tf_contact_modes_t *s, unsigned mode,
                            tf_real_t rounding) {
  const sign_t sign = sign_in(mode);
  const quadratic_t h = along(&in->h, sign);
  if (!(s->attracting & TF_MODE_BIT(mode)) ||
      slip_plus_solves(&h) != slip_minus_solves(&h))
    return false;
  const forced_end_t end = tf_end_by(c, stick_multipliers(s->x[sign], sign));
  const tf_real_t g = tf_slip_of_end(c, &end).g;
  const tf_real_t change = g - in->g_now;
  const bool decays = within(g, magnitude(in->g_now));
  return within(g, rounding) && (decays || within(change, rounding / 4)) &&
         signs_agree(c, mode, &end);
}

// How a motion comes to h = g = 0 in a step, as the course of a slip has it. A
// stick comes there if it solves but with the other sign of g. One whose g is
// already past 0, and not by rounding, has left that point.
static codim2_course_t arrival_of_stick(const inclusion_t *in,
                                        const tf_contact_modes_t *modes,
                                        sign_t s, tf_real_t rounding) {
  const quadratic_t h = along(&in->h, s), g = along(&in->g, s);
  const bool solves = slip_plus_solves(&h) == slip_minus_solves(&h);
  const tf_real_t x = modes->x[s], end = quadratic_at(&g, x);
  const bool comes =
      with_sign(s, in->g_now) > -rounding && with_sign(s, end) <= 0;
  const tf_real_t change = in->g_now - end;
  const tf_real_t share =
      comes && change != 0 ? clip(in->g_now / change, 0, 1) : 0;
  return (codim2_course_t){.mode = comes && solves ? TF_PINNED : TF_NO_MODE,
                           .share = share,
                           .sum = stick_multipliers(share * x, s),
                           .from = stick_with(s)};
}

// How h and g change at h = g = 0 over a whole step. The turn of the turntable
// under a wheel at rest is part of that.
static codim2_field_t field_of_step(const free_motion_t *c,
                                    const inclusion_t *in) {
  const bool rests = c->state->mode == TF_PINNED;
  const tf_slip_t from = rests ? (tf_slip_t){0, 0} : c->start.slip;
  const affine_t h = {in->h.c0 - from.h, in->h.cx, in->h.cy};
  const affine_t g = {in->g.c0 - from.g, in->g.cx, in->g.cy};
  const multipliers_t pin = {in->pin_x, in->pin_y};
  return (codim2_field_t){h, g, rests ? pin : balancing_multipliers(h, g)};
}

// The same where a slip comes to h = g = 0 within the step, from there on,
// without its speeds. Not where the slider reaches the axis: there r vanishes,
// and the disc goes on turning against the turntable.
static codim2_field_t field_behind(const free_motion_t *c,
                                   const codim2_field_t *field,
                                   tf_real_t share) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_state_t *x = c->state;
  const tf_real_t dt = k->dt, moves = dt * x->v;
  codim2_field_t behind = *field;
  if (within(x->r, magnitude(moves))) return behind;
  const tf_real_t r = x->r + share * moves / 2;
  const rates_t rates = tf_rates_at(k, c->input, r, 0, 0, c->linear.omega0);
  const tf_slip_t free = slip_from_pq(k, dt * rates.dp, dt * rates.dq);
  behind.h.c0 = free.h;
  behind.g.c0 = free.g;
  behind.pin = balancing_multipliers(behind.h, behind.g);
  return behind;
}

static tf_real_t value_under(affine_t f, multipliers_t m) {
  return f.c0 + f.cx * m.x + f.cy * m.y;
}

// Whether a form has a value, but for rounding.
static bool leads_to(const tf_form_t *f, tf_real_t to, multipliers_t m) {
  return within(
      form_value(f, m.x, m.y) - to,
      64 * TF_REAL_EPSILON * form_size(f, magnitude(m.x), magnitude(m.y)));
}

// Ends the step at a slip in a mode, under multipliers found from a guess.
// False where no force of the law's convex hull leads there.
static bool end_at(const free_motion_t *c, const inclusion_t *in, unsigned mode,
                   tf_slip_t to, multipliers_t guess, step_end_t *out) {
  multipliers_t m = guess;
  for (int i = 0; i < 3; i++) m = tf_multipliers_to(&in->h, &in->g, to, m);
  if (!leads_to(&in->h, to.h, m) || !leads_to(&in->g, to.g, m) ||
      !rests_under(TF_REST_HULL, HULL_SHARE * m.x, HULL_SHARE * m.y))
    return false;
  out->end = tf_end_by(c, m);
  out->outcome.mode = mode;
  out->outcome.is_mean = true;
  return signs_agree(c, out->outcome.mode, &out->end);
}

static tf_real_t size_of_slip(tf_slip_t slip) {
  return magnitude(slip.h) + magnitude(slip.g);
}

// Whether a step ends next to a slip, by a share of it.
static bool ends_near(tf_slip_t to, tf_slip_t end, tf_real_t share) {
  const tf_slip_t off = {end.h - to.h, end.g - to.g};
  return size_of_slip(off) <= share * size_of_slip(to);
}

// A step that comes to h = g = 0 goes on from there in the mode that follows,
// under a mean of the forces before and behind, which lies in the hull. leaves:
// the share of the step behind that point, if it goes on in stick or slip.
static bool continue_from_codim2(const free_motion_t *c, const inclusion_t *in,
                                 const codim2_field_t *field,
                                 const consistent_modes_t *modes,
                                 const codim2_course_t *arrival,
                                 step_end_t *out, tf_real_t *leaves) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const unsigned mode =
      tf_leave_codim2(&k->contact, field, arrival->from, arrival->share > 0,
                      c->state->tick, c->state->seed, modes);
  out->outcome.mode = mode;
  if (mode == TF_NO_MODE) return false;
  out->outcome.set = modes->solutions.set;
  if (mode == TF_PINNED) {
    out->end = tf_mode_end(c, &modes->solutions, mode);
    // It also stops what is left of h and g, with a force of the hull.
    return rests_under(TF_REST_HULL, HULL_SHARE * in->pin_x,
                       HULL_SHARE * in->pin_y);
  }
  const multipliers_t by = tf_codim2_multipliers(&k->contact, modes, mode);
  const tf_real_t remaining = 1 - clip(arrival->share, 0, MAX_SHARE);
  const multipliers_t mean = {arrival->sum.x + remaining * by.x,
                              arrival->sum.y + remaining * by.y};
  const tf_slip_t to = {remaining * value_under(field->h, by),
                        remaining * value_under(field->g, by)};
  if (!end_at(c, in, mode, to, mean, out)) return false;
  *leaves = remaining;
  return true;
}

// Whether a motion that has lost its mode may be held at h = g = 0.
static bool may_be_held(const tf_contact_modes_t *s, unsigned mode) {
  return has(s->set, TF_PINNED) && !has(s->set, mode);
}

// The motion passes by h = g = 0. It is held there if it would run to a rest
// there, or if a force of the law takes it there and it has no other way. A
// rest that ends has chosen its mode, but no force of the law leads there: it
// ends in that mode if that solves the inclusion.
static void pass_codim2(const free_motion_t *c, const inclusion_t *in,
                        const codim2_field_t *field,
                        const consistent_modes_t *modes,
                        const tf_contact_modes_t *solutions, step_end_t *out,
                        tf_real_t *leaves) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_state_t *x = c->state;
  tf_contact_modes_t s = *solutions;
  const bool held = may_be_held(&s, x->mode);
  if (held && tf_leave_codim2(&k->contact, field, x->mode, true, x->tick,
                              x->seed, modes) != TF_PINNED)
    s.set &= (uint8_t)~TF_MODE_BIT(TF_PINNED);
  const bool rests = x->mode == TF_PINNED;
  unsigned mode = out->outcome.mode;
  if (!rests || !has(s.set, mode))
    mode = tf_contact_choose(&k->contact, &s, rests ? TF_NO_MODE : x->mode,
                             x->tick, x->seed);
  out->outcome.set = solutions->set;
  out->outcome.mode = mode;
  out->outcome.is_mean = false;
  if (mode != TF_NO_MODE) {
    out->end = tf_mode_end(c, &s, mode);
  } else if (held) {
    const codim2_course_t arrival = {
        .share = 1, .sum = {in->pin_x, in->pin_y}, .from = x->mode};
    if (!continue_from_codim2(c, in, field, modes, &arrival, out, leaves))
      out->outcome.mode = TF_NO_MODE;
  }
}

// A slip ends where its course does: the order in which it comes to h = 0 and g
// = 0 decides what follows. Where friction cannot steer both it ends under the
// force of the course.
static bool follow_course(const free_motion_t *c, const inclusion_t *in,
                          const codim2_course_t *course, unsigned set,
                          step_end_t *out) {
  step_end_t to = *out;
  to.outcome.set = set | TF_MODE_BIT(course->mode);
  bool leads = end_at(c, in, course->mode, course->slip, course->sum, &to);
  if (!leads && is_slip(course->mode)) {
    to.end = tf_end_by(c, course->sum);
    to.outcome.mode = course->mode;
    to.outcome.is_mean = true;
    leads = signs_agree(c, course->mode, &to.end);
  }
  if (leads) *out = to;
  return leads;
}

// Whether a slip that passes by h = g = 0 may miss its future: it has several,
// turns by more than 29 degrees within the step, and loses its mode or comes
// nearer to that point by more than 29 %.
static bool may_miss(tf_slip_t now, tf_slip_t end, bool is_lost, unsigned set) {
  if (size_of(set) < 2) return false;
  const tf_real_t before = square_root(now.h * now.h + now.g * now.g);
  const tf_real_t after = square_root(end.h * end.h + end.g * end.g);
  const bool nears = after < TF_R(0.71) * before;
  const tf_real_t product = now.h * end.h + now.g * end.g;
  return (is_lost || nears) && !(product > TF_R(0.875) * before * after);
}

static codim2_course_t course_of_slip(const free_motion_t *c,
                                      const codim2_field_t *field,
                                      unsigned mode) {
  return tf_codim2_course(&TF_STEP_MACHINE(c)->contact, field, c->start.slip,
                          sign_in(mode));
}

// Whether another future follows where a course comes to h = g = 0 in stick
// instead of slip, or in slip instead of stick. Also where it comes in a stick
// that repels at the start, and not under the mean of the step.
static bool arrives_otherwise(const free_motion_t *c,
                              const codim2_field_t *field,
                              const consistent_modes_t *modes, unsigned from,
                              unsigned next) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const delassus_quadratic_t A = delassus_quadratic(k, sign_in(from));
  if (is_stick(from) && !(delassus_quadratic_at(A, c->state->r) > 0))
    return true;
  const unsigned other = is_slip(from) ? TF_STICK_PLUS : TF_SLIP_PLUS;
  return tf_leave_codim2(&k->contact, field, other, true, c->state->tick,
                         c->state->seed, modes) != next;
}

// The slip with which a step begins; of a stick, where the law has no force
// that keeps h at 0 on its side of g.
static unsigned slip_from_start(const free_motion_t *c, const inclusion_t *in) {
  const unsigned mode = c->state->mode;
  const tf_slip_t now = c->start.slip;
  if (mode == TF_PINNED || (now.h == 0 && now.g == 0)) return TF_NO_MODE;
  if (is_slip(mode)) return mode;
  const quadratic_t h = along(&in->h, sign_in(mode));
  const bool rises = slip_plus_solves(&h), falls = slip_minus_solves(&h);
  return rises == falls ? TF_NO_MODE : slip_with(rises ? PLUS : MINUS);
}

// A slip that has h = g = 0 within reach. It is TF_COARSE where no force of the
// hull leads along its course, where its end is a quarter off that, or where a
// course that has changed its mode decides what follows h = g = 0.
static void end_slip_near_codim2(const free_motion_t *c, const inclusion_t *in,
                                 const codim2_field_t *field, unsigned slip,
                                 const tf_contact_modes_t *s, step_end_t *to,
                                 tf_real_t *leaves) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const codim2_course_t course = course_of_slip(c, field, slip);
  const bool comes = course.mode == TF_PINNED;
  consistent_modes_t modes = {.solutions = {.set = 0}};
  const codim2_field_t behind =
      comes ? field_behind(c, field, course.share) : *field;
  if (comes || may_be_held(s, c->state->mode))
    tf_codim2_modes(&k->contact, &behind, &modes);
  if (comes &&
      continue_from_codim2(c, in, &behind, &modes, &course, to, leaves)) {
    if ((course.from != slip || course.is_straight) &&
        arrives_otherwise(c, &behind, &modes, course.from, to->outcome.mode))
      to->outcome.status = TF_COARSE;
    return;
  }
  pass_codim2(c, in, &behind, &modes, s, to, leaves);
  const unsigned mode = to->outcome.mode;
  const tf_slip_t end = tf_slip_of_end(c, &to->end);
  const bool follows = mode != TF_NO_MODE && mode == course.mode &&
                       ends_near(course.slip, end, TF_R(0.5));
  bool coarse = comes ? size_of(modes.solutions.set) > 1 : !follows;
  // On a limit direction that leads to h = g = 0 (9) makes a slip alternate
  // between both sides; of a slip that ends in stick it lacks some force.
  if (follows && is_slip(mode) && !course.leads_in)
    coarse = !ends_near(course.slip, end, TF_R(0.25));
  else if (course.mode < TF_PINNED && follow_course(c, in, &course, s->set, to))
    coarse = may_miss(c->start.slip, course.slip, course.mode != slip, s->set);
  if (coarse) to->outcome.status = TF_COARSE;
  if (course.mode < TF_PINNED && to->outcome.mode == course.mode &&
      8 * size_of_slip(c->start.slip) < size_of_slip(course.slip))
    *leaves = 1;
}

// A stick that loses its mode where g = 0 is within reach, or a motion that is
// at h = g = 0. A rest that goes on needs no solution of the inclusion.
static void end_at_codim2(const free_motion_t *c, inclusion_t *in,
                          const codim2_field_t *field, tf_contact_modes_t *s,
                          step_end_t *to, tf_real_t *leaves) {
  const unsigned mode = c->state->mode;
  codim2_course_t arrival = {.mode = TF_PINNED, .from = mode};
  if (is_stick(mode)) {
    const tf_real_t rounding = rounding_of_g(c);
    if (rests_at_g_zero(c, in, s, mode, rounding)) {
      to->outcome.mode = mode;
      to->outcome.set = s->set | TF_MODE_BIT(mode);
      to->end = tf_mode_end(c, s, mode);
      return;
    }
    arrival = arrival_of_stick(in, s, sign_in(mode), rounding);
  }
  consistent_modes_t modes = {.solutions = {.set = 0}};
  const bool comes = arrival.mode == TF_PINNED;
  if (comes || may_be_held(s, mode))
    tf_codim2_modes(&TF_STEP_MACHINE(c)->contact, field, &modes);
  if (comes && continue_from_codim2(c, in, field, &modes, &arrival, to, leaves))
    return;
  if (mode == TF_PINNED) { // g is 0: the side of the faster stick is nearer
    in->g_now = unit(sign_in(modes.solutions.near_stick));
    tf_enumerate(in, BOTH_SIGNS, s);
    to->outcome.status = TF_COARSE;
  }
  pass_codim2(c, in, field, &modes, s, to, leaves);
}

// How h and g change at an instant of the step.
TF_INLINE codim2_field_t field_at(const free_motion_t *c, end_state_t at,
                                  tf_real_t omega) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_real_t z = at.w - omega;
  const rates_t rates =
      tf_rates_at(k, c->input, at.r, slider_speed(k, at.v, z), z, omega);
  return tf_codim2_field_of(k, &rates);
}

// Whether the stick with one sign of g attracts the wheel from a rest.
static bool takes_over(const codim2_field_t *field, sign_t s,
                       tf_real_t slowest) {
  const stick_t stick = stick_at(field, s);
  return stick.attracts && within(stick.x, 1) && stick.rate > slowest;
}

// Whether a rest that goes on by the mean of the forces has ended at the start,
// by a stick or the rule, or ends within the step; or whether a rest that the
// step comes to is not what follows by the forces at its start.
TF_RARE bool misses_end_of_rest(const free_motion_t *c) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_real_t turn = turn_of_step(k, c->input);
  const tf_real_t omega = c->linear.omega0 - turn;
  const codim2_field_t field =
      field_at(c, (end_state_t){c->state->r, 0, omega}, omega);
  const tf_real_t slowest = rounding_of_g(c) / k->dt;
  const tf_rule_t rule = k->contact.rule;
  consistent_modes_t leaves = {.solutions = {.set = 0}};
  if (c->state->mode != TF_PINNED) {
    tf_codim2_modes(&k->contact, &field, &leaves);
    return tf_leave_codim2(&k->contact, &field, c->state->mode, true,
                           c->state->tick, c->state->seed,
                           &leaves) != TF_PINNED;
  }
  if (rule == TF_RULE_SLIP_PLUS)
    tf_add_exit(&k->contact, &field, PLUS, &leaves);
  if (rule == TF_RULE_SLIP_MINUS)
    tf_add_exit(&k->contact, &field, MINUS, &leaves);
  if (leaves.solutions.set != 0 ||
      (rule != TF_RULE_RANDOM && (takes_over(&field, PLUS, slowest) ||
                                  takes_over(&field, MINUS, slowest))))
    return true;
  if (turn == 0) return false;
  const rest_motion_t rest = tf_rest_motion(k, c->input, c->state->r, omega);
  return tf_rest_is_interrupted(&rest, k->dt);
}

// Adds where the acceleration of a mode at an instant takes a motion in half of
// its time. False where it has none there, or the other stick is faster.
TF_RARE bool goes(const free_motion_t *c, end_state_t at, tf_real_t omega,
                  unsigned mode, tf_real_t time, tf_slip_t *sum) {
  const tf_contact_t *contact = &TF_STEP_MACHINE(c)->contact;
  const codim2_field_t field = field_at(c, at, omega);
  const sign_t s = sign_in(mode);
  const stick_t stick = stick_at(&field, s);
  multipliers_t by = stick_multipliers(stick.x, s);
  if (is_slip(mode)) {
    consistent_modes_t modes = {.solutions = {.set = 0}};
    tf_add_exit(contact, &field, s, &modes);
    if (!has(modes.solutions.set, mode)) return false;
    by = tf_codim2_multipliers(contact, &modes, mode);
  } else if (!within(stick.x, 1) || !(stick.rate > 0) ||
             takes_over(&field, opposite(s), stick.rate)) {
    return false;
  }
  sum->h += time / 2 * value_under(field.h, by);
  sum->g += time / 2 * value_under(field.g, by);
  return true;
}

// Whether a motion from h = g = 0 turns by little, and goes as far as the mean
// of its accelerations there and at the end takes it: a stiff slip may turn
// within the step, or end.
TF_RARE bool leaves_as_far(const free_motion_t *c, tf_real_t remaining,
                           const step_end_t *to) {
  const tf_machine_t *k = TF_STEP_MACHINE(c);
  const tf_state_t *x = c->state;
  const unsigned mode = to->outcome.mode;
  const tf_slip_t end = tf_slip_of_end(c, &to->end);
  const end_state_t from = {x->r, x->v, x->w}, at = to->end.at;
  const bool rests = x->mode == TF_PINNED;
  const tf_real_t first = rests ? 0 : TF_R(0.5); // by that of the arrival
  tf_slip_t sum = {first * end.h, first * end.g};
  if (is_fast(k, at, DEPARTURES) ||
      (rests && !goes(c, from, x->w, mode, k->dt, &sum)) ||
      !goes(c, at, c->linear.omega0, mode, remaining * k->dt, &sum))
    return false;
  // Where the motion arrives late, a part of the step is taken that it lacks.
  return (remaining < 1 &&
          4 * size_of_slip(end) <= size_of_slip(c->start.slip)) ||
         (remaining > 1 - MAX_SHARE && ends_near(sum, end, TF_R(0.1875)));
}

TF_API void tf_codim2_end(const free_motion_t *c, inclusion_t *in,
                          step_end_t *to) {
  tf_contact_modes_t s = {0};
  // The hull reaches beyond the forces by which signs_of() judges.
  if (c->state->mode != TF_PINNED) tf_enumerate(in, BOTH_SIGNS, &s);
  const codim2_field_t field = field_of_step(c, in);
  const unsigned slip = slip_from_start(c, in);
  tf_real_t leaves = 0;
  *to = (step_end_t){.outcome = {.status = TF_OK}};
  if (slip != TF_NO_MODE)
    end_slip_near_codim2(c, in, &field, slip, &s, to, &leaves);
  else
    end_at_codim2(c, in, &field, &s, to, &leaves);
  if (to->outcome.mode == TF_NO_MODE) {
    tf_least_violation(c, in, s.set, to);
    return;
  }
  to->outcome.delassus = step_delassus(TF_STEP_MACHINE(c), in,
                                       sign_of(tf_slip_of_end(c, &to->end).g));
  if (to->outcome.mode == TF_PINNED
          ? misses_end_of_rest(c)
          : leaves > 0 && !leaves_as_far(c, leaves, to))
    to->outcome.status = TF_COARSE;
}

TF_API bool tf_end_along_course(const free_motion_t *c, const inclusion_t *in,
                                unsigned modes, step_end_t *to) {
  const unsigned from = c->state->mode;
  const codim2_field_t field = field_of_step(c, in);
  const codim2_course_t course =
      course_of_slip(c, &field, is_slip(from) ? from : to->outcome.mode);
  return has(modes, course.mode) &&
         follow_course(c, in, &course, to->outcome.set, to);
}
