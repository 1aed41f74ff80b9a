// The simulator as the module of a web page, which imports nothing but numbers
// from text and into it (libc.mjs). The page writes a set-up, begins, steps,
// and reads rows. Instances share nothing, so a second one of the same module
// that is made a copy of the first looks ahead into its futures.
#include "motion.h"

#include <string.h>

#include "module.h"

// The module contains no other scheme.
#define SCHEME MOTION_MOREAU

// A set-up is a scene whose parameters and start the page alters. The angle is
// drawn, so it is integrated here in every scene; nothing depends on it.
static tf_scene_t setup;
static bool with_angle; // as the scene has it
static uint32_t seed;

// The motion, of the set-up with which it began.
static tf_scene_t scene;
static uint32_t scene_seed;
static motion_t motion;
static const tf_machine_t *const machine = &motion.machine.machine;
static tf_input_t applied; // in the last step
static double table;       // angle of the turntable [rad]
static double force, torque;
static int offender;
static bool begun;

// The columns of a row, in the order in which core.mjs names them, and the
// value of each at the present instant; `at` is what motion_row returns. The
// page views a row as a Float64Array. The present one is also a snapshot,
// because all that the motion goes on from is in it.
#define ROW(X)                       \
  X(T, at.t)                         \
  X(R, at.r)                         \
  X(V, at.v)                         \
  X(W, at.omega)                     \
  X(H, at.h)                         \
  X(G, at.g)                         \
  X(F, at.F)                         \
  X(M, at.M)                         \
  X(MODE, at.mode)                   \
  X(CHOICES, at.choices)             \
  X(SET, at.set)                     \
  X(STATUS, at.status)               \
  X(TICK, (double)motion.state.tick) \
  X(PHI, at.phi)                     \
  X(TABLE, table)                    \
  X(OMEGA0, applied.omega0)          \
  X(R0, applied.r0)                  \
  X(FORCE, applied.force)            \
  X(TORQUE, applied.torque)          \
  X(ENERGY, tf_energy(machine, &motion.state, applied.r0))
#define ROW_NUMBER(name, value) ROW_##name,
#define ROW_VALUE(name, value) value,
enum { ROW(ROW_NUMBER) ROW_COLUMNS };

static double row[ROW_COLUMNS];

// Steps at which the mode or the set of consistent modes changed.
#define CHANGES 1024
#define CHANGE_COLUMNS 5
static double change[CHANGES][CHANGE_COLUMNS];
static uint32_t changes;

// Numbers of the set-up behind the parameters.
enum {
  SETUP_LAW = TF_PARAMETERS,
  SETUP_RULE,
  SETUP_REST,
  SETUP_R,
  SETUP_OMEGA,
  SETUP_H,
  SETUP_V,
  SETUP_V_IS_GIVEN,
  SETUP_SEED,
  SETUP_NUMBERS
};

uint32_t EXPORT(scenes)(void) { return TF_SCENES; }

// The number behind those of the core is that of a file.
static const tf_scene_t *scene_at(uint32_t number) {
  if (number < TF_SCENES) return tf_scenes[number];
  return number == TF_SCENES ? own_scene() : NULL;
}

const char *EXPORT(scene_name)(uint32_t number) {
  const tf_scene_t *at = scene_at(number);
  return at != NULL ? at->name : "";
}

const char *EXPORT(scene_shows)(uint32_t number) {
  const tf_scene_t *at = scene_at(number);
  return at != NULL ? at->shows : "";
}

// The set-up is that of a scene. Returns: how many numbers it has; 0 where
// there is no such scene.
uint32_t EXPORT(load)(uint32_t number) {
  const tf_scene_t *at = scene_at(number);
  if (at == NULL) return 0;
  setup = *at;
  with_angle = setup.params.with_angle;
  setup.params.with_angle = true;
  seed = 0;
  return SETUP_NUMBERS;
}

// A number that is real, NULL of another one.
static tf_real_t *real_at(uint32_t number) {
  if (number < TF_PARAMETERS)
    return (tf_real_t *)(void *)((char *)&setup.params +
                                 tf_parameter_ranges[number].offset);
  tf_real_t *const start[] = {&setup.r, &setup.omega, &setup.h, &setup.v};
  return number >= SETUP_R && number <= SETUP_V ? start[number - SETUP_R]
                                                : NULL;
}

