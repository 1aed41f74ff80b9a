/// @file
/// Classes of ends: motions whose reference never stands at h = g = 0, so that
/// their future is unique, and runs that end elsewhere, in silence or with a
/// word. A class says who is drawn and what is far off.
#include <stdio.h>

#include "classes.h"

enum { GROUPS = 2 };
struct ends {
  int groups;
  runs_t runs[GROUPS];
  const char *silent, *told;
  double off;                  ///< class_difference that is wrong
  int (*draw)(trial_t *trial); ///< changes the machine; returns its group
};

static count_t *judged[GROUPS], *silent[GROUPS][RUNS], *told[GROUPS][RUNS];

static void begin(const class_t *class) {
  const struct ends *ends = class->ends;
  for (int i = 0; i < ends->groups; ++i) {
    const runs_t *runs = &ends->runs[i];
    char what[96];
    snprintf(what, sizeof what, "%sjudged: one future, reference sure",
             runs->group);
    judged[i] = count_add(false, what);
    count_runs(silent[i], runs, ends->silent);
    count_runs(told[i], runs, ends->told);
  }
}

// The end of the reference; false where another future exists, where the end at
// a coarser tolerance is another, or where the motion is too fast for a step.
static bool sure(const trial_t *trial, ref_machine_t *q, ref_state_t *x) {
  const real_t end = (real_t)trial->t_end;
  ref_orbit_t orbit = class_orbit(&trial->machine, q, &lib_f64);
  orbit.limit = 300000;
  ref_orbit_t coarse = orbit;
  coarse.tolerance = 1e-8L;
  const bool one = orbit.consistent.count <= 1 && q->k2 / q->m < 1e6L;
  if (!one || ref_run(&orbit, end) != REF_REACHED || orbit.codim2_count > 0 ||
      ref_run(&coarse, end) != REF_REACHED) {
    return false;
  }
  *x = orbit.x;
  return class_distance(q, orbit.x, coarse.x) < 1e-3;
}

static void judge(trial_t *trial) {
  const struct ends *ends = trial->class->ends;
  const int group = ends->draw(trial);
  const runs_t *runs = &ends->runs[group];
  ref_machine_t q;
  ref_state_t x;
  const bool is_sure = sure(trial, &q, &x);
  count_try(judged[group], trial, is_sure);
  for (int k = 0; is_sure && k < runs_count(runs); ++k) {
    lib_row_t row;
    const long others = trial_run(trial, runs, k, &row);
    const bool off = class_difference(&q, x, &row) > ends->off;
    count_try(silent[group][k], trial, off && others == 0);
    count_try(told[group][k], trial, off && others != 0);
  }
}

// On every other machine inputs move.
static int draw_path(trial_t *trial) {
  const int moves = trial->index % 2 != 0;
  if (moves) {
    draw_drive(&trial->draw, &trial->machine, trial->t_end, false);
  }
  return moves;
}

static int draw_impulses(trial_t *trial) {
  trial->draw = draw_begin(trial->options->seed, (uint64_t)trial->index);
  trial->machine = draw_machine(&trial->draw, true);
  return 0;
}

static const struct ends path = {2,
                                 {{1, 3, 10, {1e-3, 1e-4, 1e-5}, "held, "},
                                  {1, 3, 10, {1e-3, 1e-4, 1e-5}, "moving, "}},
                                 "5 % off, all OK",
                                 "5 % off, and told",
                                 0.05,
                                 draw_path},
                         impulses = {1,
                                     {{1, 2, 1, {1e-4, 1e-5}, ""}},
                                     "10 % off, all OK",
                                     "10 % off, some not OK or refused",
                                     0.1,
                                     draw_impulses};

#define CLASS(of, words, end)                                        \
  {                                                                  \
    .name = #of, .about = (words), .machines = 2000, .t_end = (end), \
    .begin = begin, .judge = judge, .ends = &(of)                    \
  }
const class_t class_path = CLASS(path, "ends of motions with one future", 0.9);
const class_t class_impulses =
    CLASS(impulses, "impulses shorter than the step", 0.1);
