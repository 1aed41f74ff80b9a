/// @file
/// Inputs that move, in shapes that machines meet, and what a step is told of
/// them.
#ifndef REFERENCE_MOVING_H
#define REFERENCE_MOVING_H

#include "draw.h"

typedef enum {
  MOVING_RAMP,
  MOVING_TRIANGLE,
  MOVING_SINE,
  MOVING_HELD_STEPS,
  MOVING_JUMPS,
  MOVING_THROUGH_ZERO,
  MOVING_HOLD_THEN_RAMP,
  MOVING_KINKS,
  MOVING_SHAPES
} moving_shape_t;
extern const char *const moving_names[MOVING_SHAPES];

/// Makes omega0 move from where it is over a time, with loads in half of the
/// draws, which move in an eighth. Half of the draws have their knots on multiples of `grid`.
void moving_draw(draw_t *draw, lib_machine_t *machine, moving_shape_t shape,
                 double time, double grid);

/// What a step is told: omega0 at its end, the mean of its slope between jumps,
/// and mean loads.
typedef struct {
  double omega0, alpha, force, torque;
} told_t;
/// From a time to another; of an empty span the values and the slope behind it.
told_t moving_told(const lib_machine_t *machine, double from, double to);

/// What `steps` steps of a machine's dt are told, as inputs of the reference:
/// straight within a step, a jump at its start where one lies in it. Writes up
/// to `most` knots; returns how many, or 0 where they are more.
int moving_table(const lib_machine_t *machine, long steps, ref_knot_t *table,
                 int most);

#endif