double EXPORT(get)(uint32_t number) {
  const tf_real_t *real = real_at(number);
  const uint32_t whole[] = {[SETUP_LAW] = setup.params.law,
                            [SETUP_RULE] = setup.params.rule,
                            [SETUP_REST] = setup.params.rest,
                            [SETUP_V_IS_GIVEN] = setup.v_is_given,
                            [SETUP_SEED] = seed};
  if (real != NULL) return *real;
  return number < SETUP_NUMBERS ? whole[number] : 0;
}

// Any number is taken: ranges are begin's. Returns: whether there is such a
// number in a set-up and, if it is one of a list, in the list.
bool EXPORT(set)(uint32_t number, double value) {
  static const double below[SETUP_NUMBERS] = {[SETUP_LAW] = TF_TYRE_LAWS,
                                              [SETUP_RULE] = TF_RULES,
                                              [SETUP_REST] = TF_REST_LAWS,
                                              [SETUP_SEED] = 0x1p32};
  tf_real_t *real = real_at(number);
  if (real != NULL) {
    *real = value;
    if (number == SETUP_H || number == SETUP_V)
      setup.v_is_given = number == SETUP_V;
    return true;
  }
  if (number >= SETUP_NUMBERS || !(value >= 0 && value < below[number]))
    return false;
  const uint32_t whole = (uint32_t)value;
  if ((double)whole < value) return false;
  if (number == SETUP_LAW) setup.params.law = (tf_tyre_law_t)whole;
  if (number == SETUP_RULE) setup.params.rule = (tf_rule_t)whole;
  if (number == SETUP_REST) setup.params.rest = (tf_rest_law_t)whole;
  if (number == SETUP_SEED) seed = whole;
  return true;
}

// The set-up as a file.
const char *EXPORT(scene_print)(void) {
  tf_scene_t own = setup;
  own.params.with_angle = with_angle;
  return scene_as_file(&own);
}

// Prepares the machine and starts. Returns: a tf_status_t. Where it is refused
// the motion before goes on; after TF_BAD_PARAMETER `offending` is the number
// of the parameter.
int32_t EXPORT(begin)(void) {
  motion_t next;
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
  begun = true;
  return TF_OK;
}

int32_t EXPORT(offending)(void) { return offender; }

// Whether the law of rest matters: only where stick carries a moment.
bool EXPORT(uses_rest)(void) {
  return begun && machine->contact.stick_kappa > 0;
}

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
  tf_status_t status = begun ? TF_OK : TF_BAD_STATE;
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
  if (mode >= TF_MODES || !begun) return TF_BAD_PARAMETER;
  const tf_report_t before = motion.report;
  const tf_input_t input = next_input();
  changes = 0;
  const tf_status_t status = motion_take(&motion, SCHEME, &input, mode);
  if (status >= 0) note_step(&input, &before);
  return status;
}

double *EXPORT(look)(void) {
  const motion_row_t at = motion_row(&motion);
  const double now[] = {ROW(ROW_VALUE)};
  memcpy(row, now, sizeof row);
  return row;
}

// The motion is at the instant of the row that the page has written where
// `look` keeps it, one that `look` gave for this set-up.
void EXPORT(restore)(void) {
  motion.state = (tf_state_t){.r = row[ROW_R],
                              .v = row[ROW_V],
                              .w = row[ROW_W],
                              .phi = row[ROW_PHI],
                              .tick = (uint64_t)row[ROW_TICK],
                              .seed = scene_seed,
                              .mode = (uint8_t)row[ROW_MODE]};
  motion.report =
      (tf_report_t){.mode = (uint8_t)row[ROW_MODE],
                    .set = (uint8_t)row[ROW_SET],
                    .choices = (uint8_t)row[ROW_CHOICES],
                    .force = {row[ROW_F], row[ROW_M]},
                    .slip = {row[ROW_H], row[ROW_G]},
                    .status = (tf_status_t)(int32_t)row[ROW_STATUS]};
  applied = tf_scene_input(&scene, machine,
                           motion.state.tick); // for its alpha
  applied.omega0 = row[ROW_OMEGA0];
  applied.r0 = row[ROW_R0];
  applied.force = row[ROW_FORCE];
  applied.torque = row[ROW_TORQUE];
  table = row[ROW_TABLE];
}

// tick, mode before, mode, set and choices of each change in the last `step`.
const double *EXPORT(changed)(void) { return change[0]; }

uint32_t EXPORT(count_changes)(void) { return changes; }

const tf_machine_t *machine_begun(void) { return begun ? machine : 0; }

tf_input_t input_applied(void) { return applied; }
