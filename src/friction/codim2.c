// The consistent modes at h = g = 0. The force of a slip depends there on the
// direction of the slip in the (g, h) plane alone, and a slip can begin or end
// in h = g = 0 only along a limit direction: one whose acceleration has no
// component across it (Antali and Stepan 2018, for extended Filippov systems).
#include "codim2.h"

#include "mode_set.h"
#include "rest_law.h"

static const search_t exits = {true, false, 0};

TF_API bool tf_codim2_attractor(const tf_contact_t *contact,
                                const codim2_field_t *field, sign_t sign_g,
                                sign_t sign_h, tf_real_t *T) {
  const quadrant_t q = tf_quadrant_of(&contact->tyre, field, sign_g, sign_h);
  const search_t last = {false, false, TF_REAL_MAX};
  limit_direction_t to = no_direction;
  tf_search_quadrant(&contact->tyre, &q, &last, &to);
  if (to.exists) *T = to.T;
  return to.exists;
}

TF_API void tf_add_exit(const tf_contact_t *contact,
                        const codim2_field_t *field, sign_t sign_h,
                        consistent_modes_t *out) {
  static const sign_t signs[2] = {MINUS, PLUS};
  limit_direction_t best = no_direction;
  for (int n = 0; n < 2; n++) {
    const quadrant_t q =
        tf_quadrant_of(&contact->tyre, field, signs[n], sign_h);
    if (tf_may_leave(&q, contact->tyre.T_anchor[TF_TYRE_ANCHORS - 1]))
      tf_search_quadrant(&contact->tyre, &q, &exits, &best);
  }
  if (!best.exists) return;
  const unsigned bit = TF_MODE_BIT(slip_with(sign_h));
  out->T[sign_h] = best.T;
  out->sign_g[sign_h] = best.sign_g;
  out->solutions.set |= (uint8_t)bit;
  if (best.is_attractor) out->solutions.attracting |= (uint8_t)bit;
  out->solutions.departure[sign_h] = with_sign(sign_h, best.growth);
}

// The stick with the sign s of g, if the law has the force that keeps h at 0
// and g gets that sign under it. Returns how fast g grows, 0 where it does not.
static tf_real_t add_stick(const tf_contact_t *contact,
                           const codim2_field_t *field, sign_t s,
                           consistent_modes_t *out) {
  tf_contact_modes_t *solutions = &out->solutions;
  const stick_t stick = stick_at(field, s);
  const uint8_t bit = (uint8_t)TF_MODE_BIT(stick_with(s));
  if (stick.attracts) solutions->attracting |= bit;
  if (!within(stick.x, 1) || !(stick.rate > 0)) return 0;
  solutions->set |= bit;
  out->lambda[s] = stick.x * contact->tyre.mu;
  return stick.rate;
}

TF_API void tf_codim2_modes(const tf_contact_t *contact,
                            const codim2_field_t *field,
                            consistent_modes_t *out) {
  *out = (consistent_modes_t){.solutions = {.set = 0}};
  tf_add_exit(contact, field, PLUS, out);
  tf_add_exit(contact, field, MINUS, out);
  const tf_real_t plus = add_stick(contact, field, PLUS, out);
  const tf_real_t minus = add_stick(contact, field, MINUS, out);
  const bool is_minus = minus != plus ? minus > plus : field->g.c0 < 0;
  out->solutions.near_stick = is_minus ? TF_STICK_MINUS : TF_STICK_PLUS;
  if (rests_under(contact->rest, field->pin.x, field->pin.y))
    out->solutions.set |= (uint8_t)TF_MODE_BIT(TF_PINNED);
}

TF_API multipliers_t tf_codim2_multipliers(const tf_contact_t *contact,
                                           const consistent_modes_t *modes,
                                           unsigned mode) {
  const sign_t s = sign_in(mode);
  if (!is_slip(mode))
    return stick_multipliers(modes->lambda[s] * contact->inv_mu, s);
  return signed_multipliers(multipliers_at(&contact->tyre, modes->T[s]), s,
                            modes->sign_g[s]);
}

TF_API unsigned tf_leave_codim2(const tf_contact_t *contact,
                                const codim2_field_t *field, unsigned from,
                                bool arrives, uint64_t tick, uint32_t seed,
                                const consistent_modes_t *modes) {
  tf_contact_modes_t s = modes->solutions;
  // Where the law of stick holds the wheel, a stick that arrives goes on.
  if (arrives && !is_slip(from) &&
      rests_under(TF_REST_BOW_TIE, field->pin.x, field->pin.y))
    s.attracting |= (uint8_t)TF_MODE_BIT(TF_PINNED);
  const bool lost = arrives || (from != TF_PINNED && !has(s.set, from));
  const unsigned mode =
      tf_contact_choose(contact, &s, lost ? TF_NO_MODE : from, tick, seed);
  // A wheel that comes to rest may leave at once, as it could at the start of
  // the next step. The draw of RANDOM belongs to that one.
  if (!arrives || mode != TF_PINNED || contact->rule == TF_RULE_RANDOM)
    return mode;
  return tf_contact_choose(contact, &s, TF_PINNED, tick, seed);
}

