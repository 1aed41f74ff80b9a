/// @file
/// What tests/data/reference.h has of each problem.
#ifndef REFERENCE_SOLUTION_H
#define REFERENCE_SOLUTION_H

#include "problems.h"

typedef struct {
  long double t, r, v, w; ///< [s], [m], [m/s], [rad/s]
} reference_state_t;

/// r, v and w are continuous. At h = g = 0 and at a two-fold several modes may
/// be consistent; `after` is "" where none is chosen.
typedef struct {
  const char *after;
  long double t; ///< [s]
} reference_event_t;

/// Ends at t_last: its length is over, or a two-fold is reached.
typedef struct {
  const ref_problem_t *problem;
  const char *begins;
  long double h; ///< at the start; v follows from it
  reference_state_t start;
  long double t_last;
  int states, events;
  const reference_state_t *state;
  const reference_event_t *event;
} reference_t;

#endif
