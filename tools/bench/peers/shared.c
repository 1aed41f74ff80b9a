// The motions of model.h for solvers that are not written in C.
#include "model.h"

enum { STATE = 4 }; // of a state: r, h, z, t

static problem_t problem;
static motion_t motion;

// Returns the length [s].
double peer_open(const char *name, double tol, double y[STATE]) {
  problem_named(name, &problem);
  motion = motion_of(&problem, tol);
  point_to(model_start(&motion.model, &problem), y);
  return problem.length;
}

int peer_jumps(void) { return motion.model.jumps; }

void peer_rates(const double y[STATE], double dy[STATE]) {
  point_to(contact_rates(&motion.model, motion.contact, point_of(y)), dy);
}

void peer_margins(const double y[STATE], double root[ROOTS]) {
  margins(&motion, point_of(y), root);
}

int peer_change(int root, double *t, double y[STATE]) {
  point_t at = point_of(y);
  const int found = change_at(&motion, root, t, &at);
  point_to(at, y);
  return found;
}

// Of the state at the end; infinite where it is on another branch.
double peer_error(const double y[STATE]) {
  double x[3];
  model_end(&motion.model, point_of(y), x);
  const double error = problem_error(&problem, x);
  return error <= problem.branch_error ? error : HUGE_VAL;
}
