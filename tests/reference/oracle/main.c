// The oracle: writes one reference solution, or the index of all, to standard
// output. Each is computed three times: by extrapolation, the same at a looser
// tolerance, and by collocation. Says on standard error how far they are apart.
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "write.h"

static real distance(const state_t *a, const state_t *b) {
  return bigger(fabsq(a->r - b->r),
                bigger(fabsq(a->v - b->v), fabsq(a->w - b->w)));
}

static uncertainty_t compare(const course_t *a, const course_t *b) {
  uncertainty_t d = {0, 0, a->events == b->events && a->states == b->states};
  for (int i = 0; i < a->states && i < b->states; i++)
    d.state = bigger(d.state, distance(&a->grid[i], &b->grid[i]));
  for (int i = 0; i < a->events && i < b->events; i++) {
    const event_t *x = &a->event[i], *y = &b->event[i];
    d.time = bigger(d.time, fabsq(x->at.t - y->at.t));
    d.agree &= x->before == y->before && x->after == y->after;
  }
  return d;
}

static void solve(const problem_t *problem, result_t *result) {
  static course_t course;
  const method_t fine = {"extrapolation", step_extrapolated, (real)1e-30, 25};
  const method_t loose = {"looser", step_extrapolated, (real)1e-27, 25};
  const method_t other = {"collocation", step_collocated, (real)1e-16, 14};
  const clock_t start = clock();
  result->problem = problem;
  run(problem, &fine, &result->course);
  run(problem, &loose, &course);
  result->looser = compare(&result->course, &course);
  run(problem, &other, &course);
  result->other = compare(&result->course, &course);
  fprintf(stderr,
          "%-12s %3d events to t = %-9.6g differences %.1e %.1e, "
          "in events %.1e %.1e s %s; %.1f s\n",
          problem->name, result->course.events, (double)result->course.last.t,
          (double)result->looser.state, (double)result->other.state,
          (double)result->looser.time, (double)result->other.time,
          result->looser.agree && result->other.agree ? "" : "(OTHERS)",
          (double)(clock() - start) / CLOCKS_PER_SEC);
}

int main(int argc, char **argv) {
  static result_t result;
  const char *wanted = argc == 2 ? argv[1] : "";
  int found = !strcmp(wanted, "index") || !strcmp(wanted, "names");
  if (!strcmp(wanted, "index")) write_index(stdout, problems, PROBLEMS);
  for (int i = 0; i < PROBLEMS; i++) {
    if (!strcmp(wanted, "names")) puts(problems[i].name);
    if (strcmp(wanted, problems[i].name) != 0) continue;
    found = 1;
    solve(&problems[i], &result);
    write_problem(stdout, &result);
  }
  if (!found) fprintf(stderr, "usage: oracle index | names | PROBLEM\n");
  return found && fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
