/// @file
/// Class (h): a scheme whose r does not change any more although the reference,
/// started from its state, moves, and that does not say so, or says so where
/// the reference rests; and class (e): a stick that tends to h = g = 0 for
/// ever, restarted by rounding.
#include <math.h>

#include "classes.h"

static const runs_t runs = {2, 2, {1e-4, 1e-5}, "", NULL};
static const runs_t rest_runs = {2, 2, {1e-3, 1e-4}, "", NULL};

enum { STILL = 500 };

static count_t *stands[RUNS], *alarms[RUNS], *leaves[RUNS], *tends;

// Where a run of one scheme stood still.
typedef struct {
  bool silent; // r the same in STILL steps without a word
  bool told;   // r the same in STILL steps, and the scheme said something
  lib_row_t row, told_at;
} stand_t;

// Steps until r has not changed in STILL steps of which the scheme has not said
// that something is wrong.
static stand_t stops(const lib_table_t *real, const lib_machine_t *machine,
                     lib_scheme_t scheme, double end) {
  lib_t lib;
  stand_t stand = {.silent = false};
  long still = 0, said = 0;
  if (real->open(&lib, machine, scheme, &stand.row) < 0) {
    return stand;
  }
  const long steps = lround(end / machine->dt);
  for (long i = 0; i < steps && !stand.silent; ++i) {
    const double r = stand.row.r;
    const int status = real->step(&lib, &stand.row);
    if (status < 0) {
      return stand;
    }
    still = r != stand.row.r ? 0 : still + 1;
    said = r != stand.row.r ? 0 : said + (status != 0);
    stand.silent = still - said >= STILL;
    if (!stand.told && still >= STILL && said > 0) {
      stand.told = true;
      stand.told_at = stand.row;
    }
  }
  return stand;
}

// By how many roundings of it the reference moves r within a time; -1 where a
// law of rest would hold it, which counts as neither.
static double moves_on(const lib_machine_t *machine, const lib_table_t *real,
                       const lib_row_t *row, real_t time) {
  const ref_machine_t q = draw_reference(machine, real);
  ref_state_t x = ref_state(&q, (real_t)row->r, (real_t)row->v, (real_t)row->w);
  const real_t coarse = 64 * (real_t)real->epsilon;
  const ref_slip_t slip = ref_slip(&q, x);
  const real_t size = fabsl(q.omega0) * (fabsl(x.r) + q.d) + fabsl(x.p);
  if (fabsl(slip.h) < coarse * size) {
    x = ref_on_surface(&q, x);
  }
  if (hypotl(slip.h, slip.g) < coarse * size) {
    x.p = 0;
    x.z = 0;
  }
  ref_orbit_t orbit = {.tolerance = 1e-9L, .limit = 200000};
  ref_begin(&orbit, &q, x, (ref_mode_t)row->mode);
  if (orbit.consistent.rests[REF_HEXAGON]) {
    return -1;
  }
  ref_run(&orbit, time);
  return (double)(fabsl(orbit.x.r - row->r) /
                  ((real_t)real->epsilon * fabsl(x.r)));
}

static void begin_standing(void) {
  count_runs(stands, &runs, true, "stands still in silence");
  count_runs(alarms, &runs, true, "at rest, and told to move");
}

// Moving is more than 50 roundings of r in the time that the scheme stands
// still, resting is less than one in a second.
static void judge_standing(trial_t *trial) {
  lib_machine_t *machine = &trial->machine;
  if (draw_uniform(&trial->draw, 0, 2) < 1) { // as after a pinned wheel
    machine->omega = machine->omega0;
    machine->v = 0;
    machine->on_surface = false;
  }
  for (int k = 0; k < runs_count(&runs); ++k) {
    const run_t run = runs_at(&runs, k);
    machine->dt = run.dt;
    const stand_t stand = stops(run.real, machine, run.scheme, trial->t_end);
    const real_t time = STILL * (real_t)machine->dt;
    count_try(
        stands[k], trial,
        stand.silent && moves_on(machine, run.real, &stand.row, time) > 50);
    count_try(
        alarms[k], trial,
        stand.told && fabs(moves_on(machine, run.real, &stand.told_at, 1)) < 1);
  }
}

// A stick near its end: slow, on h = 0, and apparently without end.
static bool settles(const lib_machine_t *machine, ref_machine_t *q,
                    ref_state_t *near) {
  ref_orbit_t orbit = class_orbit(machine, q, &lib_f64);
  orbit.limit = 300000;
  bool close = false;
  for (int i = 1; i <= 300 && orbit.stop == REF_REACHED; ++i) {
    ref_run(&orbit, (real_t)i / 10);
    const bool sticks =
        orbit.mode == REF_STICK_PLUS || orbit.mode == REF_STICK_MINUS;
    const real_t g = fabsl(ref_slip(q, orbit.x).g);
    if (!sticks || (close && g > 1e-4L)) {
      close = false;
    } else if (!close && g < 1e-5L) {
      close = true;
      *near = orbit.x;
    } else if (close && g < 1e-12L) {
      return true;
    }
  }
  return false;
}

// Whether the reference, started as the schemes are, rests for all the time.
static bool stays(const lib_machine_t *machine, double end) {
  ref_machine_t q;
  ref_orbit_t orbit = class_orbit(machine, &q, &lib_f64);
  orbit.limit = 300000;
  ref_run(&orbit, (real_t)end);
  return orbit.stop == REF_REACHED && orbit.codim2_count == 0 &&
         fabsl(orbit.x.r - machine->r) < 1e-4L * (fabsl(orbit.x.r) + 1);
}

static void begin_rounding(void) {
  tends = count_add(false, "stick tends to h = g = 0 for ever");
  count_runs(leaves, &rest_runs, true, "leaves the rest");
}

static void judge_rounding(trial_t *trial) {
  lib_machine_t *machine = &trial->machine;
  ref_machine_t q;
  ref_state_t near = {.r = 0};
  const bool rests = settles(machine, &q, &near);
  if (rests) {
    machine->r = (double)near.r;
    machine->v = (double)ref_v(&q, near);
    machine->omega = (double)ref_w(&q, near);
    machine->on_surface = fabsl(q.sine) > 1e-3L;
  }
  const bool counts = rests && stays(machine, trial->t_end);
  count_try(tends, trial, counts);
  for (int k = 0; counts && k < runs_count(&rest_runs); ++k) {
    lib_row_t row;
    const long others = trial_run(trial, &rest_runs, k, &row);
    const bool left = fabs(row.r - machine->r) > 1e-3 * (fabs(machine->r) + 1);
    count_try(leaves[k], trial, others >= 0 && left);
  }
}

const class_t class_standing = {"standing",     "(h) standing still", 2000, 1,
                                begin_standing, judge_standing,       NULL};
const class_t class_rounding = {"rounding",
                                "(e) rest that rounding ends",
                                2000,
                                20,
                                begin_rounding,
                                judge_rounding,
                                NULL};
