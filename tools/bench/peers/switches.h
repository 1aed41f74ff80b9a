/// A motion for solvers that find the roots of functions themselves: the
/// functions, and what becomes of the motion at a root.
#pragma once

#include "bench/harness.h"
#include "model.h"

enum { ROOTS = 3 };

typedef struct {
  model_t model;
  contact_t contact;
  double near; // [m/s] of h = g = 0: the rest is a straight line
} motion_t;

static inline motion_t motion_of(const problem_t *problem, double tol) {
  motion_t x = {.model = model_of(problem), .near = sqrt(tol) / 10};
  x.contact.side = problem_side(problem);
  x.contact.roll =
      rolling(&x.model, model_start(&x.model, problem)) < 0 ? -1 : 1;
  return x;
}

// The margins of g, of h or lambda, and in slip of the way to h = g = 0.
static inline void margins(const motion_t *x, point_t at, double root[ROOTS]) {
  const contact_t c = x->contact;
  root[0] = margin(&x->model, c, AT_G, at);
  root[1] = margin(&x->model, c, c.side ? AT_H : AT_LAMBDA, at);
  root[2] = c.side ? hypot(at.h, root[0]) - x->near : 1;
}

// Goes on from root number i at time *t. Returns 0 where nothing is possible.
static inline int change_at(motion_t *x, int i, double *t, point_t *at) {
  const model_t *k = &x->model;
  contact_t *c = &x->contact;
  if (!c->side || i == 1)
    return change(k, i != 1 ? AT_G : c->side ? AT_H : AT_LAMBDA, c, at);
  const point_t dy = slip_rates(k, *c, *at);
  if (i == 0) {
    // g is 0 to rounding, so that the root may be found twice.
    c->roll = rolling_rate(k, *at, dy) < 0 ? 1 : -1;
    return change(k, AT_G, c, at);
  }
  const double fall = time_to_fall(k, *at, dy);
  if (!(fall > 0)) return 1;
  *t += fall;
  return capture(k, dy, fall, at, c);
}