// The course of a slip near h = g = 0, where its velocity (h', g') depends on
// its angle alone.

// Through how many quadrants a slip comes at most. It crosses h = 0 where h'
// has one sign on both sides: c0 < -|cx + cy| where g > 0 from h > 0, and c0 >
// |cx - cy| where g < 0 back, and both cannot be. So it never goes round.
#define QUADRANTS 4
// Cosine of pi/64: a slip that is so near to its limit direction is on it.
#define ALIGNED TF_R(0.9988)
// A slip that begins straight to h = g = 0, turning by less than 1/256 of that,
// but to no limit direction next to it, may turn the other way.
#define STRAIGHT 256

// A point of a quadrant, H = |h| and G = |g|, and the course up to it.
typedef struct {
  tf_real_t H, G;
  tf_real_t time; // as a share of the step
  multipliers_t sum;
  bool is_straight; // see STRAIGHT
} course_point_t;

static void add_force(course_point_t *at, multipliers_t force, tf_real_t time) {
  at->sum.x += time * force.x;
  at->sum.y += time * force.y;
  at->time += time;
}

static multipliers_t force_in(const tf_tyre_t *tyre, const quadrant_t *q,
                              tf_real_t T) {
  return signed_multipliers(multipliers_at(tyre, T), q->sign_h, q->sign_g);
}

static codim2_course_t course_to(const course_point_t *at, unsigned mode,
                                 tf_slip_t slip, bool leads_in) {
  return (codim2_course_t){mode,     slip, at->time,       at->sum,
                           leads_in, mode, at->is_straight};
}

// Goes on straight away from h = g = 0 or to it, from a distance and at a rate,
// under one force.
static codim2_course_t along_direction(course_point_t *at, unsigned mode,
                                       tf_slip_t direction, tf_real_t distance,
                                       tf_real_t rate, multipliers_t force) {
  const tf_real_t remaining = 1 - at->time;
  if (!(distance + rate * remaining > 0)) {
    const tf_real_t time = rate < 0 ? distance / -rate : 0;
    add_force(at, force, time < remaining ? time : remaining);
    codim2_course_t end = course_to(at, TF_PINNED, (tf_slip_t){0, 0}, true);
    end.from = mode;
    return end;
  }
  const tf_real_t left = distance + rate * remaining;
  add_force(at, force, remaining);
  return course_to(
      at, mode, (tf_slip_t){left * direction.h, left * direction.g}, rate < 0);
}

static codim2_course_t along_limit(const tf_tyre_t *tyre, const quadrant_t *q,
                                   const limit_direction_t *to,
                                   course_point_t *at) {
  const tf_slip_t direction = {with_sign(q->sign_h, to->C),
                               with_sign(q->sign_g, to->S)};
  return along_direction(at, slip_with(q->sign_h), direction,
                         at->H * to->C + at->G * to->S, to->growth,
                         force_in(tyre, q, to->T));
}

static codim2_course_t along_stick(const codim2_field_t *field, sign_t sign_g,
                                   course_point_t *at) {
  const stick_t stick = stick_at(field, sign_g);
  return along_direction(at, stick_with(sign_g), (tf_slip_t){0, unit(sign_g)},
                         at->G, stick.rate, stick_multipliers(stick.x, sign_g));
}

// Moves straight to where it is nearest to h = g = 0, and counts as there.
static void come_to_codim2(course_point_t *at, tf_real_t H_rate,
                           tf_real_t G_rate, multipliers_t force) {
  const tf_real_t rate2 = H_rate * H_rate + G_rate * G_rate;
  const tf_real_t nears = -(at->H * H_rate + at->G * G_rate);
  add_force(at, force, clip(nears / rate2, 0, 1 - at->time));
  at->H = 0;
  at->G = 0;
}

