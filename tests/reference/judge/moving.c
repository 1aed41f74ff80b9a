/// Inputs that move: how they are drawn, and what a step gets of them.
#include <math.h>

#include "judge.h"

static const double pi = 3.14159265358979323846;

static void add(lib_machine_t *q, double t, double omega0) {
  if (q->knots < LIB_KNOTS)
    q->knot[q->knots++] = (lib_knot_t){.t = t, .omega0 = (float)omega0};
}

// A jump or several, and what is between them: held, or ramps.
static void add_jumps(draw_t *draw, lib_machine_t *q, double time, double size,
                      bool ramps) {
  const double most = draw_uniform(draw, 1, ramps ? 4 : 8);
  const int jumps = (int)most;
  double omega0 = q->omega0;
  for (int i = 1; i <= jumps; ++i) {
    const double t = time * (i - draw_uniform(draw, 0, 1)) / jumps;
    add(q, t, omega0 += ramps ? size * draw_uniform(draw, -1, 1) : 0);
    add(q, t, omega0 += size * draw_uniform(draw, -1, 1));
  }
}

// Up and down, starting in the middle.
static void add_triangle(lib_machine_t *q, double period, double size) {
  for (int i = 1; i < LIB_KNOTS; ++i)
    add(q, period * (2 * i - 1) / 4, q->omega0 + (i % 2 ? size : -size));
}

static void add_kinks(draw_t *draw, lib_machine_t *q, double time,
                      double size) {
  double t = 0;
  for (int i = 1; i < LIB_KNOTS && t < time; ++i) {
    t += time * draw_log(draw, 1e-4, 0.5);
    add(q, t, q->omega0 + size * draw_uniform(draw, -1, 1));
  }
}

static void draw_shape(draw_t *draw, lib_machine_t *q, moving_shape_t shape,
                       double time) {
  const double size =
      -draw_sign(draw) * fabs(q->omega0) * draw_log(draw, 0.02, 3);
  const double late = time * draw_uniform(draw, 1, 2);
  add(q, 0, q->omega0);
  switch (shape) {
    case MOVING_TRIANGLE:
      add_triangle(q, draw_log(draw, time / 7, time), size);
      break;
    case MOVING_SINE:
      q->swing = (float)size;
      q->swing_rate = (float)(2 * pi / draw_log(draw, time / 20, 2 * time));
      break;
    case MOVING_HELD_STEPS:
    case MOVING_JUMPS:
      add_jumps(draw, q, time, size, shape == MOVING_JUMPS);
      break;
    case MOVING_THROUGH_ZERO:
      add(q, time * draw_uniform(draw, 0.5, 1.5),
          -q->omega0 * draw_uniform(draw, 0.2, 1.5));
      break;
    case MOVING_HOLD_THEN_RAMP:
      add(q, time * draw_uniform(draw, 0, 0.8), q->omega0);
      add(q, late, q->omega0 + size);
      break;
    case MOVING_KINKS:
      add_kinks(draw, q, time, size);
      break;
    case MOVING_RAMP:
    case MOVING_SHAPES:
      add(q, late, q->omega0 + size);
      break;
  }
}

void moving_draw(draw_t *draw, lib_machine_t *q, moving_shape_t shape,
                 double time, double grid) {
  q->knots = 0;
  draw_shape(draw, q, shape, time);
  const bool on_grid = draw_uniform(draw, 0, 2) < 1;
  const double kind = draw_uniform(draw, 0, 8);
  const double load = kind < 4 ? 0 : q->mu / 3;
  for (int i = 0; i < q->knots; ++i) {
    lib_knot_t *u = &q->knot[i];
    const bool held = i > 0 && kind < 7;
    u->t = on_grid ? round(u->t / grid) * grid : u->t;
    u->force = held ? u[-1].force : (float)(load * draw_uniform(draw, -1, 1));
    u->torque = held ? u[-1].torque : (float)(load * draw_uniform(draw, -1, 1));
  }
}

// Piece i lies before knot i.
static moving_input_t on_piece(const lib_machine_t *q, int i, double t) {
  const lib_knot_t *a = &q->knot[i > 0 ? i - 1 : 0];
  const lib_knot_t *b = &q->knot[i < q->knots ? i : q->knots - 1];
  const double length = b->t - a->t;
  const double share = length > 0 ? (t - a->t) / length : 0;
  return (moving_input_t){a->omega0 + share * (b->omega0 - a->omega0),
                          length > 0 ? (b->omega0 - a->omega0) / length : 0,
                          a->force + share * (b->force - a->force),
                          a->torque + share * (b->torque - a->torque)};
}

moving_input_t moving_input(const lib_machine_t *q, double from, double to) {
  const double span = to - from, near = 1e-9 * span;
  moving_input_t sum = {0, 0, 0, 0};
  double t = from;
  for (int i = 0; i <= q->knots; ++i) {
    const bool last = i == q->knots || q->knot[i].t >= to - near;
    const double end = last ? to : q->knot[i].t;
    if (i < q->knots && q->knot[i].t <= t + near) {
      continue; // passed, or a jump
    }
    const moving_input_t mean = on_piece(q, i, t + (end - t) / 2);
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
  moving_input_t before = {0, 0, 0, 0};
  int count = 0;
  for (long n = 0; n < steps; ++n) {
    const double from = (double)n * q->dt, to = (double)(n + 1) * q->dt;
    const moving_input_t u = moving_input(q, from, to);
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
      if (count + 2 > most) return 0;
      table[count++] = (ref_knot_t){from, start, u.force, u.torque};
      ++count;
    }
    table[count - 1] =
        (ref_knot_t){to, (ref_real_t)u.omega0, u.force, u.torque};
    before = u;
  }
  return count;
}
