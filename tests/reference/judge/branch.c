/// @file
/// Which future a scheme takes at the first h = g = 0 of a motion. The
/// reference follows every future of that point, and standing still, for a
/// short while; the scheme has taken the one it is nearest to.
#include <math.h>

#include "classes.h"

enum { WAYS = REF_MAX_WAYS + 1 };
static const runs_t runs = {1, 3, 1, {1e-4, 3e-5, 1e-5}, ""};

// The consistent modes at the first h = g = 0, a little later.
typedef struct {
  double t;              ///< when they are compared [s]
  ref_state_t end[WAYS]; ///< [count]: standing still
  int count, chosen;     ///< of consistent; count where the wheel rests
} fork_t;

typedef struct {
  ref_orbit_t first;
  bool found;
} finder_t;

static void find(const ref_orbit_t *orbit, ref_event_t event) {
  finder_t *finder = orbit->context;
  if (event == REF_CODIM2 && !finder->found) {
    finder->found = true;
    finder->first = *orbit;
  }
}

// Time for which the rule's own future is alone: until the second h = g = 0.
static real_t quiet(const ref_orbit_t *at, real_t span) {
  finder_t finder = {.found = false};
  ref_orbit_t orbit = *at;
  orbit.watch = find;
  orbit.context = &finder;
  orbit.codim2_count = 0;
  ref_run(&orbit, at->x.t + span);
  const real_t until = finder.found ? finder.first.x.t : orbit.x.t;
  return until - at->x.t < span ? 0.8L * (until - at->x.t) : span;
}

static bool make_fork(const ref_orbit_t *at, fork_t *fork) {
  const real_t span = quiet(at, 0.05L);
  if (span < 0.002L || at->stop != REF_REACHED) {
    return false;
  }
  fork->t = ceil((double)(at->x.t + span) / 3e-4) * 3e-4;
  fork->count = at->consistent.count;
  fork->chosen = at->chosen == REF_REST ? fork->count : at->chosen;
  for (int i = 0; i < fork->count; ++i) {
    ref_orbit_t way = *at;
    way.watch = NULL;
    way.x = at->at;
    ref_leave(&way, i);
    ref_run(&way, (real_t)fork->t);
    fork->end[i] = way.x;
  }
  fork->end[fork->count] = at->at;
  return true;
}

// The future that a row is nearest to, or -1 where it is far from all. Futures
// that have met again count as the one taken by the rule, and so does a row
// that is as near to that as to another.
static int nearest(const ref_machine_t *q, const fork_t *fork,
                   const lib_row_t *row) {
  int best = fork->chosen;
  double least = class_difference(q, fork->end[best], row) / 2;
  for (int i = 0; i <= fork->count; ++i) {
    const double e = class_difference(q, fork->end[i], row);
    if (e < least &&
        class_distance(q, fork->end[i], fork->end[fork->chosen]) > 1e-5) {
      least = e;
      best = i;
    }
  }
  least = class_difference(q, fork->end[best], row);
  double apart = 0;
  for (int i = 0; i <= fork->count; ++i) {
    apart = fmax(apart, class_distance(q, fork->end[best], fork->end[i]));
  }
  return least < fmax(0.003, 0.3 * apart) ? best : -1;
}

static count_t *come, *open_, *silent[RUNS], *told[RUNS];

static void begin(const class_t *class) {
  (void)class;
  come = count_add(false, "come to h = g = 0");
  open_ = count_add(false, "of them more than one future");
  count_runs(silent, &runs, "wrong, all steps OK");
  count_runs(told, &runs, "wrong, and told");
}

static void compare(trial_t *trial, const ref_machine_t *q,
                    const fork_t *fork) {
  trial->t_end = fork->t;
  for (int k = 0; k < runs_count(&runs); ++k) {
    lib_row_t row;
    const long others = trial_run(trial, &runs, k, &row);
    if (others < 0) {
      return;
    }
    const bool wrong = nearest(q, fork, &row) != fork->chosen;
    count_try(silent[k], trial, wrong && others == 0);
    count_try(told[k], trial, wrong && others != 0);
  }
}

static void judge(trial_t *trial) {
  ref_machine_t q;
  finder_t finder = {.found = false};
  ref_orbit_t orbit = class_orbit(&trial->machine, &q, &lib_f64);
  orbit.watch = find;
  orbit.context = &finder;
  orbit.limit = 2000000;
  ref_run(&orbit, (real_t)trial->t_end);
  fork_t fork = {.count = 0};
  const bool forks = finder.found && make_fork(&finder.first, &fork);
  count_try(come, trial, forks);
  if (!forks) {
    return;
  }
  const bool rests = finder.first.consistent.rests[REF_HEXAGON];
  count_try(open_, trial, fork.count + rests > 1);
  compare(trial, &q, &fork);
}

const class_t class_branch = {.name = "branch",
                              .about = "the future taken at h = g = 0",
                              .machines = 2000,
                              .t_end = 3,
                              .begin = begin,
                              .judge = judge};
