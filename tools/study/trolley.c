// trolley - a castor on a body that is pulled at constant speed, by Moreau's
// time stepping on twofold/contact.h alone. Equations and their derivation:
// docs/STUDIES.md; two-folds of castors: trolley.py.
//
// usage: trolley [NAME=VALUE]...
//
// Names and defaults stand in OPTIONS. A motion starts at (y, psi, u = y') with
// the psi' that gives it this h; where that is 0, in stick. An escaping stick
// is kept until `leave` [s], and then ends in slip to the side of `side`.
// Writes a line each `every` steps and at both ends of a step that changes the
// mode, until `until` [s] or h = g = 0.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "twofold.h"

// Mass of the body, yaw inertia of the castor; kappa [m], mu [N] of the law;
// trail [m]; spring, dampers of body and pin; speed. Then the motion; split=0
// does not split steps where slip changes its sign.
#define OPTIONS(X)  \
  X(m, 2.0677)      \
  X(J, 0.0056545)   \
  X(kappa, 0.17152) \
  X(mu, 3.4405)     \
  X(e, -0.15594)    \
  X(k, 4.068)       \
  X(c, 0.0609)      \
  X(cp, 0.00178)    \
  X(V, 0.77967)     \
  X(y, 0)           \
  X(psi, 0)         \
  X(u, 0)           \
  X(h, 0)           \
  X(dt, 1e-4)       \
  X(until, 1)       \
  X(leave, 1e9)     \
  X(side, 1)        \
  X(every, 1)       \
  X(split, 1)
#define AS_DOUBLE(name, value) double name;
#define AS_DEFAULT(name, value) value,
#define AS_TEXT(name, value) #name,

typedef struct {
  OPTIONS(AS_DOUBLE)
} castor_t;
static const char *const names[] = {OPTIONS(AS_TEXT)};

// Displacement of the body and angle of the castor, and their rates.
typedef struct {
  double y, psi, u, w;
} state_t;

static tf_slip_t slip_at(const castor_t *q, double psi, double u, double w) {
  const double C = cos(psi), S = sin(psi);
  return (tf_slip_t){u * C - q->V * S - q->e * w, q->V * C + u * S};
}

// What a speed becomes in a frame that turns by a small angle d = dx x + dy y,
// by the multipliers: value + by_x x + by_angle d + cross x d + square d^2.
static tf_form_t turned(double value, double by_x, double by_angle,
                        double cross, double square, double dx, double dy) {
  return (tf_form_t){value,
                     by_x + by_angle * dx,
                     by_angle * dy,
                     cross * dx + square * dx * dx,
                     cross * dy + 2 * square * dx * dy,
                     square * dy * dy};
}

static double value_of(const tf_form_t *f, double x, double y) {
  return f->c0 + x * (f->cx + x * f->cxx) +
         y * (f->cy + x * f->cxy + y * f->cyy);
}

// A step of the theta scheme, theta = 1/2, before its force is known: the
// velocities without it, what x and y add, and the slip at the end. Forces act
// in the middle, spring and dampers implicitly: order 2.
typedef struct {
  double half, u, w, ux, wx, wy;
  tf_form_t h, g;
} span_t;

static span_t span_of(const castor_t *q, double dt, const state_t *x) {
  const double half = dt / 2, mass = q->m + half * (q->c + half * q->k);
  const double inertia = q->J + half * q->cp;
  const double pull = -q->k * (x->y + half * x->u) - q->c * x->u;
  span_t s = {.half = half,
              .u = x->u + dt * pull / mass,
              .w = x->w - dt * q->cp * x->w / inertia,
              .ux = -dt * q->mu * cos(x->psi + half * x->w) / mass,
              .wx = dt * q->mu * q->e / inertia,
              .wy = dt * q->mu * q->kappa / inertia};
  const double psi = x->psi + half * (x->w + s.w), C = cos(psi), S = sin(psi);
  const double p = s.u * C - q->V * S, r = q->V * C + s.u * S;
  const double dx = half * s.wx, dy = half * s.wy;
  s.h = turned(p, s.ux * C, -r, -s.ux * S, -p / 2, dx, dy);
  s.g = turned(r, s.ux * S, p, s.ux * C, -r / 2, dx, dy);
  s.h.c0 -= q->e * s.w;
  s.h.cx -= q->e * s.wx;
  s.h.cy -= q->e * s.wy;
  return s;
}

static state_t end_of(const castor_t *q, const span_t *s, const state_t *x,
                      tf_force_t f) {
  const double mx = f.F / q->mu, my = f.M / (q->mu * q->kappa);
  const double u = s->u + s->ux * mx, w = s->w + s->wx * mx + s->wy * my;
  return (state_t){x->y + s->half * (x->u + u), x->psi + s->half * (x->w + w),
                   u, w};
}

// The slip in the middle of a step that slips, as its start predicts it.
static tf_slip_t middle(const castor_t *q, const tf_contact_t *contact,
                        const span_t *s, const state_t *x, double side) {
  const tf_slip_t now = slip_at(q, x->psi, x->u, x->w);
  const tf_force_t f = tf_tyre_force(&contact->tyre, side, now.h, now.g);
  const state_t end = end_of(q, s, x, f);
  return slip_at(q, x->psi + s->half * x->w, (x->u + end.u) / 2,
                 (x->w + end.w) / 2);
}

static double side_of(unsigned mode) { return mode == TF_SLIP_MINUS ? -1 : 1; }

// A motion in progress; reached: a step may come to h = g = 0.
typedef struct {
  state_t x;
  unsigned mode;
  tf_force_t force;
  bool reached;
} motion_t;

