/// The courses of the reference problems; see problems.h.
#include <stdlib.h>

#include "problems.h"

static void note(const ref_orbit_t *orbit, ref_event_t event) {
  reference_t *ref = orbit->context;
  if (ref->events == REF_EVENTS) abort();
  ref->event[ref->events++] = (reference_event_t){
      .after = orbit->stop == REF_REACHED ? orbit->mode : REF_MODES,
      .t = event == REF_CODIM2 ? orbit->at.t : orbit->x.t};
}

// Each sixteenth is a stop, kept or not: the last digits hang on it.
void reference_follow(int i, ref_real_t tolerance, reference_t *ref) {
  static const int quarters[REF_KEPT] = {4, 8, 12, 16};
  const ref_problem_t *problem = &ref_problems[i];
  const int *kept = problem->kept[0] ? problem->kept : quarters;
  ref_machine_t q = problem->machine;
  ref_orbit_t orbit = {.tolerance = tolerance,
                       .law = REF_HEXAGON,
                       .watch = note,
                       .context = ref};
  *ref = (reference_t){.problem = problem};
  ref_prepare(&q);
  ref_begin(&orbit, &q, ref_problem_start(problem, &q), REF_MODES);
  ref->begins = orbit.mode;
  for (int n = 1; n <= REF_SIXTEENTHS; n++) {
    ref_run(&orbit, problem->t_grid * n / REF_SIXTEENTHS);
    const ref_state_t x = orbit.x;
    if (ref->states < REF_KEPT && kept[ref->states] == n)
      ref->state[ref->states++] =
          (reference_state_t){x.t, x.r, ref_v(&q, x), ref_w(&q, x)};
  }
  if (problem->t_events > 0) ref_run(&orbit, problem->t_events);
  ref->t_last = orbit.x.t;
}

const reference_t *reference_course(int i) {
  static reference_t all[REF_PROBLEMS];
  if (all[i].problem == NULL) reference_follow(i, 1e-15L, &all[i]);
  return &all[i];
}
