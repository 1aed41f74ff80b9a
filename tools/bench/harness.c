// The grid of settings, the clock and the rows. Neighbours on the grid differ
// by a constant factor and a random shift, so that no grid is lucky: a fixed
// step may end on a switch by chance, and then looks better than it is.
#define _POSIX_C_SOURCE 200809L

#include "harness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "timing.h"

#define SEED 20240607u
#define RUNS 25     // at most, in a row
#define ENOUGH 1e-2 // [s] of them
#define TOO_LONG 1  // [s] under callgrind: finer settings are not counted

long harness_steps(const problem_t *problem, double dt) {
  const double steps = ceil(problem->length / dt * (1 - 1e-9));
  return (long)steps;
}

double harness_random(unsigned stream, unsigned i) {
  uint32_t out[2];
  tf_philox((uint64_t)stream << 32 | i, SEED, out);
  return out[0] / 4294967296.0;
}

// Between neighbours; QUICK in the environment leaves three of four out where
// they are dense.
static double factor_of(const solver_t *s) {
  const char *quick = getenv("QUICK");
  return quick && *quick && s->factor < 2 ? pow(s->factor, 4) : s->factor;
}

static int settings(const solver_t *s) {
  if (s->factor <= 1) return 1;
  return 1 + (int)(log(s->coarse / s->fine) / log(factor_of(s)));
}

// Setting i of a solver: within half a factor of its place.
static double setting_of(const solver_t *s, int number, int i) {
  if (s->factor <= 1) return s->coarse;
  const double shift = harness_random((unsigned)number, (unsigned)i) - 0.5;
  return s->coarse * pow(factor_of(s), -i - shift);
}

// Whether it solves the problem of that number, and that has such a setting: a
// step longer than it is the same as one of its length.
static int takes(int number, const problem_t *problem, const solver_t *s,
                 double setting) {
  return (s->problems >> number & 1) && setting <= problem->length &&
         s->second <= problem->length;
}

static double median_time(const problem_t *problem, const solver_t *s,
                          double setting, answer_t *answer) {
  double time[RUNS];
  const double begin = timing_wall();
  int n = 0;
  double now = begin;
  while (n == 0 || (n < RUNS && now - begin < ENOUGH)) {
    const double start = timing_wall();
    s->solve(problem, s, setting, answer);
    now = timing_wall();
    time[n++] = now - start;
  }
  timing_sort(time, (size_t)n);
  return time[n / 2];
}

static void print_key(const problem_t *problem, const solver_t *s,
                      double setting) {
  printf("%s,%s%s,%s=%.3e", problem->name, s->name,
         sizeof(tf_real_t) == 8 ? "" : " float", s->dial, setting);
}

static void print_row(const problem_t *problem, const solver_t *s,
                      double setting) {
  answer_t answer = {.mode = TF_NO_MODE};
  const double time = median_time(problem, s, setting, &answer);
  const double error =
      answer.lost ? HUGE_VAL : problem_error(problem, answer.x);
  const int other_mode = answer.mode != TF_NO_MODE &&
                         problem->mode_at_end != TF_NO_MODE &&
                         answer.mode != problem->mode_at_end;
  print_key(problem, s, setting);
  printf(",%.3e,%.0f,%s\n", error, 1e9 * time,
         answer.lost                                       ? "refused"
         : other_mode || !(error <= problem->branch_error) ? "branch"
         : answer.flagged                                  ? "flagged"
                                                           : "ok");
}

static void time_all(const solver_t *solvers, int n) {
  int most = 0;
  for (int s = 0; s < n; s++)
    if (settings(&solvers[s]) > most) most = settings(&solvers[s]);
  for (int i = 0; i < most; i++) {
    for (int j = 0; j < PROBLEMS; j++) {
      const problem_t problem = problem_number(j);
      for (int s = 0; s < n; s++) {
        const double setting = setting_of(&solvers[s], s, i);
        if (i < settings(&solvers[s]) &&
            takes(j, &problem, &solvers[s], setting))
          print_row(&problem, &solvers[s], setting);
      }
    }
  }
}

// Not static, or the compiler may make a form of it with another name.
solve_t solve_counted;

__attribute__((noinline)) void solve_counted(const problem_t *problem,
                                             const solver_t *s, double setting,
                                             answer_t *answer) {
  s->solve(problem, s, setting, answer);
  __asm__ volatile("" ::: "memory"); // a tail call would leave the frame
}

static void count_all(const solver_t *solvers, int n) {
  for (int s = 0; s < n; s++) {
    for (int j = 0; j < PROBLEMS; j++) {
      const problem_t problem = problem_number(j);
      double spent = 0;
      for (int i = 0; i < settings(&solvers[s]) && spent < TOO_LONG; i++) {
        const double setting = setting_of(&solvers[s], s, i);
        answer_t answer = {.mode = TF_NO_MODE};
        if (!takes(j, &problem, &solvers[s], setting)) continue;
        const double begin = timing_wall();
        solve_counted(&problem, &solvers[s], setting, &answer);
        if (!answer.lost) spent = timing_wall() - begin;
        print_key(&problem, &solvers[s], setting);
        putchar('\n');
      }
    }
  }
}

int harness_main(int argc, char **argv, const solver_t *solvers, int n) {
  if (argc != 2) return 2;
  if (strcmp(argv[1], "time") == 0)
    time_all(solvers, n);
  else if (strcmp(argv[1], "count") == 0)
    count_all(solvers, n);
  else if (strcmp(argv[1], "problems") == 0)
    for (int i = 0; i < PROBLEMS; i++) {
      const problem_t p = problem_number(i);
      printf("%s,%g,%.17g,%.17g,%.17g\n", p.name, p.length, p.end[0], p.end[1],
             p.end[2]);
    }
  else
    return 2;
  return 0;
}
