// The simulator as the module of a web page, which imports nothing but numbers
// from text and into it (libc.mjs). The page writes a set-up, begins, steps,
// and reads rows. Instances share nothing, so a second one of the same module
// that is made a copy of the first looks ahead into its futures.
#include "motion.h"

#include <string.h>

#include "module.h"

// The module contains no other scheme.
#define SCHEME MOTION_MOREAU

// The motion, of the set-up with which it began.
static tf_scene_t scene;
static uint32_t scene_seed;
static motion_t motion;
static const tf_machine_t *const machine = &motion.machine.machine;
static tf_input_t applied; // in the last step
static double table;       // angle of the turntable [rad]
static double force, torque;
static int offender;

// The columns of a row, those of CSV first, and the value of each at the
// present instant. The page views a row as a Float64Array. The present one is
// also a snapshot, because all that the motion goes on from is in it.
#define ROW(X)                             \
  EACH_COLUMN(X, X, COLUMN_NONE)           \
  X(mode, "", report->mode)                \
  X(choices, "", report->choices)          \
  X(set, "", report->set)                  \
  X(status, "", report->status)            \
  X(tick, "", (double)state->tick)         \
  EACH_COLUMN(COLUMN_NONE, COLUMN_NONE, X) \
  X(table, "rad", table)                   \
  X(omega0, "rad/s", applied.omega0)       \
  X(r0, "m", applied.r0)                   \
  X(force, "N", applied.force)             \
  X(torque, "N m", applied.torque)         \
  X(energy, "J", tf_energy(machine, state, applied.r0))
#define ROW_NUMBER(name, unit, value) ROW_##name,
#define ROW_VALUE(name, unit, value) value,
enum { ROW(ROW_NUMBER) ROW_COLUMNS };

static double row[ROW_COLUMNS];

// Steps at which the mode or the set of consistent modes changed.
#define CHANGES 1024
#define CHANGE_COLUMNS 5
static double change[CHANGES][CHANGE_COLUMNS];
static uint32_t changes;

// Prepares the machine and starts. Returns: a tf_status_t. Where it is refused
// the motion before goes on; after TF_BAD_PARAMETER `offending` is the number
// of the parameter.
int32_t EXPORT(begin)(void) {
  motion_t next;
  uint32_t seed = 0;
  tf_scene_t setup = page_setup(&seed);
  // It is drawn in every scene, and nothing depends on it.
  setup.params.with_angle = true;
  const motion_start_t start = motion_start(&setup, seed);
  offender = TF_PARAMETERS;
  tf_status_t status = motion_prepare(&next, SCHEME, &setup.params, &offender);
  if (status != TF_OK) return status;
  const tf_input_t input = tf_scene_input(&setup, &next.machine.machine, 0);
  status = motion_begin(&next, SCHEME, &start, &input);
  if (status != TF_OK) return status;
  scene = setup;
  scene_seed = seed;
  motion = next;
  applied = input;
  table = force = torque = 0;
  changes = 0;
  return TF_OK;
}

int32_t EXPORT(offending)(void) { return offender; }

// Whether the law of rest matters: only where stick carries a moment.
bool EXPORT(uses_rest)(void) { return machine->contact.stick_kappa > 0; }

// A force and a torque beside those of the scene, from the next step on.
void EXPORT(by_hand)(double new_force, double new_torque) {
  force = new_force;
  torque = new_torque;
}

static tf_input_t next_input(void) {
  tf_input_t input = tf_scene_input(&scene, machine, motion.state.tick + 1);
  input.force += force;
  input.torque += torque;
  return input;
}

static void note_change(unsigned mode, unsigned before) {
  if ((motion.report.mode == mode && motion.report.set == before) ||
      changes == CHANGES)
    return;
  double *to = change[changes++];
  to[0] = (double)motion.state.tick;
  to[1] = mode;
  to[2] = motion.report.mode;
  to[3] = motion.report.set;
  to[4] = motion.report.choices;
}

static void note_step(const tf_input_t *input, const tf_report_t *before) {
  applied = *input;
  table += input->omega0 * machine->dt;
  note_change(before->mode, before->set);
}

// Returns: the status of the last step; if that is < 0 it was refused, and no
// further one was taken. Changes are those of this call alone.
int32_t EXPORT(step)(uint32_t steps) {
  tf_status_t status = TF_OK;
  changes = 0;
  for (; steps > 0 && status >= 0; steps--) {
    const tf_report_t before = motion.report;
    const tf_input_t input = next_input();
    status = motion_step(&motion, SCHEME, &input);
    if (status >= 0) note_step(&input, &before);
  }
  return status;
}

