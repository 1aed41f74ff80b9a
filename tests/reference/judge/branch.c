/// @file
/// Classes (c) and (d): which future a scheme takes at the first h = g = 0 of
/// a motion. The reference follows every future of that point, and standing
/// still, for a short while; the scheme has taken the one it is nearest to.
#include <math.h>

#include "classes.h"

enum { WAYS = REF_MAX_WAYS + 1, DTS = 3 };
static const runs_t runs = {1, DTS, {1e-4, 3e-5, 1e-5}, "dt ", NULL};

// The consistent modes at the first h = g = 0, a little later.
typedef struct {
  double t;                      ///< when they are compared [s]
  ref_state_t codim2, end[WAYS]; ///< [count]: standing still
  int count, chosen;             ///< of consistent; count where the wheel rests
  ref_mode_t arrived;
  bool goes_on; ///< slip arrives, and slips on the same side exist
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
  fork->codim2 = at->at;
  fork->count = at->consistent.count;
  fork->arrived = at->arrived;
  fork->goes_on = false;
  fork->chosen = at->chosen == REF_REST ? fork->count : at->chosen;
  for (int i = 0; i < fork->count; ++i) {
    ref_orbit_t way = *at;
    way.watch = NULL;
    way.x = at->at;
    ref_leave(&way, i);
    ref_run(&way, (real_t)fork->t);
    fork->end[i] = way.x;
    fork->goes_on =
        fork->goes_on || (at->consistent.list[i].mode == at->arrived);
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

static count_t *wrong[RUNS], *off[RUNS], *resting[RUNS], *silent[RUNS];
static count_t *drawn, *open_, *twice;
static count_t *shrinks, *stays, *grows, *differ, *own;

static void begin_rest(void) {
  drawn = count_add(false, "come to h = g = 0");
  open_ = count_add(false, "of them more than one future");
  twice = count_add(false, "of them the slip could go on, rule differs");
}

static void begin_false_rest(void) {
  begin_rest();
  count_runs(resting, &runs, false, "false rest");
}

static void begin(void) {
  begin_rest();
  count_runs(wrong, &runs, true, "another future");
  count_runs(off, &runs, true, "none of them");
  count_runs(resting, &runs, true, "false rest");
  count_runs(silent, &runs, true, "wrong, all steps OK");
  shrinks = count_add(true, "other future at 1e-4, right at 1e-5");
  stays = count_add(true, "other future at 1e-5");
  grows = count_add(true, "other at 1e-5, right at 1e-4");
  own = count_add(true, "moreau 1e-4 and 1e-5 differ");
  differ = count_add(true, "moreau 1e-5 and located 1e-5 differ");
}

static void compare(trial_t *trial, const ref_machine_t *q,
                    const fork_t *fork) {
  int taken[RUNS] = {0};
  trial->t_end = fork->t;
  for (int k = 0; k < runs_count(&runs); ++k) {
    lib_row_t row;
    const long others = trial_run(trial, &runs, k, &row);
    if (others < 0) {
      return;
    }
    taken[k] = nearest(q, fork, &row);
    const bool is_wrong = taken[k] >= 0 && taken[k] != fork->chosen;
    const bool rests = is_wrong && taken[k] == fork->count;
    count_try(wrong[k], trial, is_wrong && !rests);
    count_try(off[k], trial, taken[k] < 0);
    count_try(resting[k], trial, rests);
    count_try(silent[k], trial, taken[k] != fork->chosen && others == 0);
  }
  const bool coarse = taken[0] == fork->chosen, fine = taken[2] == fork->chosen;
  count_try(shrinks, trial, !coarse && fine);
  count_try(stays, trial, !fine);
  count_try(grows, trial, coarse && !fine);
  count_try(own, trial, taken[0] != taken[2]);
  count_try(differ, trial, taken[2] != taken[LIB_LOCATED * DTS + 2]);
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
  count_try(drawn, trial, forks);
  if (!forks) {
    return;
  }
  const bool rests = finder.first.consistent.rests[REF_HEXAGON];
  const bool slip_ends =
      fork.goes_on && fork.arrived <= REF_SLIP_MINUS &&
      (fork.chosen == fork.count ||
       finder.first.consistent.list[fork.chosen].mode != fork.arrived);
  count_try(open_, trial, fork.count + rests > 1);
  count_try(twice, trial, slip_ends);
  compare(trial, &q, &fork);
}

const class_t class_branch = {
    "branch", "(d) the future taken at h = g = 0", 2000, 3, begin, judge, NULL};
const class_t class_false_rest = {"false-rest",
                                  "(c) rest where the motion goes on",
                                  2000,
                                  3,
                                  begin_false_rest,
                                  judge,
                                  NULL};
