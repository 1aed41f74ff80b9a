/// @file
/// Inputs that move, in shapes that machines meet.
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

/// Makes omega0 move from where it is over a time, with loads in half of the
/// draws, which move in an eighth. Half of the draws have their knots on
/// multiples of `grid`.
void moving_draw(draw_t *draw, lib_machine_t *machine, moving_shape_t shape,
                 double time, double grid);

#endif
