#include "follow.h"

#include <math.h>
#include <stddef.h>

#define AT_REST REAL(1e-8) // [m/s], the sum of |h| and |g|

typedef real_t (*event_t)(const motion_t *, const course_t *, const point_t *);

static real_t beyond_fold(const motion_t *k, const course_t *c,
                          const point_t *p) {
  (void)k;
  return p->x[0] - (real_t)c->fold;
}

static real_t rolling(const motion_t *k, const course_t *c, const point_t *p) {
  (void)c;
  return slip_at(k, p->x).g;
}

static real_t inside(const motion_t *k, const course_t *c, const point_t *p) {
  const slip_t s = slip_at(k, p->x);
  return (real_t)c->exit * layer_width(k, s.g) - absolute(s.h);
}

static bool crosses(const motion_t *k, const course_t *c, event_t event,
                    const point_t *from, const point_t *to) {
  return (event(k, c, from) > 0) != (event(k, c, to) > 0);
}

// Where the event lies between two points of one step: by regula falsi, every
// third time by bisection.
static point_t locate(motion_t *k, const course_t *c, event_t event,
                      const point_t *from, const point_t *to) {
  real_t low = 0, high = to->t - from->t;
  real_t at_low = event(k, c, from), at_high = event(k, c, to);
  point_t p = *to;
  for (int n = 0; n < 60 && high - low > 4 * UNIT; n++) {
    const real_t dt = n % 3 == 2
                          ? (low + high) / 2
                          : low + (high - low) * at_low / (at_low - at_high);
    leap(k, from, dt, COLUMNS, &p);
    const real_t e = event(k, c, &p);
    if ((e > 0) == (at_low > 0)) {
      low = dt;
      at_low = e;
    } else {
      high = dt;
      at_high = e;
    }
  }
  return p;
}

static void next_point(motion_t *k, const course_t *c, const point_t *p,
                       real_t *dt, point_t *next) {
  const real_t left = (real_t)c->until - p->t;
  if (c->step > 0) {
    k->error += leap(k, p, (real_t)c->step, c->columns, next);
    k->steps++;
  } else {
    if (*dt > left) *dt = left;
    advance(k, p, dt, next);
  }
}

// What happened between two points, after the two-fold.
static void note(motion_t *k, const course_t *c, const point_t *p,
                 const point_t *next, outcome_t *out) {
  const bool was = slip_at(k, p->x).h > 0, is = slip_at(k, next->x).h > 0;
  if (out->side != 0) {
    out->windings += was != is;
  } else if (inside(k, c, next) < 0) {
    const point_t at =
        inside(k, c, p) > 0 ? locate(k, c, inside, p, next) : *next;
    out->exit_t = (double)at.t;
    out->exit_r = (double)at.x[0];
    out->side = slip_at(k, at.x).h > 0 ? 1 : -1;
  }
}

// Laws of the slip angle alone have no limit there: what follows is rounding.
static bool at_rest(const motion_t *k, const point_t *p) {
  const slip_t s = slip_at(k, p->x);
  return k->law.form >= FORM_ANGLE && absolute(s.h) + absolute(s.g) < AT_REST;
}

outcome_t follow(motion_t *k, const course_t *c, point_t p) {
  outcome_t out = {NAN, NAN, NAN, NAN, NAN, 0, 0, 0, 0, p};
  real_t dt = REAL(1e-6);
  // A fixed step need not add up to the end to the last bit.
  const double end = c->until - (c->step > 0 ? c->step / 2 : 1e-14);
  while ((double)p.t < end && isnan(out.zero_t)) {
    point_t next;
    next_point(k, c, &p, &dt, &next);
    const double grown =
        (double)((next.t - p.t) * (layer_rate(k, p.x) + layer_rate(k, next.x)) /
                 2);
    if (isnan(out.fold_t)) {
      out.before += grown;
      if (crosses(k, c, beyond_fold, &p, &next)) {
        next = locate(k, c, beyond_fold, &p, &next);
        out.fold_t = (double)next.t;
        next.x[1] -= (real_t)c->kick / k->sine;
      }
    } else {
      if (out.side == 0) out.behind += grown;
      note(k, c, &p, &next, &out);
      if (crosses(k, c, rolling, &p, &next) || at_rest(k, &next)) {
        if (!at_rest(k, &next)) next = locate(k, c, rolling, &p, &next);
        out.zero_t = (double)next.t;
        out.zero_r = (double)next.x[0];
      }
    }
    p = next;
  }
  out.end = p;
  return out;
}
