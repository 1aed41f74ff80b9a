/* orbit.c - the reference orbit of orbit.h. The solver is Gragg's midpoint
 * rule with Bulirsch-Stoer extrapolation at a fixed depth: it needs no table
 * of coefficients, so it is as accurate as long double is wide, and an event
 * is located by taking the last step again with a smaller length, which costs
 * no accuracy as dense output would. Each leg of the orbit is one smooth
 * field: signs of h and g are frozen while a step may overshoot an event. */
#include "orbit.h"

#include <float.h>
#include <math.h>

enum { DIM = 4, DEPTH = 8, STEPS = 3000 };

/* What is integrated. In slip y = (r, angle, ln radius, t) in the
 * logarithmic time dt = radius dsigma; in stick y = (r, g, unused, t) on
 * h = 0 in the time dt = m (beta^2 + r^2) A(r, s) dsigma. */
typedef struct {
  const paper_t *p;
  int stuck; /* nonzero on h = 0 */
  int side;  /* sign(h) in slip */
  int roll;  /* sign(g) */
} leg_t;

/* The leg ends where way * (y[index] - value) rises through zero. */
typedef struct {
  int index;
  long double way, value;
} stop_t;

/* Below exp(-46) = 1e-20 the rest of the way is one straight line. */
static const long double log_tiny = -46.0L;
/* Distance in r at which the straight line into the two-fold starts [m]. */
static const long double near_twofold = 3e-9L;

