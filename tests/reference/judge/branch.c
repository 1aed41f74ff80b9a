/// @file
/// Which future a scheme takes at the first h = g = 0 of a motion. The
/// reference follows every future of that point, and standing still, for a
/// short while; the scheme has taken the one it is nearest to.
#include <math.h>

#include "judge.h"

enum { WAYS = REF_MAX_WAYS + 1, STEPS = 3 };
static const double dts[STEPS] = {1e-4, 3e-5, 1e-5};

// The futures of the first h = g = 0, a little later.
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
  if (span < 0.002L || at->stop != REF_REACHED) return false;
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
  double least = row_difference(q, fork->end[best], row) / 2;
  for (int i = 0; i <= fork->count; ++i) {
    const double e = row_difference(q, fork->end[i], row);
    if (e < least &&
        state_difference(q, fork->end[i], fork->end[fork->chosen]) > 1e-5) {
      least = e;
      best = i;
    }
  }
  least = row_difference(q, fork->end[best], row);
  double apart = 0;
  for (int i = 0; i <= fork->count; ++i)
    apart = fmax(apart, state_difference(q, fork->end[best], fork->end[i]));
  return least < fmax(0.003, 0.3 * apart) ? best : -1;
}

static count_t *come, *several, *silent[LIB_SCHEMES][STEPS],
    *flagged[LIB_SCHEMES][STEPS];

static void compare(trial_t *trial, const ref_machine_t *q,
                    const fork_t *fork) {
  trial->t_end = fork->t;
  for (int i = 0; i < LIB_SCHEMES * STEPS; ++i) {
    const int scheme = i / STEPS, k = i % STEPS;
    lib_row_t row;
    trial->machine.dt = dts[k];
    const int outcome = lib_f64.run(&trial->machine, (lib_scheme_t)scheme,
                                    fork->t, &row, NULL, NULL);
    if (outcome < 0) return;
    const bool wrong = nearest(q, fork, &row) != fork->chosen;
    count_try(silent[scheme][k], trial, wrong && outcome == 0);
    count_try(flagged[scheme][k], trial, wrong && outcome != 0);
  }
}

static void judge(trial_t *trial) {
  const ref_machine_t q = draw_reference(&trial->machine);
  finder_t finder = {.found = false};
  ref_orbit_t orbit = {.tolerance = 1e-11L,
                       .law = REF_HEXAGON,
                       .watch = find,
                       .context = &finder,
                       .limit = 2000000};
  ref_begin(&orbit, &q, draw_start(&trial->machine, &q), REF_MODES);
  ref_run(&orbit, (real_t)trial->t_end);
  fork_t fork = {.count = 0};
  const bool forks = finder.found && make_fork(&finder.first, &fork);
  count_try(come, trial, forks);
  if (forks) {
    const bool rests = finder.first.consistent.rests[REF_HEXAGON];
    count_try(several, trial, fork.count + rests > 1);
    compare(trial, &q, &fork);
  }
}

static void add(count_t *counts[LIB_SCHEMES][STEPS], const char *what) {
  for (int i = 0; i < LIB_SCHEMES * STEPS; ++i) {
    const char *scheme = lib_scheme_names[i / STEPS];
    counts[i / STEPS][i % STEPS] =
        count_add(scheme, "%-11s %.0e: %s", scheme, dts[i % STEPS], what);
  }
}

static int run(const options_t *options) {
  come = count_add(NULL, "come to h = g = 0");
  several = count_add(NULL, "of them more than one future");
  add(silent, "wrong, all steps OK");
  add(flagged, "wrong, and flagged");
  judge_machines(options, judge);
  return 0;
}

const command_t command_branch = {"branch", "the future taken at h = g = 0",
                                  2000, 3, run};
