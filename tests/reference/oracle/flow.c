// See flow.h.
#include "flow.h"

#include <stdio.h>
#include <stdlib.h>

enum { COLUMNS = 14 };

// Gragg's midpoint rule: n even steps over the length.
static void midpoint(const leg_t *leg, const real y[DIM], const real slope[DIM],
                     real length, int n, real end[DIM]) {
  const real step = length / n;
  real before[DIM], dy[DIM];
  for (int i = 0; i < DIM; i++) {
    before[i] = y[i];
    end[i] = y[i] + step * slope[i];
  }
  for (int j = 1; j < n; j++) {
    leg_rates(leg, end, dy);
    for (int i = 0; i < DIM; i++) {
      const real next = before[i] + 2 * step * dy[i];
      before[i] = end[i];
      end[i] = next;
    }
  }
}

real step_extrapolated(const leg_t *leg, const real y[DIM], real length,
                       real end[DIM]) {
  real row[COLUMNS][DIM], slope[DIM], error = 0;
  leg_rates(leg, y, slope);
  for (int j = 0; j < COLUMNS; j++) {
    midpoint(leg, y, slope, length, 2 * (j + 1), row[j]);
    for (int k = j - 1; k >= 0; k--) {
      const real ratio = (real)(j + 1) / (k + 1);
      for (int i = 0; i < DIM; i++) {
        const real gain = (row[k + 1][i] - row[k][i]) / (ratio * ratio - 1);
        row[k][i] = row[k + 1][i] + gain;
        if (j == COLUMNS - 1 && k == 0)
          error = bigger(error, fabsq(gain) / (1 + fabsq(y[i])));
      }
    }
  }
  for (int i = 0; i < DIM; i++) end[i] = row[0][i];
  return error;
}

// What a step ends at, with the guards there.
typedef struct {
  real y[DIM];
  guard_t guard[GUARDS + 1];
  int guards;
} point_t;

static void look(const leg_t *leg, real until, point_t *at) {
  at->guards = leg_guards(leg, at->y, at->guard);
  at->guard[at->guards++] = (guard_t){END_TIME, until - at->y[AT_T]};
}

// The length in (0, whole] at which guard `which` is 0: regula falsi
// (Illinois), each trial a fresh step from the start.
static real locate(const method_t *method, const leg_t *leg, real until,
                   const point_t *start, int which, real whole, point_t *end) {
  const real fine = (real)1e-34;
  real lo = 0, hi = whole;
  real f_lo = start->guard[which].value, f_hi = end->guard[which].value;
  int kept = 0;
  for (int i = 0; i < 200 && hi - lo > fine * hi; i++) {
    const real mid = (f_hi * lo - f_lo * hi) / (f_hi - f_lo);
    method->step(leg, start->y, mid, end->y);
    look(leg, until, end);
    const real f = end->guard[which].value;
    if (fabsq(f) <= fine || mid <= lo || mid >= hi) return mid;
    if (f > 0) {
      lo = mid;
      f_lo = f;
      if (kept == 1) f_hi /= 2;
      kept = 1;
    } else {
      hi = mid;
      f_hi = f;
      if (kept == -1) f_lo /= 2;
      kept = -1;
    }
  }
  return hi;
}

static void give_up(const char *why, const leg_t *leg, const real y[DIM]) {
  fprintf(stderr, "oracle: %s: leg %d at t = %.12g, y = %.9g %.9g %.9g\n", why,
          (int)leg->kind, (double)y[AT_T], (double)y[0], (double)y[1],
          (double)y[2]);
  exit(1);
}

// The guard that falls first in a step, with the point there; -1 for none, -2
// for one that was not positive at all.
static int first_to_fall(const method_t *method, const leg_t *leg, real until,
                         const point_t *start, real length, point_t *end) {
  const point_t whole = *end;
  real least = 2 * length;
  int first = -1;
  for (int k = 0; k < whole.guards; k++) {
    const end_t kind = whole.guard[k].end;
    if (!(whole.guard[k].value <= 0)) continue;
    if (!(start->guard[k].value > 0)) return -2;
    point_t there = whole;
    const real at = kind == END_CHART
                        ? length
                        : locate(method, leg, until, start, k, length, &there);
    if (at >= least) continue;
    least = at;
    first = k;
    *end = there;
  }
  return first;
}

end_t follow(const method_t *method, const leg_t *leg, real y[DIM],
             real until) {
  real length = (real)1e-3;
  point_t now;
  for (int i = 0; i < DIM; i++) now.y[i] = y[i];
  look(leg, until, &now);
  for (;;) {
    point_t end;
    length = lesser(length, leg_longest(leg, now.y));
    const real error =
        method->step(leg, now.y, length, end.y) / method->allowed;
    real fit = (real)0.2; // for NaN as well
    if (error >= 0)
      fit = (real)0.85 * powq(error + (real)1e-9, (real)-1 / method->order);
    if (!(error <= 1)) {
      length *= lesser(bigger(fit, (real)0.2), (real)0.9);
      if (length < (real)1e-24) give_up("the step vanishes", leg, now.y);
      continue;
    }
    look(leg, until, &end);
    const int which = first_to_fall(method, leg, until, &now, length, &end);
    if (which == -2) {
      length /= 16;
      if (length < (real)1e-24) give_up("a guard is violated", leg, now.y);
      continue;
    }
    now = end;
    if (which >= 0) {
      for (int i = 0; i < DIM; i++) y[i] = now.y[i];
      return now.guard[which].end;
    }
    length *= lesser(fit, 2);
  }
}
