/// What a good engineer would write by hand: Runge-Kutta at a fixed step, every
/// switch located, libm's tangents.
///
/// A step that passes a switch is taken again up to it: the cubic through both
/// ends of the step says where, and Newton's method refines it. So a switch
/// costs a step or two and leaves the order as it is. On the way into h = g = 0
/// the steps shrink with the time that is left, because the field depends on
/// the angle there, which changes ever faster.
#pragma once

#include "runge_kutta.h"

enum { MOST = 100000 }; // steps after which a run is given up

typedef struct {
  double dt;    // longest step [s]
  double tol;   // of the error of a step; 0: all steps have the length dt
  double share; // of the time to h = g = 0 that one step may take
  double near;  // that time [s] below which the rest is a straight line
} events_t;

typedef struct {
  point_t y, dy; // state and its rates
  contact_t contact;
  int lost; // the rule for h = g = 0 found no way on
} motion_t;

static inline double margin_rate(const model_t *k, contact_t c, switch_t at,
                                 point_t y, point_t dy) {
  if (at == AT_H) return c.side * dy.h;
  if (at == AT_G) return c.roll * rolling_rate(k, y, dy);
  const double t = 1e-6; // lambda has no short derivative
  return (margin(k, c, at, ahead(y, t, dy)) -
          margin(k, c, at, ahead(y, -t, dy))) /
         (2 * t);
}

// The root in (0, 1) of the cubic with values e0 > 0 >= e1 and slopes s0, s1
// at both ends: Newton's rule inside a bracket.
static inline double cubic_root(double e0, double e1, double s0, double s1) {
  double low = 0, high = 1, x = e0 / (e0 - e1);
  const double c2 = 3 * (e1 - e0) - 2 * s0 - s1, c3 = 2 * (e0 - e1) + s0 + s1;
  for (int i = 0; i < 12; i++) {
    const double e = e0 + x * (s0 + x * (c2 + x * c3));
    const double slope = s0 + x * (2 * c2 + x * 3 * c3);
    if (e > 0) {
      low = x;
    } else {
      high = x;
    }
    double next = x - e / slope;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (fabs(next - x) < 1e-9) return next;
    x = next;
  }
  return x;
}

// Which switch the step to `end` has passed.
static inline switch_t passed(const model_t *k, contact_t c, point_t end) {
  if (c.side && margin(k, c, AT_H, end) < 0) return AT_H;
  if (margin(k, c, AT_G, end) < 0) return AT_G;
  if (!c.side && margin(k, c, AT_LAMBDA, end) < 0) return AT_LAMBDA;
  return NOWHERE;
}

// The length at which a step of length t, which ends in *end, meets the switch;
// *end is then the state there.
static inline double locate(const model_t *k, advance_t *advance,
                            const motion_t *x, switch_t at, double t,
                            point_t *end) {
  const contact_t c = x->contact;
  const double e0 = margin(k, c, at, x->y);
  const double s0 = margin_rate(k, c, at, x->y, x->dy);
  const point_t rate = contact_rates(k, c, *end);
  double length = t * cubic_root(e0, margin(k, c, at, *end), t * s0,
                                 t * margin_rate(k, c, at, *end, rate));
  for (int i = 0; i < 8; i++) {
    *end = advance(k, c, x->y, x->dy, length).end;
    const point_t last = contact_rates(k, c, *end);
    const double rest =
        -margin(k, c, at, *end) / margin_rate(k, c, at, *end, last);
    if (fabs(rest) < 1e-5 * t) { // the square of it does not count
      *end = ahead(*end, rest, last);
      return length + rest;
    }
    length += rest;
  }
  return length;
}

// By what the length of a step may change, after its error (order five).
static inline double growth(const events_t *by, point_t y, point_t end_rate,
                            point_t error, double t) {
  const point_t e = ahead(error, t * dp5_last, end_rate);
  const double worst =
      fmax(fabs(e.r) / (1 + fabs(y.r)),
           fmax(fabs(e.h) / (1 + fabs(y.h)), fabs(e.z) / (1 + fabs(y.z))));
  const double fit = 0.9 * pow(by->tol / worst, 0.2);
  return fit > 5 ? 5 : fit > 0.2 ? fit : 0.2; // NaN as well
}

// One step of length <= *t, up to the next switch if there is one. Returns 0
// where its error is too large; *t is then shorter.
static inline int events_step(const model_t *k, advance_t *advance,
                              const events_t *by, motion_t *x, double *t,
                              double *dt) {
  const step_t step = advance(k, x->contact, x->y, x->dy, *t);
  point_t end = step.end, rate = contact_rates(k, x->contact, end);
  if (by->tol > 0) {
    const double grow = growth(by, x->y, rate, step.error, *t);
    const double fit = *t * grow;
    // A step that was cut short says nothing against longer ones.
    if (grow < 1 || fit > *dt) *dt = fit < by->dt ? fit : by->dt;
    if (grow < 0.9) return 0;
  }
  // Of two switches in one step the first counts: the step up to one of them
  // is looked at again.
  switch_t at = NOWHERE, next = passed(k, x->contact, end);
  while (next != NOWHERE && next != at) {
    at = next;
    *t = locate(k, advance, x, at, *t, &end);
    next = passed(k, x->contact, end);
  }
  x->y = end;
  if (at != NOWHERE) {
    x->lost = !change(k, at, &x->contact, &x->y);
    rate = contact_rates(k, x->contact, x->y);
  }
  x->dy = rate;
  return 1;
}

static inline motion_t events_run(const model_t *k, advance_t *advance,
                                  const problem_t *problem,
                                  const events_t *by) {
  motion_t x = {.y = model_start(k, problem)};
  double left = problem->length, dt = by->tol > 0 ? by->dt / 100 : by->dt;
  x.contact.side = problem_side(problem);
  x.contact.roll = rolling(k, x.y) < 0 ? -1 : 1;
  x.dy = contact_rates(k, x.contact, x.y);
  for (long tries = 0; left > 0 && !x.lost && tries < MOST; tries++) {
    // What remains after rounding is not worth a step of its own.
    double t = left < dt * 1.000001 ? left : dt;
    if (x.contact.side) {
      const double fall = time_to_fall(k, x.y, x.dy);
      if (fall > 0 && fall < by->near) {
        left -= fall;
        x.lost = !capture(k, x.dy, fall, &x.y, &x.contact);
        x.dy = contact_rates(k, x.contact, x.y);
        continue;
      }
      if (fall > 0 && t > fall * by->share) t = fall * by->share;
    }
    if (events_step(k, advance, by, &x, &t, &dt)) left -= t;
  }
  x.lost |= !(left <= 0);
  return x;
}
