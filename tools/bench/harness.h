/// Work and precision: each solver is run on each problem over a fine grid of
/// its step or tolerance, the solvers in turns.
#pragma once

#include "problem.h"

typedef struct {
  double x[3];  // r, v, w at the end
  int flagged;  // steps that were degraded, fell back or were coarse
  int lost;     // it gave up before the end, or the start was refused
  uint8_t mode; // at the end; TF_NO_MODE where the solver does not say
} answer_t;

typedef struct solver solver_t;

/// Solves a problem from nothing, at a setting, into an answer.
typedef void solve_t(const problem_t *problem, const solver_t *solver,
                     double setting, answer_t *answer);

struct solver {
  const char *name;
  const char *dial;    // what a setting is: "dt" [s] or "tol"
  double coarse, fine; // first and last setting, about
  double factor;       // between neighbours; 1: one setting, the first
  double second;       // what is not swept: a width, a step, a tolerance
  unsigned problems;   // that it solves
  int method;          // which of those that `solve` knows
  solve_t *solve;
};

/// Prints one row `problem,solver,dial,error,ns,verdict` a problem, solver and
/// setting (`time`: the median time of a few runs in a row), or runs each once
/// for callgrind, which dumps its counter after every call of `solve_counted`,
/// and prints `problem,solver,dial` (`count`), or prints `problem,length [s]`
/// (`problems`). The settings are the same every time. Returns: an exit code.
int harness_main(int argc, char **argv, const solver_t *solvers, int n);

/// Steps of about dt that fill the problem.
long harness_steps(const problem_t *problem, double dt);

/// A random number in [0, 1): the same in every run.
double harness_random(unsigned stream, unsigned i);
