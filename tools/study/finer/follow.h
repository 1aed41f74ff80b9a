// One motion, from the sliding region through the two-fold to where it leaves
// the layer and on to where g changes its sign, or h = g = 0 is reached under a
// law of the slip angle.
#ifndef FINER_FOLLOW_H
#define FINER_FOLLOW_H

#include "motion.h"

typedef struct {
  double until; // [s]
  double fold;  // r of the two-fold [m]
  double exit;  // a motion has left where |h| is that many widths
  double kick;  // what is added to h at the two-fold [m/s]
  double step;  // fixed steps [s] of `columns` columns; 0: by the error
  int columns;
} course_t;

typedef struct {
  double fold_t, exit_t, exit_r; // NaN where it did not happen
  double zero_t, zero_r;         // g = 0 behind the two-fold
  double before, behind;         // integrals of the layer's rate: to the
                                 // two-fold, and from it to the exit
  int side, windings;            // of the exit; changes of the sign of h after
  point_t end;
} outcome_t;

outcome_t follow(motion_t *motion, const course_t *course, point_t p);

#endif
