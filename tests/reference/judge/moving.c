/// @file
/// Inputs that move; see moving.h.
#include "moving.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double sign(draw_t *draw) {
  return draw_uniform(draw, 0, 2) < 1 ? -1 : 1;
}

static void add(lib_machine_t *q, double t, double omega0) {
  if (q->knots < LIB_KNOTS) {
    q->knot[q->knots++] = (lib_knot_t){.t = t, .omega0 = (float)omega0};
  }
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
  for (int i = 1; i < LIB_KNOTS; ++i) {
    add(q, period * (2 * i - 1) / 4, q->omega0 + (i % 2 ? size : -size));
  }
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
  const double size = sign(draw) * fabs(q->omega0) * draw_log(draw, 0.02, 3);
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
