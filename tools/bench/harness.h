/// What the programs of a race share. Each reads runs, one a line: `PROBLEM
/// SOLVER NUMBER...`. It prints one line a run.
#pragma once

#include "problem.h"

enum { NUMBERS = 4 };

typedef struct {
  double x[3];  // r, v, w at the end
  int flagged;  // steps that were degraded, fell back or were coarse
  int lost;     // it gave up before the end, or the start was refused
  uint8_t mode; // at the end; TF_NO_MODE where the solver does not say
} answer_t;

/// Solves a problem from nothing into an answer. The first number is a step [s]
/// or a tolerance, the others are the solver's own; 0 where a line has fewer.
typedef void solve_t(const problem_t *problem, const char *solver,
                     const double number[NUMBERS], answer_t *answer);

/// Prints `error,ns,verdict` of every run (`time`: the median time of a few in
/// a row), or does each once for callgrind, which dumps its counter after every
/// call of `solve_counted`, and prints its line (`count`); or prints
/// `problem,length [s],r,v,w` of all problems and their ends (`problems`).
/// Returns: an exit code.
int harness_main(int argc, char **argv, solve_t *solve);

/// Steps of about dt that fill the problem.
long harness_steps(const problem_t *problem, double dt);

/// The command `ensemble`, of 256 states or this many. Returns: an exit code.
int ensemble_main(size_t many);
