// Writes one reference solution, or the index of all, to standard output. Each
// is computed twice, the second time at a tolerance 1000 times looser; how far
// they are apart goes to standard error as well.
#include <stdlib.h>
#include <string.h>

#include "tables.h"

static row_t row_of(const ref_machine_t *q, ref_state_t x) {
  return (row_t){x.t, x.r, ref_v(q, x), ref_w(q, x)};
}

static void note(const ref_orbit_t *orbit, ref_event_t event) {
  course_t *out = orbit->context;
  const bool ends = orbit->stop != REF_REACHED;
  const ref_state_t at = event == REF_CODIM2 ? orbit->at : orbit->x;
  if (out->events < EVENTS)
    out->event[out->events++] =
        (switch_t){row_of(orbit->machine, at), orbit->before,
                   ends ? REF_MODES : orbit->mode, event};
}

static ref_state_t start_of(const problem_t *problem, const ref_machine_t *q) {
  const ref_real_t v = quad_of(problem->v);
  const ref_state_t x =
      ref_state(q, quad_of(problem->r), v, quad_of(problem->omega));
  return problem->v ? x : ref_with_h(q, x, quad_of(problem->h));
}

void course_follow(const problem_t *problem, ref_real_t tolerance,
                   course_t *out) {
  ref_machine_t q;
  ref_ramps_t ramps;
  ref_orbit_t orbit = {.tolerance = tolerance,
                       .law = REF_HEXAGON,
                       .limit = 2000000000,
                       .watch = note,
                       .context = out};
  const ref_real_t t_end = quad_of(problem->t_end);
  const ref_real_t t_grid = quad_of(problem->t_grid);
  problem_machine(problem, &q, &ramps);
  out->events = out->states = 0;
  ref_begin(&orbit, &q, start_of(problem, &q), REF_MODES);
  out->begins = orbit.mode;
  out->start = row_of(&q, orbit.x);
  out->h = problem->h ? quad_of(problem->h) : ref_slip(&q, orbit.x).h;
  for (int i = 1; i <= GRID; i++) {
    if (ref_run(&orbit, t_grid * i / GRID) != REF_REACHED) break;
    out->grid[out->states++] = row_of(&q, orbit.x);
  }
  out->stop = ref_run(&orbit, t_end);
  out->last = row_of(&q, orbit.x);
}

static ref_real_t distance(const row_t *a, const row_t *b) {
  return ref_larger(ref_abs(a->r - b->r),
                    ref_larger(ref_abs(a->v - b->v), ref_abs(a->w - b->w)));
}

static uncertainty_t compare(const course_t *a, const course_t *b) {
  uncertainty_t d = {0, 0, a->events == b->events && a->states == b->states};
  for (int i = 0; i < a->states && i < b->states; i++)
    d.state = ref_larger(d.state, distance(&a->grid[i], &b->grid[i]));
  for (int i = 0; i < a->events && i < b->events; i++) {
    const switch_t *x = &a->event[i], *y = &b->event[i];
    d.time = ref_larger(d.time, ref_abs(x->at.t - y->at.t));
    d.agree = d.agree && x->before == y->before && x->after == y->after;
  }
  return d;
}

static void solve(const problem_t *problem) {
  static course_t fine, loose;
  course_follow(problem, (ref_real_t)1e-30L, &fine);
  course_follow(problem, (ref_real_t)1e-27L, &loose);
  const uncertainty_t looser = compare(&fine, &loose);
  fprintf(stderr, "%-12s %3d events to t = %-9.6g differences %.1e, %.1e s%s\n",
          problem->name, fine.events, (double)fine.last.t, (double)looser.state,
          (double)looser.time, looser.agree ? "" : " (OTHER EVENTS)");
  write_problem(stdout, problem, &fine, &looser);
}

int main(int argc, char **argv) {
  const char *wanted = argc == 2 ? argv[1] : "";
  int found = 1;
  if (!strcmp(wanted, "index"))
    write_index(stdout);
  else
    found = !strcmp(wanted, "names");
  for (int i = 0; i < PROBLEMS; i++) {
    if (!strcmp(wanted, "names")) puts(problems[i].name);
    if (strcmp(wanted, problems[i].name) != 0) continue;
    found = 1;
    solve(&problems[i]);
  }
  if (!found) fprintf(stderr, "usage: tables index | names | PROBLEM\n");
  return found && fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
