// The clocks and the rows: other programs disturb the one, the other is slow.
#define _POSIX_C_SOURCE 200809L

#include "harness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define RUNS 25     // at most, in a row
#define ENOUGH 1e-2 // [s] of them

typedef struct {
  char line[200];
  problem_t problem;
  char solver[20];
  double number[NUMBERS];
} task_t;

long harness_steps(const problem_t *problem, double dt) {
  const double steps = ceil(problem->length / dt * (1 - 1e-9));
  return (long)steps;
}

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// Reads a run. Returns 0 behind the last one.
static int next_task(task_t *task) {
  char problem[20];
  *task = (task_t){.solver = ""};
  double *x = task->number;
  if (fgets(task->line, sizeof task->line, stdin) == NULL) return 0;
  if (sscanf(task->line, "%19s %19s %lf %lf %lf %lf", problem, task->solver, x,
             x + 1, x + 2, x + 3) < 3 ||
      !problem_named(problem, &task->problem)) {
    fprintf(stderr, "not a run: %s", task->line);
    exit(2);
  }
  return 1;
}

static double median_time(solve_t *solve, const task_t *task,
                          answer_t *answer) {
  double time[RUNS];
  const double begin = seconds(CLOCK_MONOTONIC);
  size_t n = 0;
  double now = begin;
  while (n == 0 || (n < RUNS && now - begin < ENOUGH)) {
    const double busy = seconds(CLOCK_PROCESS_CPUTIME_ID);
    const double start = seconds(CLOCK_MONOTONIC);
    solve(&task->problem, task->solver, task->number, answer);
    now = seconds(CLOCK_MONOTONIC);
    time[n++] = fmin(now - start, seconds(CLOCK_PROCESS_CPUTIME_ID) - busy);
  }
  qsort(time, n, sizeof *time, ascending);
  return time[n / 2];
}

static void time_run(solve_t *solve, const task_t *task) {
  const problem_t *problem = &task->problem;
  answer_t answer = {.mode = TF_NO_MODE};
  const double time = median_time(solve, task, &answer);
  const double error =
      answer.lost ? HUGE_VAL : problem_error(problem, answer.x);
  const int other_mode = answer.mode != TF_NO_MODE &&
                         problem->mode_at_end != TF_NO_MODE &&
                         answer.mode != problem->mode_at_end;
  printf("%.3e,%.0f,%s\n", error, 1e9 * time,
         answer.lost                                       ? "refused"
         : other_mode || !(error <= problem->branch_error) ? "branch"
         : answer.flagged                                  ? "flagged"
                                                           : "ok");
}

// Not static, or the compiler may make a form of it with another name.
void solve_counted(solve_t *solve, const task_t *task);

__attribute__((noinline)) void solve_counted(solve_t *solve,
                                             const task_t *task) {
  answer_t answer = {.mode = TF_NO_MODE};
  solve(&task->problem, task->solver, task->number, &answer);
  __asm__ volatile("" ::: "memory"); // a tail call would leave the frame
}

int harness_main(int argc, char **argv, solve_t *solve) {
  const char *command = argc == 2 ? argv[1] : "";
  task_t task;
  if (strcmp(command, "time") == 0)
    while (next_task(&task)) time_run(solve, &task);
  else if (strcmp(command, "count") == 0)
    while (next_task(&task)) {
      solve_counted(solve, &task);
      fputs(task.line, stdout);
    }
  else if (strcmp(command, "problems") == 0)
    for (int i = 0; i < PROBLEMS; i++) {
      const problem_t p = problem_number(i);
      printf("%s,%g,%.17g,%.17g,%.17g\n", p.name, p.length, p.end[0], p.end[1],
             p.end[2]);
    }
  else
    return 2;
  return 0;
}