static long double dot(const long double a[3], const long double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* (force), (moment) at a direction: arctan|h/g| is linear in the angle in
 * each quadrant, and stays so past the quadrant's edge (a frozen field). */
static void friction_at(const leg_t *leg, long double angle, long double *F,
                        long double *M) {
  const paper_t *p = leg->p;
  const long double side = (long double)leg->side;
  const long double roll = (long double)leg->roll;
  const long double edge = atanl(1.0L / (6.0L * p->kappa));
  const long double slip =
      side * roll * angle + (leg->roll < 0 ? PAPER_PI : 0.0L);
  const long double psi = edge + fabsl(1.0L - 2.0L / PAPER_PI * edge) * slip;
  const long double cot_psi = cosl(psi) / sinl(psi);
  *F = side * p->mu * (4.0L / 3.0L - cot_psi / (18.0L * p->kappa));
  *M = roll * side * p->mu / 6.0L * cot_psi;
}

/* g = R cos(angle), h = R sin(angle):
 *   R' = g' cos + h' sin,   R angle' = h' cos - g' sin */
static void slip_rates(const leg_t *leg, long double r, long double radius,
                       long double angle, long double *v, long double *rotation,
                       long double *growth) {
  const long double c = cosl(angle), s = sinl(angle);
  long double x[3], dx[3], h_x[3], g_x[3], F, M;
  paper_from_slip(leg->p, r, radius * s, radius * c, x);
  friction_at(leg, angle, &F, &M);
  paper_rhs_time(leg->p, x, F, M, dx);
  paper_h_x(leg->p, x, h_x);
  paper_g_x(leg->p, x, g_x);
  *v = x[1];
  *rotation = dot(h_x, dx) * c - dot(g_x, dx) * s;
  *growth = dot(g_x, dx) * c + dot(h_x, dx) * s;
}

/* (slidRescale), reversed in sign so that time runs forward where A > 0:
 *   x' = A f(x, 0) + (h_x . f(x, 0)) f_lambda,   A = -h_x . f_lambda */
static void stick_rates(const leg_t *leg, const long double y[DIM],
                        long double dy[DIM]) {
  const paper_t *p = leg->p;
  const long double b2 = p->beta * p->beta;
  const long double rate = p->m * (b2 + y[0] * y[0]);
  const long double A = rate * paper_delassus(p, y[0], leg->roll);
  long double x[3], f0[3], f1[3], dx[3], g_x[3], push;
  paper_from_slip(p, y[0], 0.0L, y[1], x);
  paper_f(p, x, 0.0L, leg->roll, f0);
  paper_f(p, x, 1.0L, leg->roll, f1);
  push = paper_lie(p, x, 0.0L, leg->roll);
  for (int i = 0; i < 3; i++) dx[i] = A * f0[i] + push * (f1[i] - f0[i]);
  paper_g_x(p, x, g_x);
  dy[0] = dx[0];
  dy[1] = dot(g_x, dx);
  dy[2] = 0.0L;
  dy[3] = rate * A;
}

static void rates(const leg_t *leg, const long double y[DIM],
                  long double dy[DIM]) {
  if (leg->stuck) {
    stick_rates(leg, y, dy);
  } else {
    const long double radius = expl(y[2]);
    long double v;
    slip_rates(leg, y[0], radius, y[1], &v, &dy[1], &dy[2]);
    dy[0] = radius * v;
    dy[3] = radius;
  }
}

/* Gragg's midpoint rule: n even steps over the length. */
static void midpoint(const leg_t *leg, const long double y[DIM],
                     long double length, int n, long double end[DIM]) {
  const long double step = length / (long double)n;
  long double before[DIM], now[DIM], dy[DIM];
  rates(leg, y, dy);
  for (int i = 0; i < DIM; i++) {
    before[i] = y[i];
    now[i] = y[i] + step * dy[i];
  }
  for (int j = 1; j < n; j++) {
    rates(leg, now, dy);
    for (int i = 0; i < DIM; i++) {
      const long double next = before[i] + 2.0L * step * dy[i];
      before[i] = now[i];
      now[i] = next;
    }
  }
  for (int i = 0; i < DIM; i++) end[i] = now[i];
}

/* Bulirsch and Stoer: extrapolation in (length / n)^2, n = 2, 4 ... 2 DEPTH.
 * Returns the difference of the last two columns. */
static long double extrapolate(const leg_t *leg, const long double y[DIM],
                               long double length, long double end[DIM]) {
  long double row[DEPTH][DIM], error = 0.0L;
  for (int j = 0; j < DEPTH; j++) {
    midpoint(leg, y, length, 2 * (j + 1), row[j]);
    for (int k = j - 1; k >= 0; k--) {
      const long double ratio = (long double)(j + 1) / (long double)(k + 1);
      const long double scale = ratio * ratio - 1.0L;
      for (int i = 0; i < DIM; i++) {
        const long double gain = (row[k + 1][i] - row[k][i]) / scale;
        row[k][i] = row[k + 1][i] + gain;
        if (j == DEPTH - 1 && k == 0)
          error = fmaxl(error, fabsl(gain) / (1.0L + fabsl(y[i])));
      }
    }
  }
  for (int i = 0; i < DIM; i++) end[i] = row[0][i];
  return error;
}

static long double distance(const stop_t *stop, const long double y[DIM]) {
  return stop->way * (y[stop->index] - stop->value);
}

/* The length in (0, whole] at which the stop is met: regula falsi (Illinois),
 * each trial a fresh step from y. */
static long double locate(const leg_t *leg, const stop_t *stop,
                          const long double y[DIM], long double whole,
                          long double end[DIM]) {
  long double lo = 0.0L, hi = whole, f_lo = distance(stop, y), f_hi;
  int kept = 0;
  extrapolate(leg, y, hi, end);
  f_hi = distance(stop, end);
  for (int i = 0; i < 80 && hi - lo > 2.0L * LDBL_EPSILON * hi; i++) {
    const long double mid = (f_hi * lo - f_lo * hi) / (f_hi - f_lo);
    long double f;
    extrapolate(leg, y, mid, end);
    f = distance(stop, end);
    if (fabsl(f) <= LDBL_EPSILON) return mid;
    if (f < 0.0L) {
      lo = mid;
      f_lo = f;
      if (kept == 1) f_hi *= 0.5L;
      kept = 1;
    } else {
      hi = mid;
      f_hi = f;
      if (kept == -1) f_lo *= 0.5L;
      kept = -1;
    }
  }
  extrapolate(leg, y, hi, end);
  return hi;
}

static int fires(const stop_t *stop, const long double y[DIM],
                 const long double end[DIM]) {
  return distance(stop, y) < 0.0L && distance(stop, end) >= 0.0L;
}

/* Follows a leg to the first of two stops; returns which, or -1. `peak`
 * becomes the largest |lambda| met in stick. */
static int follow(const leg_t *leg, long double y[DIM], const stop_t stop[2],
                  long double *peak) {
  const long double allowed = 1e-16L;
  long double length = 1e-4L;
  for (int n = 0; n < STEPS; n++) {
    long double end[DIM], x[3];
    const long double error = extrapolate(leg, y, length, end) / allowed;
    const long double fit = 0.8L * powl(error + 1e-12L, -1.0L / 15.0L);
    int which = -1;
    if (!(error <= 1.0L)) {
      length *= fit > 0.2L ? fit : 0.2L; /* 0.2 for NaN as well */
      continue;
    }
    for (int k = 0; k < 2; k++) {
      if (!fires(&stop[k], y, end)) continue;
      length = locate(leg, &stop[k], y, length, end);
      which = k;
    }
    for (int i = 0; i < DIM; i++) y[i] = end[i];
    if (leg->stuck && peak) {
      paper_from_slip(leg->p, y[0], 0.0L, y[1], x);
      *peak = fmaxl(*peak, fabsl(paper_lambda(leg->p, x, leg->roll)));
    }
    if (which >= 0) return which;
    length *= fminl(fit, 2.0L);
  }
  return -1;
}

/* The rate of the angle at radius zero: 0 at a limit direction. */
static long double rotation_at(const leg_t *leg, long double r,
                               long double angle, long double *growth) {
  long double v, rotation;
  slip_rates(leg, r, 0.0L, angle, &v, &rotation, growth);
  return rotation;
}

int orbit_limit_directions(const paper_t *p, long double r, int room,
                           orbit_direction_t *found) {
  enum { CELLS = 2000 };
  const long double cell = 0.5L * PAPER_PI / (long double)CELLS;
  int count = 0;
  for (int i = -2 * CELLS; i < 2 * CELLS; i++) {
    const int outer = i < -CELLS || i >= CELLS;
    const leg_t leg = {p, 0, i < 0 ? -1 : 1, outer ? -1 : 1};
    long double lo = cell * (long double)i, hi = lo + cell, growth;
    const int rising = rotation_at(&leg, r, lo, &growth) < 0.0L;
    if (rising == (rotation_at(&leg, r, hi, &growth) < 0.0L)) continue;
    for (int j = 0; j < 70; j++) {
      const long double mid = 0.5L * (lo + hi);
      if ((rotation_at(&leg, r, mid, &growth) < 0.0L) == rising)
        lo = mid;
      else
        hi = mid;
    }
    if (count < room) {
      const long double d = 1e-5L;
      found[count].pull = (rotation_at(&leg, r, lo + d, &growth) -
                           rotation_at(&leg, r, lo - d, &growth)) /
                          (2.0L * d);
      rotation_at(&leg, r, lo, &growth);
      found[count].angle = lo;
      found[count].speed = growth;
    }
    count++;
  }
  return count;
}

static void mark(const leg_t *leg, const long double y[DIM],
                 orbit_point_t *point) {
  const long double radius = leg->stuck ? 0.0L : expl(y[2]);
  const long double h = leg->stuck ? 0.0L : radius * sinl(y[1]);
  const long double g = leg->stuck ? y[1] : radius * cosl(y[1]);
  paper_from_slip(leg->p, y[0], h, g, point->x);
  point->t = y[3];
}

/* slip+ from the start into h = g = 0; the angle stays inside the quadrant
 * g > 0, h > 0. Nonzero if `until` came first. */
static int fall(const paper_t *p, stop_t until, long double y[DIM],
                orbit_events_t *ev, orbit_point_t *last) {
  leg_t leg = {p, 0, 1, 1};
  const stop_t tiny[2] = {{2, -1.0L, log_tiny}, until};
  long double x[3] = {ORBIT_R_START, 0.0L, ORBIT_W_START}, g;
  long double v, rotation, growth;
  x[1] = paper_v_at(p, x[0], x[2], ORBIT_H_START);
  g = paper_g(p, x);
  y[0] = x[0];
  y[1] = atan2l(ORBIT_H_START, g);
  y[2] = logl(hypotl(ORBIT_H_START, g));
  y[3] = 0.0L;
  if (follow(&leg, y, tiny, 0) != 0) return mark(&leg, y, last), 1;
  slip_rates(&leg, y[0], 0.0L, y[1], &v, &rotation, &growth);
  y[3] -= expl(y[2]) / growth;
  ev->fall_angle = y[1];
  y[1] = y[2] = 0.0L;
  leg.stuck = 1;
  mark(&leg, y, &ev->fall);
  return 0;
}

/* stick- from h = g = 0 back to g = 0, then slip- to the surface. */
static int cross(const paper_t *p, stop_t until, long double y[DIM],
                 orbit_events_t *ev, orbit_point_t *last) {
  const leg_t stick = {p, 1, 0, -1}, slip = {p, 0, -1, 1};
  const stop_t crossing[2] = {{1, 1.0L, 0.0L}, until};
  const stop_t landed[2] = {{1, 1.0L, 0.0L}, until};
  orbit_direction_t way[16];
  int n, out = -1;
  ev->stick_lambda = 0.0L;
  if (follow(&stick, y, crossing, &ev->stick_lambda) != 0)
    return mark(&stick, y, last), 1;
  y[1] = 0.0L;
  mark(&stick, y, &ev->leave);
  n = orbit_limit_directions(p, y[0], 16, way);
  for (int i = 0; i < n && i < 16; i++)
    if (way[i].speed > 0.0L && way[i].pull < 0.0L) out = i;
  if (out < 0) return mark(&stick, y, last), 1;
  ev->leave_angle = way[out].angle;
  y[1] = way[out].angle;
  y[2] = log_tiny;
  y[3] += expl(log_tiny) / way[out].speed;
  if (follow(&slip, y, landed, 0) != 0) return mark(&slip, y, last), 1;
  y[1] = expl(y[2]);
  y[2] = 0.0L;
  paper_from_slip(p, y[0], 0.0L, y[1], ev->land.x);
  ev->land.t = y[3];
  return 0;
}

/* stick+ in the lower sliding region, into the two-fold. */
static void arrive(const paper_t *p, stop_t until, long double y[DIM],
                   orbit_events_t *ev, orbit_point_t *last) {
  const leg_t leg = {p, 1, 0, 1};
  const stop_t close[2] = {{0, -1.0L, PAPER_R_STAR + near_twofold}, until};
  const int which = follow(&leg, y, close, 0);
  long double dx[3];
  mark(&leg, y, last);
  if (which != 0) return;
  paper_stick(p, last->x, 1, dx);
  ev->twofold_slope = dx[2] / dx[0];
  ev->twofold_lambda = paper_lambda(p, last->x, 1);
  ev->twofold.t = y[3] - near_twofold / dx[0];
  for (int i = 0; i < 3; i++)
    ev->twofold.x[i] = last->x[i] - near_twofold * dx[i] / dx[0];
}

static void chaos(long double t, orbit_events_t *ev, orbit_point_t *last) {
  const stop_t until = {3, 1.0L, t};
  long double y[DIM];
  paper_t p;
  *ev = (orbit_events_t){.leave_angle = 0.0L}; /* and all else */
  *last = ev->fall;
  paper_default(&p);
  if (fall(&p, until, y, ev, last)) return;
  if (cross(&p, until, y, ev, last)) return;
  arrive(&p, until, y, ev, last);
}

void orbit_chaos(orbit_events_t *ev) {
  orbit_point_t last;
  chaos(HUGE_VALL, ev, &last);
}

void orbit_chaos_state(long double t, long double x[3]) {
  orbit_events_t ev;
  orbit_point_t last;
  if (t <= 0.0L) {
    paper_t p;
    paper_default(&p);
    x[0] = ORBIT_R_START;
    x[2] = ORBIT_W_START;
    x[1] = paper_v_at(&p, x[0], x[2], ORBIT_H_START);
    return;
  }
  chaos(t, &ev, &last);
  for (int i = 0; i < 3; i++) x[i] = last.x[i];
}