// One step into a mode that it may take; the rule goes on from there.
// Returns: as step; of what is < 0 nothing is kept.
int32_t EXPORT(take)(uint32_t mode) {
  if (mode >= TF_MODES) return TF_BAD_PARAMETER;
  const tf_report_t before = motion.report;
  const tf_input_t input = next_input();
  changes = 0;
  const tf_status_t status = motion_take(&motion, SCHEME, &input, mode);
  if (status >= 0) note_step(&input, &before);
  return status;
}

// The names of the columns, each with a comma behind it.
const char *EXPORT(columns)(void) { return ROW(COLUMN_NAME); }

double *EXPORT(look)(void) {
  const tf_state_t *state = &motion.state;
  const tf_report_t *report = &motion.report;
  const double t = motion_row(&motion).t;
  const double now[] = {ROW(ROW_VALUE)};
  memcpy(row, now, sizeof row);
  return row;
}

// The motion is at the instant of the row that the page has written where
// `look` keeps it, one that `look` gave for this set-up.
void EXPORT(restore)(void) {
  motion.state = (tf_state_t){.r = row[ROW_r],
                              .v = row[ROW_v],
                              .w = row[ROW_omega],
                              .phi = row[ROW_phi],
                              .tick = (uint64_t)row[ROW_tick],
                              .seed = scene_seed,
                              .mode = (uint8_t)row[ROW_mode]};
  motion.report =
      (tf_report_t){.mode = (uint8_t)row[ROW_mode],
                    .set = (uint8_t)row[ROW_set],
                    .choices = (uint8_t)row[ROW_choices],
                    .force = {row[ROW_F], row[ROW_M]},
                    .slip = {row[ROW_h], row[ROW_g]},
                    .status = (tf_status_t)(int32_t)row[ROW_status]};
  applied = tf_scene_input(&scene, machine,
                           motion.state.tick); // for its alpha
  applied.omega0 = row[ROW_omega0];
  applied.r0 = row[ROW_r0];
  applied.force = row[ROW_force];
  applied.torque = row[ROW_torque];
  table = row[ROW_table];
}

// tick, mode before, mode, set and choices of each change in the last `step`.
const double *EXPORT(changed)(void) { return change[0]; }

uint32_t EXPORT(count_changes)(void) { return changes; }

// The surface h = 0: which region a point lies in, a map of them over
// (r, omega), what friction does to a slip there, and the two-folds.
#define MAP_MOST 40000
#define NO_REGION TF_REGIONS // the law has no surface, or the point has no v
static uint8_t map[MAP_MOST];
static double two_fold[TF_TWO_FOLDS][4];

// Returns: whether the surface has a point there.
static bool surface_at(tf_real_t r, tf_real_t w, tf_surface_t *at) {
  tf_real_t v = 0;
  return tf_speed_for_slip(machine, r, w, applied.omega0, 0, &v) == TF_OK &&
         tf_surface_at(machine, &applied, r, v, w, at) == TF_OK;
}

static tf_real_t part(double from, double to, uint32_t i, uint32_t count) {
  return from + (to - from) * (((double)i + 0.5) / (double)count);
}

// Regions at the centres of columns x rows cells, row by row from w0 on.
// Returns: 0 where that is more than there is room for.
const uint8_t *EXPORT(regions)(double r0, double r1, uint32_t columns,
                               double w0, double w1, uint32_t rows) {
  if (columns * rows > MAP_MOST) return 0;
  for (uint32_t j = 0; j < rows; j++) {
    for (uint32_t i = 0; i < columns; i++) {
      tf_surface_t at;
      const bool is_there =
          surface_at(part(r0, r1, i, columns), part(w0, w1, j, rows), &at);
      map[j * columns + i] = is_there ? at.region : NO_REGION;
    }
  }
  return map;
}

// By how much 1 N of friction brakes the slip of a wheel that rolls forwards,
// [m/s^2]; 0 where there is no such point.
double EXPORT(delassus_at)(double r, double w) {
  tf_surface_t at;
  return surface_at(r, w, &at) ? at.delassus : 0;
}

// Returns: how many there are.
uint32_t EXPORT(find_two_folds)(void) {
  tf_surface_point_t points[TF_TWO_FOLDS];
  int count = 0;
  if (tf_two_folds(machine, &applied, points, &count, 0) != TF_OK) return 0;
  for (int i = 0; i < count; i++) {
    two_fold[i][0] = points[i].r;
    two_fold[i][1] = points[i].v;
    two_fold[i][2] = points[i].w;
    two_fold[i][3] = points[i].g;
  }
  return (uint32_t)count;
}

// r, v, omega and g of each of them.
const double *EXPORT(two_folds)(void) { return two_fold[0]; }
