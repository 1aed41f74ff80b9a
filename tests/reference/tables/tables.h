// The reference solutions of tests/data: problems, their courses in quadruple
// precision, and how they are written.
#ifndef TABLES_H
#define TABLES_H

#include <stdio.h>

#include "reference.h"

enum { EVENTS = 400, GRID = 16, KNOTS = 8, PARAMETERS = 17, PROBLEMS = 11 };

typedef struct {
  const char *name, *value;
} parameter_t;

typedef struct {
  const char *name, *law_name;
  parameter_t parameter[PARAMETERS]; // those that differ from `common`
  const char *r, *omega, *h, *v;     // start; v or NULL: from h
  const char *t_end;                 // events are followed up to here
  const char *t_grid;                // states at t_grid i/16, i = 1 ... 16
  ref_law_t law;
  int knots;
  const char *knot[KNOTS][2];
} problem_t;

extern const problem_t problems[PROBLEMS];
extern const char *const parameter_names[PARAMETERS];

ref_real_t quad_of(const char *text);
void problem_machine(const problem_t *problem, ref_machine_t *machine,
                     ref_ramps_t *ramps);
// Value of a parameter of the problem as text, or NULL where it has none.
const char *problem_parameter(const problem_t *problem, const char *name);

typedef struct {
  ref_real_t t, r, v, w;
} row_t;

typedef struct {
  row_t at;
  ref_mode_t before, after; // REF_MODES: the motion is not unique any more
  ref_event_t how;
} switch_t;

typedef struct {
  row_t start, grid[GRID], last;
  ref_real_t h; // at the start
  ref_mode_t begins;
  int states, events;
  switch_t event[EVENTS];
  ref_stop_t stop;
} course_t;

void course_follow(const problem_t *problem, ref_real_t tolerance,
                   course_t *out);

// How far another computation of the same course is from it: the largest
// difference of a state on the grid, and of the time of an event [s]; and
// whether its events are the same.
typedef struct {
  ref_real_t state, time;
  bool agree;
} uncertainty_t;

void write_index(FILE *out);
void write_problem(FILE *out, const problem_t *problem, const course_t *course,
                   const uncertainty_t *looser);

#endif
