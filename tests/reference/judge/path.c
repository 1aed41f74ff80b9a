/// @file
/// Class (d), second half: motions whose reference never stands at h = g = 0,
/// so that their future is unique: ends that are far off, and near misses,
/// which are far off at a long step only.
#include "classes.h"

static const runs_t runs = {1, 3, {1e-4, 3e-5, 1e-5}, "dt ", NULL};
static count_t *alone, *off[RUNS], *shrinks, *stays;

static void begin(void) {
  alone = count_add(false, "judged: one future, reference sure");
  count_runs(off, &runs, true, "5 % off, all OK");
  shrinks = count_add(false, "moreau off at 1e-4, right at 1e-5");
  stays = count_add(false, "moreau off at 1e-5");
}

// The end of the reference; false where it is not unique or not sure.
static bool sure(const trial_t *trial, ref_machine_t *q, ref_state_t *x) {
  ref_orbit_t orbit = class_orbit(&trial->machine, q, &lib_f64);
  if (orbit.consistent.count > 1) {
    return false;
  }
  orbit.limit = 2000000;
  ref_stop_t coarse;
  const double doubt = class_doubt(&orbit, (real_t)trial->t_end, &coarse);
  *x = orbit.x;
  return orbit.stop == REF_REACHED && orbit.codim2_count == 0 && doubt < 1e-4;
}

static void judge(trial_t *trial) {
  ref_machine_t q;
  ref_state_t x;
  const bool judged = sure(trial, &q, &x);
  count_try(alone, trial, judged);
  if (!judged) {
    return;
  }
  bool is_off[RUNS] = {false};
  for (int k = 0; k < runs_count(&runs); ++k) {
    lib_row_t row;
    const long others = trial_run(trial, &runs, k, &row);
    is_off[k] = class_difference(&q, x, &row) > 0.05;
    count_try(off[k], trial, is_off[k] && others == 0);
  }
  count_try(shrinks, trial, is_off[0] && !is_off[2]);
  count_try(stays, trial, is_off[2]);
}

const class_t class_path = {
    "path", "(d) ends of motions with one future", 2000, 0.9, begin, judge,
    NULL};