// Moves straight to the border of a cell, in the direction (C, S). Returns
// whether the step goes on from there. At h = g = 0 a slip turns in no time.
static bool cross_cell(const tf_tyre_t *tyre, const quadrant_t *q, tf_real_t C,
                       tf_real_t S, course_point_t *at) {
  if (at->H == 0 && at->G == 0) return true;
  const tf_real_t size = square_root(at->H * at->H + at->G * at->G);
  const tf_real_t H_mid = at->H + size * C, G_mid = at->G + size * S;
  const tf_real_t T = tf_cot_psi(tyre, G_mid, H_mid);
  const tf_real_t H_rate = q->h0 + q->h1 * T, G_rate = q->g0 + q->g1 * T;
  const tf_real_t remaining = 1 - at->time;
  const tf_real_t across = H_rate * S - G_rate * C;
  const tf_real_t time = (at->G * C - at->H * S) / across;
  const bool crosses = time >= 0 && time < remaining;
  const tf_real_t moves = crosses ? time : remaining;
  const tf_real_t H = at->H + moves * H_rate, G = at->G + moves * G_rate;
  const tf_real_t distance = H * C + G * S;
  const multipliers_t force = force_in(tyre, q, T);
  if (!(distance > 0)) { // past h = g = 0
    come_to_codim2(at, H_rate, G_rate, force);
    return true;
  }
  add_force(at, force, moves);
  // By the velocity in its middle a cell may be left the other way: a course
  // stays in its quadrant.
  at->H = crosses ? distance * C : clip(H, 0, TF_REAL_MAX);
  at->G = crosses ? distance * S : clip(G, 0, TF_REAL_MAX);
  return crosses;
}

// Goes through the cells of a quadrant up to the one that has the limit
// direction, and there half of the distance to it, or to the end of the
// quadrant. Returns whether the step goes on.
static bool cross_quadrant(const tf_tyre_t *tyre, const quadrant_t *q,
                           const limit_direction_t *to, bool upwards,
                           tf_real_t T, course_point_t *at) {
  for (int i = 1; i < TF_TYRE_ANCHORS; i++) {
    const int n = upwards ? i : TF_TYRE_ANCHORS - 1 - i;
    const tf_real_t T_border = tyre->T_anchor[n];
    if (upwards ? T_border <= T : T_border >= T) continue;
    if (to->exists && (upwards ? T_border >= to->T : T_border <= to->T)) {
      const tf_real_t size = square_root(at->H * at->H + at->G * at->G);
      if (at->H * to->C + at->G * to->S >= ALIGNED * size) {
        at->is_straight &= size == 0;
        return true;
      }
      const tf_real_t C = to->C + at->H / size, S = to->S + at->G / size;
      const tf_real_t length = square_root(C * C + S * S);
      return cross_cell(tyre, q, C / length, S / length, at);
    }
    if (!cross_cell(tyre, q, anchor_cos[n], anchor_cos[8 - n], at))
      return false;
  }
  return true;
}

TF_API codim2_course_t tf_codim2_course(const tf_contact_t *contact,
                                        const codim2_field_t *field,
                                        tf_slip_t slip, sign_t sign_h) {
  const tf_tyre_t *tyre = &contact->tyre;
  const direction_t steepest = {0, 1, tyre->T_anchor[TF_TYRE_ANCHORS - 1]};
  const direction_t flattest = {1, 0, 0};
  const tf_real_t H = with_sign(sign_h, slip.h);
  course_point_t now = {H > 0 ? H : 0, magnitude(slip.g), 0, {0, 0}, false};
  // From g = 0 to the side to which g moves at T = 0.
  const tf_real_t g_rate =
      field->g.c0 + with_sign(sign_h, MAX_SLIP_FORCE(field->g.cx));
  sign_t sign_g = sign_of(slip.g == 0 ? g_rate : slip.g);
  direction_t at = {now.H, now.G, tf_cot_psi(tyre, now.G, now.H)};
  quadrant_t q = tf_quadrant_of(tyre, field, sign_g, sign_h);
  const tf_real_t turns = angular_rate(&q, at);
  const tf_real_t nears =
      -(q.h0 + q.h1 * at.T) * now.H - (q.g0 + q.g1 * at.T) * now.G;
  now.is_straight = STRAIGHT * magnitude(turns) < nears;
  bool upwards = turns > 0;
  for (int i = 0; i < QUADRANTS; i++) {
    const search_t next = {false, upwards, at.T};
    limit_direction_t to = no_direction;
    tf_search_quadrant(tyre, &q, &next, &to);
    if (!cross_quadrant(tyre, &q, &to, upwards, at.T, &now)) {
      const tf_slip_t end = {with_sign(sign_h, now.H),
                             with_sign(sign_g, now.G)};
      return course_to(&now, slip_with(sign_h), end, false);
    }
    if (to.exists) return along_limit(tyre, &q, &to, &now);
    if (upwards)
      sign_h = opposite(sign_h);
    else
      sign_g = opposite(sign_g);
    at = upwards ? steepest : flattest;
    q = tf_quadrant_of(tyre, field, sign_g, sign_h);
    if (upwards && angular_rate(&q, at) > 0)
      return along_stick(field, sign_g, &now);
    upwards = !upwards;
  }
  return (codim2_course_t){.mode = TF_NO_MODE};
}
