// Writes tests/data/reference.h and its parts.
#ifndef ORACLE_WRITE_H
#define ORACLE_WRITE_H

#include <stdio.h>

#include "run.h"

// How far two other computations of the same course are from it: the largest
// difference of a state on the grid, and of the time of an event [s]; and
// whether their events are the same.
typedef struct {
  real state, time;
  int agree;
} uncertainty_t;

typedef struct {
  const problem_t *problem;
  course_t course;
  uncertainty_t looser, other; // same method, looser; the other method
} result_t;

void write_index(FILE *out, const problem_t list[], int n);
void write_problem(FILE *out, const result_t *result);

#endif
