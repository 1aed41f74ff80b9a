/// @file
/// What a step is told; see told.h.
#include "told.h"

#include <math.h>

// Piece i lies before knot i.
static told_t on_piece(const lib_machine_t *q, int i, double t) {
  const lib_knot_t *a = &q->knot[i > 0 ? i - 1 : 0];
  const lib_knot_t *b = &q->knot[i < q->knots ? i : q->knots - 1];
  const double length = b->t - a->t;
  const double share = length > 0 ? (t - a->t) / length : 0;
  return (told_t){a->omega0 + share * (b->omega0 - a->omega0),
                  length > 0 ? (b->omega0 - a->omega0) / length : 0,
                  a->force + share * (b->force - a->force),
                  a->torque + share * (b->torque - a->torque)};
}

told_t moving_told(const lib_machine_t *q, double from, double to) {
  const double span = to - from, near = 1e-9 * span;
  told_t sum = {0, 0, 0, 0};
  double t = from;
  for (int i = 0; i <= q->knots; ++i) {
    const bool last = i == q->knots || q->knot[i].t >= to - near;
    const double end = last ? to : q->knot[i].t;
    if (i < q->knots && q->knot[i].t <= t + near) {
      continue; // passed, or a jump
    }
    const told_t mean = on_piece(q, i, t + (end - t) / 2);
    const double share = span > 0 ? (end - t) / span : 1;
    sum.alpha += share * mean.alpha;
    sum.force += share * mean.force;
    sum.torque += share * mean.torque;
    t = end;
    if (last) {
      sum.omega0 = on_piece(q, i, to).omega0;
      break;
    }
  }
  if (q->swing != 0) {
    const double half = q->swing_rate * span / 2;
    const double slope =
        q->swing * q->swing_rate * (span > 0 ? sin(half) / half : 1);
    sum.omega0 += q->swing * sin(q->swing_rate * to);
    sum.alpha += slope * cos(q->swing_rate * (from + to) / 2);
  }
  return sum;
}

int moving_table(const lib_machine_t *q, long steps, ref_knot_t *table,
                 int most) {
  told_t before = {0, 0, 0, 0};
  int count = 0;
  for (long n = 0; n < steps; ++n) {
    const double from = (double)n * q->dt, to = (double)(n + 1) * q->dt;
    const told_t u = moving_told(q, from, to);
    ref_real_t start = (ref_real_t)u.omega0 - (ref_real_t)u.alpha * q->dt;
    bool goes_on = false;
    if (count > 0) {
      const ref_real_t end = table[count - 1].omega0;
      if (fabsl(start - end) <= 1e-12L * (1 + fabsl(end))) {
        start = end;
        goes_on = u.alpha == before.alpha && u.force == before.force &&
                  u.torque == before.torque;
      }
    }
    if (!goes_on) {
      if (count + 2 > most) {
        return 0;
      }
      table[count++] = (ref_knot_t){from, start, u.force, u.torque};
      ++count;
    }
    table[count - 1] =
        (ref_knot_t){to, (ref_real_t)u.omega0, u.force, u.torque};
    before = u;
  }
  return count;
}
