/// @file
/// A scheme whose r does not change any more although the reference, started
/// from its state, moves, and that does not say so, or says so where the
/// reference rests.
#include <math.h>

#include "classes.h"

static const runs_t runs = {2, 2, 1, {1e-4, 1e-5}, ""};

enum { STILL = 500 };

static count_t *stands[RUNS], *alarms[RUNS];

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

static void begin(const class_t *class) {
  (void)class;
  count_runs(stands, &runs, "stands still in silence");
  count_runs(alarms, &runs, "at rest, and told to move");
}

// Moving is more than 50 roundings of r in the time that the scheme stands
// still, resting is less than one in a second.
static void judge(trial_t *trial) {
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

const class_t class_standing = {.name = "standing",
                                .about = "standing still",
                                .machines = 2000,
                                .t_end = 1,
                                .begin = begin,
                                .judge = judge};
