// See leg.h.
#include "leg.h"

// Polar coordinates are taken up below the first radius and left above the
// second [m/s].
static const double near_radius = 0.04, far_radius = 0.05;
// J A at which the straight line into a two-fold starts [m^2].
static const double near_twofold = 1e-17;

static int has_angle(const machine_t *p) {
  return p->law == JUMP || p->law == STRING;
}

int leg_is_near(const machine_t *p, real r, real h, real g) {
  const real radius = (real)near_radius;
  return has_angle(p) && r * r > (real)1e-4 && h * h + g * g < radius * radius;
}

static void polar_rates(const leg_t *leg, const real y[DIM], real dy[DIM]) {
  const real radius = expq(y[2]), s = sinq(y[1]), c = cosq(y[1]);
  const motion_t x = motion_of(leg->p, y[0], radius * s, radius * c, y[AT_T]);
  // The law depends on the angle alone.
  const force_t f = force_of(leg->p, &leg->piece, s, c);
  const rates_t d = rates_of(leg->p, &leg->ramp, &x, f);
  dy[0] = radius * d.v;
  dy[1] = d.dh * c - d.dg * s;
  dy[2] = d.dg * c + d.dh * s;
  dy[AT_T] = radius;
}

static stick_t stick_at(const leg_t *leg, const real y[DIM]) {
  const motion_t x = motion_of(leg->p, y[0], 0, y[1], y[AT_T]);
  return stick_of(leg->p, &leg->ramp, &x, leg->piece.roll);
}

// (slidRescale): x' = |A| f(x, 0) + sign(A) N f_lambda, J times
static void stick_rates(const leg_t *leg, const real y[DIM], real dy[DIM]) {
  const stick_t s = stick_at(leg, y);
  const real pace = leg->piece.side * s.JA;
  dy[0] = pace * s.free.v;
  dy[1] = pace * s.free.dg + leg->piece.side * s.JN * s.g_lambda;
  dy[2] = 0;
  dy[AT_T] = pace;
}

void leg_rates(const leg_t *leg, const real y[DIM], real dy[DIM]) {
  if (leg->kind == POLAR) {
    polar_rates(leg, y, dy);
  } else if (leg->kind == STICK) {
    stick_rates(leg, y, dy);
  } else if (leg->kind == SLIP) {
    const motion_t x = {y[0], y[1], y[2], y[AT_T]};
    real h, g;
    slip_of(leg->p, &x, &h, &g);
    const rates_t d =
        rates_of(leg->p, &leg->ramp, &x, force_of(leg->p, &leg->piece, h, g));
    dy[0] = d.v;
    dy[1] = d.dp;
    dy[2] = d.dz;
    dy[AT_T] = 1;
  } else {
    dy[0] = dy[1] = dy[2] = 0;
    dy[AT_T] = 1;
  }
}

// h and g, in units of the radius where that is the coordinate.
static int slip_guards(const leg_t *leg, real h, real g,
                       guard_t guard[GUARDS]) {
  const machine_t *p = leg->p;
  const real H = leg->piece.side * h, G = leg->piece.roll * g;
  const real no_slip = p->delta * G - p->k * (2 * p->a + p->sigma) * H;
  const real some = p->delta * G - p->k * p->sigma * H;
  int n = 0;
  guard[n++] = (guard_t){END_H, H};
  if (p->law == NONE || p->law == COULOMB) return n;
  guard[n++] = (guard_t){END_G, G};
  if (p->law != STRING) return n;
  if (leg->piece.zone == 0) guard[n++] = (guard_t){END_ZONE, no_slip};
  if (leg->piece.zone == 1) {
    guard[n++] = (guard_t){END_ZONE, -no_slip};
    guard[n++] = (guard_t){END_ZONE, some};
  }
  if (leg->piece.zone == 2) guard[n++] = (guard_t){END_ZONE, -some};
  return n;
}

static int stick_guards(const leg_t *leg, const real y[DIM],
                        guard_t guard[GUARDS]) {
  const stick_t s = stick_at(leg, y);
  const real reach = s.JA * leg->p->mu;
  const int sign = leg->piece.side;
  guard[0] = (guard_t){END_PLUS, sign * (reach - s.JN)};
  guard[1] = (guard_t){END_MINUS, sign * (reach + s.JN)};
  guard[2] = (guard_t){END_G, leg->piece.roll * y[1]};
  guard[3] = (guard_t){END_TWOFOLD, sign * s.JA - (real)near_twofold};
  return leg->p->law == JUMP ? 4 : 3;
}

int leg_guards(const leg_t *leg, const real y[DIM], guard_t guard[GUARDS]) {
  const real far = (real)far_radius;
  int n = 0;
  if (leg->kind == STICK) return stick_guards(leg, y, guard);
  if (leg->kind == PINNED) return 0;
  if (leg->kind == POLAR) {
    n = slip_guards(leg, sinq(y[1]), cosq(y[1]), guard);
    guard[n++] = (guard_t){END_FALL, y[2] - LN_TINY};
    guard[n++] = (guard_t){END_CHART, logq(far) - y[2]};
    return n;
  }
  const motion_t x = {y[0], y[1], y[2], y[AT_T]};
  real h, g;
  slip_of(leg->p, &x, &h, &g);
  n = slip_guards(leg, h, g, guard);
  if (has_angle(leg->p))
    guard[n++] = (guard_t){END_CHART, leg_is_near(leg->p, y[0], h, g) ? -1 : 1};
  return n;
}

real leg_longest(const leg_t *leg, const real y[DIM]) {
  const real second = (real)1 / 32;
  if (leg->kind == SLIP || leg->kind == PINNED) return second;
  if (leg->kind == POLAR) return lesser(16, second / expq(y[2]));
  const real pace = leg->piece.side * stick_at(leg, y).JA;
  return lesser(4, second / bigger(pace, second / 100));
}

void leg_start(const leg_t *leg, const motion_t *x, real h, real g,
               real y[DIM]) {
  const int side = leg->piece.side;
  y[0] = x->r;
  y[1] = y[2] = 0;
  y[AT_T] = x->t;
  if (leg->kind == SLIP) {
    y[1] = x->p;
    y[2] = x->z;
  } else if (leg->kind == POLAR) {
    y[1] = side * atan2q(bigger(side * h, 0), g);
    y[2] = logq(h * h + g * g) / 2;
  } else if (leg->kind == STICK) {
    y[1] = g;
  }
}

motion_t leg_motion(const leg_t *leg, const real y[DIM], real *h, real *g) {
  *h = *g = 0;
  if (leg->kind == SLIP) {
    const motion_t x = {y[0], y[1], y[2], y[AT_T]};
    slip_of(leg->p, &x, h, g);
    return x;
  }
  if (leg->kind == PINNED) return (motion_t){y[0], 0, 0, y[AT_T]};
  if (leg->kind == POLAR) {
    const real radius = expq(y[2]);
    *h = radius * sinq(y[1]);
    *g = radius * cosq(y[1]);
  } else {
    *g = y[1];
  }
  return motion_of(leg->p, y[0], *h, *g, y[AT_T]);
}
