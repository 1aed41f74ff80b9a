// Peers written by hand for the law that jumps, as a good engineer would write
// them: Runge-Kutta at a fixed step, every switch located, libm's tangents.
//
// A step that passes a switch is taken again up to it: the cubic through both
// ends of the step says where, and Newton's method refines it. So a switch
// costs a step or two and leaves the order as it is. On the way into h = g = 0
// the steps shrink with the time that is left, because the field depends on
// the angle there, which changes ever faster.
#include <string.h>

#include "model.h"

// Steps of fixed length in one smooth field: classical Runge-Kutta of order
// four, and order five of Dormand and Prince (1980).

static inline point_t ahead(point_t y, double t, point_t dy) {
  return (point_t){y.r + t * dy.r, y.h + t * dy.h, y.z + t * dy.z,
                   y.t + t * dy.t};
}

// A step: its end, and the estimate of its error but for the part that hangs
// on the rates at the end, which the next step needs anyway.
typedef struct {
  point_t end, error;
} step_t;

// One step of a field whose rates `dy` at y the caller has already.
typedef step_t advance_t(const model_t *k, contact_t c, point_t y, point_t dy,
                         double t);

static inline step_t rk4(const model_t *k, contact_t c, point_t y, point_t dy,
                         double t) {
  const point_t k2 = contact_rates(k, c, ahead(y, t / 2, dy));
  const point_t k3 = contact_rates(k, c, ahead(y, t / 2, k2));
  const point_t k4 = contact_rates(k, c, ahead(y, t, k3));
  const point_t end = ahead(ahead(y, t / 6, dy), t / 3, k2);
  return (step_t){ahead(ahead(end, t / 3, k3), t / 6, k4), {0, 0, 0, 0}};
}

// y + t (b[0] rate[0] + ... + b[n - 1] rate[n - 1])
static inline point_t mixed(point_t y, double t, const point_t *rate,
                            const double *b, int n) {
  point_t sum = {0, 0, 0, 0};
  for (int i = 0; i < n; i++) sum = ahead(sum, b[i], rate[i]);
  return ahead(y, t, sum);
}

// Share of the rates at the end in the estimate of the error of dp5.
static const double dp5_last = -1.0 / 40;

static inline step_t dp5(const model_t *k, contact_t c, point_t y, point_t dy,
                         double t) {
  static const double stage[5][5] = {
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176,
       -5103.0 / 18656}};
  static const double weight[6] = {
      35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
  static const double embedded[6] = {71.0 / 57600,      0,
                                     -71.0 / 16695,     71.0 / 1920,
                                     -17253.0 / 339200, 22.0 / 525};
  point_t rate[6] = {dy};
  for (int i = 0; i < 5; i++)
    rate[i + 1] = contact_rates(k, c, mixed(y, t, rate, stage[i], i + 1));
  return (step_t){mixed(y, t, rate, weight, 6),
                  mixed((point_t){0, 0, 0, 0}, t, rate, embedded, 6)};
}

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
} walk_t;

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
                            const walk_t *x, switch_t at, double t,
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
                              const events_t *by, walk_t *x, double *t,
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

static inline walk_t events_run(const model_t *k, advance_t *advance,
                                const problem_t *problem, const events_t *by) {
  walk_t x = {.y = model_start(k, problem), .contact = contact_of(k, problem)};
  double left = problem->length, dt = by->tol > 0 ? by->dt / 100 : by->dt;
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

// `advance` is a constant at every call, so that all of a run is one loop.
static inline void run(advance_t *advance, const problem_t *problem,
                       events_t by, answer_t *answer) {
  const model_t k = model_of(problem);
  const walk_t x = events_run(&k, advance, problem, &by);
  model_end(&k, x.y, answer->x);
  answer->lost = x.lost;
}

// rk4 by its step, dp5 by its tolerance. The share shrinks as dt^(1/5), so that
// the way into h = g = 0 keeps up with the order of the rest.
static void solve(const problem_t *problem, const char *solver,
                  const double number[NUMBERS], answer_t *answer) {
  const double tol = number[0];
  const long steps = harness_steps(problem, number[0]);
  const double dt = problem->length / (double)steps;
  if (strcmp(solver, "rk4") == 0)
    run(rk4, problem, (events_t){dt, 0, pow(dt, 0.2) / 2, dt * dt / 10},
        answer);
  else
    run(dp5, problem, (events_t){0.25, tol, 0.5, sqrt(tol) / 10}, answer);
}

int main(int argc, char **argv) { return harness_main(argc, argv, solve); }
