// The grid of settings, the clock and the rows. Neighbours on the grid differ
// by a constant factor and a random shift, so that no grid is lucky: a fixed
// step may end on a switch by chance, and then looks better than it is.
#define _POSIX_C_SOURCE 200809L

#include "sweep.h"

#include <math.h>
#include <stdio.h>

#include "bench/steps/timing.h"

#define SEED 20240607u
#define RUNS 25     // at most, in one round
#define ENOUGH 1e-2 // [s] of runs in a row

long sweep_steps(const problem_t *problem, double dt) {
  const double steps = ceil(problem->t_end / dt);
  return (long)steps;
}

static int settings(const peer_t *peer) {
  return 1 + (int)(log(peer->coarse / peer->fine) / log(peer->factor));
}

// Setting i of a peer: within half a factor of its place.
static double setting_of(const peer_t *peer, int number, int i) {
  uint32_t out[2];
  tf_philox((uint64_t)number << 32 | (uint64_t)i, SEED, out);
  const double shift = out[0] / 4294967296.0 - 0.5;
  return peer->coarse * pow(peer->factor, -i - shift);
}

static double median_time(const problem_t *problem, const peer_t *peer,
                          double setting, answer_t *answer) {
  double time[RUNS];
  const double begin = timing_wall();
  int n = 0;
  double now = begin;
  while (n == 0 || (n < RUNS && now - begin < ENOUGH)) {
    const double start = timing_wall();
    peer->solve(problem, setting, peer->width, answer);
    now = timing_wall();
    time[n++] = now - start;
  }
  timing_sort(time, (size_t)n);
  return time[n / 2];
}

static void print_row(const problem_t *problem, const peer_t *peer,
                      double setting) {
  answer_t answer = {.steps = 0};
  const double time = median_time(problem, peer, setting, &answer);
  double error = problem_error(problem, answer.x);
  if (answer.lost) error = HUGE_VAL;
  printf("%s,%s,", problem->name, peer->name);
  if (peer->width > 0) printf("eps=%.0e ", peer->width);
  printf("%s=%.3e,%ld,%.3e,%.0f,%d\n", peer->knob, setting, answer.steps, error,
         1e9 * time, error <= problem->branch_error);
}

void sweep_round(const peer_t *peers, int n) {
  int most = 0;
  for (int p = 0; p < n; p++)
    if (settings(&peers[p]) > most) most = settings(&peers[p]);
  for (int i = 0; i < most; i++) {
    for (int j = 0; j < PROBLEMS; j++) {
      const problem_t problem = problem_number(j);
      for (int p = 0; p < n; p++) {
        if (i >= settings(&peers[p])) continue;
        print_row(&problem, &peers[p], setting_of(&peers[p], p, i));
      }
    }
  }
}