// The modes of a step, the one that the rule takes, its force and its end.
static tf_status_t whole_step(const castor_t *q, const tf_contact_t *contact,
                              double dt, motion_t *at) {
  const span_t s = span_of(q, dt, &at->x);
  tf_contact_modes_t modes;
  tf_status_t status = tf_contact_modes(contact, &s.h, &s.g,
                                        slip_at(q, at->x.psi, at->x.u, at->x.w),
                                        at->mode, &modes, &at->reached);
  if (status < TF_OK) return status;
  at->mode = tf_contact_choose(contact, &modes, at->mode, 0, 0);
  status = tf_contact_force(contact, &s.h, &s.g, &modes, at->mode,
                            middle(q, contact, &s, &at->x, side_of(at->mode)),
                            &at->force);
  if (status == TF_OK) at->x = end_of(q, &s, &at->x, at->force);
  return status;
}

// A step in which slip changes its sign, once more in two parts that meet where
// it does: with one force all along, order 1 is left of 2.
static tf_status_t step(const castor_t *q, const tf_contact_t *contact,
                        double dt, bool split, motion_t *at) {
  const motion_t was = *at;
  const tf_status_t status = whole_step(q, contact, dt, at);
  if (status != TF_OK || !split || at->mode == was.mode ||
      !tf_mode_is_slip(was.mode) || !tf_mode_is_slip(at->mode))
    return status;
  const double side = side_of(was.mode);
  span_t s = span_of(q, dt, &was.x);
  tf_slip_t slip = middle(q, contact, &s, &was.x, side);
  tf_force_t f = tf_tyre_force(&contact->tyre, side, slip.h, slip.g);
  const double now = slip_at(q, was.x.psi, was.x.u, was.x.w).h;
  const double end = value_of(&s.h, f.F / q->mu, f.M / (q->mu * q->kappa));
  if (!(side * end < 0)) return status;
  const double share = now / (now - end);
  s = span_of(q, share * dt, &was.x);
  slip = middle(q, contact, &s, &was.x, side);
  f = tf_tyre_force(&contact->tyre, side, slip.h, slip.g);
  at->x = end_of(q, &s, &was.x, f);
  return whole_step(q, contact, (1 - share) * dt, at);
}

static void row(const castor_t *q, double t, const motion_t *at) {
  const state_t *x = &at->x;
  const tf_slip_t now = slip_at(q, x->psi, x->u, x->w);
  printf("%.10g,%.17g,%.17g,%.17g,%.17g,%.9g,%.9g,%.9g,%s\n", t, x->y, x->psi,
         x->u, x->w, now.h, now.g, at->force.F, tf_mode_name(at->mode));
}

static int run(const castor_t *q) {
  tf_contact_t persist, leaving;
  const tf_rule_t rule = q->side > 0 ? TF_RULE_SLIP_PLUS : TF_RULE_SLIP_MINUS;
  if (tf_contact_prepare(&persist, TF_TYRE_JUMP, q->mu, q->kappa, TF_REST_HULL,
                         TF_RULE_PERSIST, 0) != TF_OK ||
      tf_contact_prepare(&leaving, TF_TYRE_JUMP, q->mu, q->kappa, TF_REST_HULL,
                         rule, 0) != TF_OK) {
    fputs("trolley: mu or kappa is out of range\n", stderr);
    return 2;
  }
  motion_t at = {.x = {q->y, q->psi, q->u, 0}};
  at.x.w = (slip_at(q, q->psi, q->u, 0).h - q->h) / q->e;
  at.mode = q->h > 0                                 ? TF_SLIP_PLUS
            : q->h < 0                               ? TF_SLIP_MINUS
            : slip_at(q, q->psi, q->u, at.x.w).g > 0 ? TF_STICK_PLUS
                                                     : TF_STICK_MINUS;
  const long steps = lround(q->until / q->dt), every = lround(q->every);
  puts("t,y,psi,u,w,h,g,F,mode");
  row(q, 0, &at);
  for (long n = 1; n <= steps; n++) {
    const motion_t was = at;
    const double t = (double)n * q->dt;
    const bool leaves = t > q->leave + q->dt / 2;
    const tf_status_t status =
        step(q, leaves ? &leaving : &persist, q->dt, q->split != 0, &at);
    if (status != TF_OK || at.reached) {
      fprintf(stderr, "trolley: t = %g s: %s\n", t,
              at.reached ? "h = g = 0 is near" : tf_status_name(status));
      row(q, t - q->dt, &was);
      return at.reached ? 0 : 1;
    }
    if (at.mode != was.mode) row(q, t - q->dt, &was);
    if (at.mode != was.mode || n % every == 0 || n == steps) row(q, t, &at);
  }
  return 0;
}

static bool set_option(castor_t *q, const char *word) {
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    const size_t length = strlen(names[n]);
    if (strncmp(word, names[n], length) != 0 || word[length] != '=') continue;
    char *end;
    const double value = strtod(word + length + 1, &end);
    memcpy((char *)q + n * sizeof value, &value, sizeof value);
    return *end == 0 && end != word + length + 1 && isfinite(value);
  }
  return false;
}

int main(int argc, char **argv) {
  castor_t given = {OPTIONS(AS_DEFAULT)};
  for (int n = 1; n < argc; n++)
    if (!set_option(&given, argv[n])) {
      fprintf(stderr, "trolley: %s: not NAME=VALUE with a number\n", argv[n]);
      return 2;
    }
  if (!(given.dt > 0 && given.every >= 1 && given.e != 0 && given.mu > 0 &&
        given.m > 0 && given.J > 0 && given.until >= 0 &&
        given.until <= 1e9 * given.dt)) {
    fputs(
        "trolley: dt, m, J, mu > 0, every >= 1, until from 0 to 1e9 dt, and "
        "a trail that is not 0\n",
        stderr);
    return 2;
  }
  return run(&given);
}
