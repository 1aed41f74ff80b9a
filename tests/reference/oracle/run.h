// One problem followed from its start: events and states.
#ifndef ORACLE_RUN_H
#define ORACLE_RUN_H

#include "codim2.h"
#include "flow.h"

enum { EVENTS = 400, GRID = 16 };

typedef struct {
  const char *name, *value;
} parameter_t;

typedef struct {
  const char *name, *law_name;
  parameter_t parameter[PARAMETERS]; // those that differ from `common`
  const char *r, *omega, *h, *v;     // start; v or NULL: from h
  const char *t_end;                 // events are followed up to here
  const char *t_grid;                // states at t_grid i/16, i = 1 ... 16
  law_t law;
  int knots;
  const char *knot[KNOTS][2];
} problem_t;

#define PROBLEMS 11
extern const problem_t problems[PROBLEMS];

void problem_machine(const problem_t *problem, machine_t *p);
// Value of a parameter of the problem as text, or NULL where it has none.
const char *problem_parameter(const problem_t *problem, const char *name);
extern const char *const parameter_names[PARAMETERS];

typedef struct {
  real t, r, v, w;
} state_t;

typedef struct {
  state_t at;
  int before, after; // contact_t; after < 0: the motion is not unique any more
  const char *how;   // "cross" "enter" "leave" "h=g=0" "two-fold" "roll"
} event_t;

typedef struct {
  state_t start, grid[GRID], last;
  int begins, states, events;
  event_t event[EVENTS];
  const char *ends; // why, in words
} course_t;

extern const char *const contact_names[5];

void run(const problem_t *problem, const method_t *method, course_t *out);

#endif
