/// @file
/// Work and precision of peers: each is run over a fine grid of its step or
/// tolerance, the peers in turns.
#ifndef TWOFOLD_PEERS_SWEEP_H
#define TWOFOLD_PEERS_SWEEP_H

#include "problem.h"

typedef struct {
  double x[3]; // r, v, w at the end
  long steps;
  int lost; // it gave up before the end
} answer_t;

/// Solves a problem from nothing, at a setting, into an answer.
typedef void solve_t(const problem_t *problem, double setting, double width,
                     answer_t *answer);

typedef struct {
  const char *name;
  const char *knob;    // what a setting is: "dt" [s] or "tol"
  double coarse, fine; // first and last setting, about
  double factor;       // between neighbours
  double width;        // of a smoothed sign(h) [m/s], else 0
  solve_t *solve;
} peer_t;

/// Prints one row a problem, peer and setting, as the header of the table has
/// it: the median time of a few runs in a row. Every round prints the same
/// rows but for the time.
void sweep_round(const peer_t *peers, int n);

/// Steps of about dt that fill t_end.
long sweep_steps(const problem_t *problem, double dt);

#endif
