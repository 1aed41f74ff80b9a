/// @file
/// Classes (c) and (d): which future a scheme takes at the first h = g = 0 of
/// a motion. The reference follows every future of that point, and standing
/// still, for a short while; the scheme has taken the one it is nearest to.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "classes.h"

enum { WAYS = REF_MAX_WAYS + 1, DTS = 3, RUNS = LIB_SCHEMES * DTS };
static const double dts[DTS] = {1e-4, 3e-5, 1e-5};

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

static double distance(const ref_machine_t *q, ref_state_t a, ref_state_t b) {
  const lib_row_t row = {
      .r = (double)b.r, .v = (double)ref_v(q, b), .w = (double)ref_w(q, b)};
  return class_difference(q, a, &row);
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

static bool make_fork(const ref_machine_t *q, const ref_orbit_t *at,
                      fork_t *fork) {
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
  (void)q;
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
        distance(q, fork->end[i], fork->end[fork->chosen]) > 1e-5) {
      least = e;
      best = i;
    }
  }
  least = class_difference(q, fork->end[best], row);
  double apart = 0;
  for (int i = 0; i <= fork->count; ++i) {
    apart = fmax(apart, distance(q, fork->end[best], fork->end[i]));
  }
  return least < fmax(0.003, 0.3 * apart) ? best : -1;
}

static count_t wrong[RUNS], off[RUNS], resting[RUNS], silent[RUNS];
static count_t drawn = {.what = "come to h = g = 0"};
static count_t open_ = {.what = "of them more than one future"};
static count_t twice = {.what = "of them the slip could go on, rule differs"};
static count_t shrinks = {.what = "other future at 1e-4, right at 1e-5"};
static count_t stays = {.what = "other future at 1e-5"};
static count_t grows = {.what = "other at 1e-5, right at 1e-4"};
static count_t differ = {.what = "moreau 1e-5 and located 1e-5 differ"};
static count_t own = {.what = "moreau 1e-4 and 1e-5 differ"};

static void one(const options_t *options, long index, lib_machine_t *machine,
                const ref_machine_t *q, const fork_t *fork) {
  int taken[RUNS];
  for (int k = 0; k < RUNS; ++k) {
    lib_row_t row;
    machine->dt = dts[k % DTS];
    const lib_scheme_t scheme = (lib_scheme_t)(k / DTS);
    const long others = class_run(&lib_f64, machine, scheme, fork->t, &row);
    if (others < 0) {
      return;
    }
    taken[k] = nearest(q, fork, &row);
    const bool is_wrong = taken[k] >= 0 && taken[k] != fork->chosen;
    const bool rests = is_wrong && taken[k] == fork->count;
    const char *name = lib_scheme_names[scheme];
    count_try(&wrong[k], is_wrong && !rests, options, index, machine, fork->t,
              name);
    count_try(&off[k], taken[k] < 0, options, index, machine, fork->t, name);
    count_try(&resting[k], rests, options, index, machine, fork->t, name);
    count_try(&silent[k], taken[k] != fork->chosen && others == 0, options,
              index, machine, fork->t, name);
  }
  const bool coarse = taken[0] == fork->chosen, fine = taken[2] == fork->chosen;
  count_try(&shrinks, !coarse && fine, options, index, machine, fork->t,
            "moreau");
  count_try(&stays, !fine, options, index, machine, fork->t, "moreau");
  count_try(&grows, coarse && !fine, options, index, machine, fork->t,
            "moreau");
  count_try(&own, taken[0] != taken[2], options, index, machine, fork->t,
            "moreau");
  count_try(&differ, taken[2] != taken[LIB_LOCATED * DTS + 2], options, index,
            machine, fork->t, "moreau");
}

static void prepare_counts(void) {
  static char names[RUNS][4][64];
  for (int k = 0; k < RUNS; ++k) {
    static const char *const kinds[4] = {"another future", "none of them",
                                         "false rest", "wrong, all steps OK"};
    count_t *const counts[4] = {&wrong[k], &off[k], &resting[k], &silent[k]};
    for (int i = 0; i < 4; ++i) {
      snprintf(names[k][i], sizeof names[k][i], "%-11s dt %.0e: %s",
               lib_scheme_names[k / DTS], dts[k % DTS], kinds[i]);
      counts[i]->what = names[k][i];
    }
  }
}

static void print_counts(bool rest_only) {
  count_print(&drawn);
  count_print(&open_);
  count_print(&twice);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < RUNS && (!rest_only || i == 2); ++k) {
      const count_t *const counts[4] = {&wrong[k], &off[k], &resting[k],
                                        &silent[k]};
      count_print(counts[i]);
    }
  }
  if (!rest_only) {
    count_print(&shrinks);
    count_print(&stays);
    count_print(&grows);
    count_print(&own);
    count_print(&differ);
  }
}

static int run(const options_t *options, bool rest_only) {
  prepare_counts();
  for (long i = options->first; i < options->first + options->machines; ++i) {
    draw_t draw = draw_begin(options->seed, (uint64_t)i);
    lib_machine_t machine = draw_machine(&draw, options->range);
    ref_machine_t q;
    finder_t finder = {.found = false};
    ref_orbit_t orbit = class_orbit(&machine, &q, &lib_f64);
    orbit.watch = find;
    orbit.context = &finder;
    orbit.limit = 2000000;
    ref_run(&orbit, options->t_end > 0 ? (real_t)options->t_end : 3);
    options_t quiet_options = *options;
    quiet_options.show = 0;
    fork_t fork = {.count = 0};
    const bool forks = finder.found && make_fork(&q, &finder.first, &fork);
    count_try(&drawn, forks, &quiet_options, i, &machine, 0, "moreau");
    if (forks) {
      const bool rests = finder.first.consistent.rests[REF_HEXAGON];
      const bool slip_ends =
          fork.goes_on && fork.arrived <= REF_SLIP_MINUS &&
          (fork.chosen == fork.count ||
           finder.first.consistent.list[fork.chosen].mode != fork.arrived);
      count_try(&open_, fork.count + rests > 1, &quiet_options, i, &machine, 0,
                "moreau");
      count_try(&twice, slip_ends, &quiet_options, i, &machine, 0, "moreau");
      one(rest_only ? &quiet_options : options, i, &machine, &q, &fork);
    }
  }
  print_counts(rest_only);
  return 0;
}

int class_branch(const options_t *options) { return run(options, false); }

int class_false_rest(const options_t *options) { return run(options, true); }
