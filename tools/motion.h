/// @file
/// A motion on a host: machine, state and report, and the schemes that advance
/// them as functions of one signature. The command line, the FMU, the page and
/// the Python package use it, beside the library or the two files.
#ifndef TWOFOLD_MOTION_H
#define TWOFOLD_MOTION_H

#include "columns.h"
#include "twofold.h"

/// All that the future depends on, the inputs apart. No pointers: a copy is a
/// snapshot. Schemes other than compensated leave what it adds at 0.
typedef struct {
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t low;
  tf_report_t report; ///< of the last step, or of the start
} motion_t;

typedef enum {
  MOTION_MOREAU,
  MOTION_LOCATED,
  MOTION_COMPENSATED,
  MOTION_SCHEMES
} motion_scheme_t;

static inline const char *motion_scheme_name(unsigned scheme) {
  static const char *const names[] = {"moreau", "located", "compensated"};
  return scheme < MOTION_SCHEMES ? names[scheme] : "unknown scheme";
}

/// Whether a scheme takes a law; the two others take all.
#define MOTION_LOCATED_LAWS "jump, coulomb or none"
static inline bool motion_takes_law(motion_scheme_t scheme, tf_tyre_law_t law) {
  return scheme != MOTION_LOCATED || law == TF_TYRE_JUMP ||
         law == TF_TYRE_COULOMB || law == TF_TYRE_NONE;
}

/// Prepares the machine. Codes and offender: tf_prepare.
static inline tf_status_t motion_prepare(motion_t *motion,
                                         motion_scheme_t scheme,
                                         const tf_params_t *params,
                                         int *offender) {
  return scheme == MOTION_COMPENSATED
             ? tf_prepare_compensated(&motion->machine, params, offender)
             : tf_prepare(&motion->machine.machine, params, offender);
}

/// A start: the state at tick 0, whose v follows from h if `from_h`. mode holds
/// the one preferred, or TF_NO_MODE.
typedef struct {
  tf_state_t state;
  tf_real_t h;
  bool from_h;
} motion_start_t;

/// The start of a scene.
static inline motion_start_t motion_start(const tf_scene_t *scene,
                                          uint32_t seed) {
  const motion_start_t own = {.state = {.r = scene->r,
                                        .v = scene->v,
                                        .w = scene->omega,
                                        .seed = seed,
                                        .mode = TF_NO_MODE},
                              .h = scene->h,
                              .from_h = !scene->v_is_given};
  return own;
}

/// Begins a motion whose machine is prepared. input: at tick 0.
/// Returns: TF_OK; TF_BAD_STATE, as tf_begin: the motion is untouched.
static inline tf_status_t motion_begin(motion_t *motion, motion_scheme_t scheme,
                                       const motion_start_t *start,
                                       const tf_input_t *input) {
  const tf_machine_t *k = &motion->machine.machine;
  tf_state_t x = start->state;
  tf_compensation_t low = {0, 0, 0, 0};
  tf_status_t status =
      start->from_h
          ? tf_begin_with_slip(k, &x, input, start->h, &motion->report)
          : tf_begin(k, &x, input, &motion->report);
  if (status < 0) return status;
  if (start->from_h && scheme == MOTION_COMPENSATED) {
    // It succeeds where tf_begin_with_slip does.
    (void)tf_speed_for_slip_compensated(&motion->machine, &x, &low,
                                        input->omega0, start->h);
    status = tf_begin(k, &x, input, &motion->report);
  }
  motion->state = x;
  motion->low = low;
  return status;
}

/// One step. Returns: as tf_step and the like; < 0: the state is untouched.
static inline tf_status_t motion_step(motion_t *motion, motion_scheme_t scheme,
                                      const tf_input_t *input) {
  const tf_compensated_t *k = &motion->machine;
  if (scheme == MOTION_COMPENSATED)
    return tf_step_compensated(k, &motion->state, &motion->low, input,
                               &motion->report);
  motion->low = (tf_compensation_t){0, 0, 0, 0};
  return (scheme == MOTION_LOCATED ? tf_step_located : tf_step)(
      &k->machine, &motion->state, input, &motion->report);
}

/// The changes of the contact within steps, which MOTION_LOCATED alone finds;
/// those that have no room are left out.
#define MOTION_CHANGES 32
typedef struct {
  size_t count;
  tf_located_change_t list[MOTION_CHANGES];
} motion_changes_t;

/// motion_step, which adds the changes within the step to the others.
static inline tf_status_t motion_step_changes(motion_t *motion,
                                              motion_scheme_t scheme,
                                              const tf_input_t *input,
                                              motion_changes_t *changes) {
  const size_t room = MOTION_CHANGES - changes->count;
  size_t count = 0;
  if (scheme != MOTION_LOCATED) return motion_step(motion, scheme, input);
  motion->low = (tf_compensation_t){0, 0, 0, 0};
  const tf_status_t status = tf_step_located_changes(
      &motion->machine.machine, &motion->state, input, &motion->report,
      changes->list + changes->count, room, &count);
  changes->count += count < room ? count : room;
  return status;
}

/// A step that ends in a mode: the rule's own, or one from that mode on, or by
/// one of many draws that end a rest, as at the h = g = 0 that a step comes to.
/// Where the mode is possible only within the step, it ends in stick or rest,
/// left into the mode at its end.
/// Returns: the status of the step; < 0: the motion is untouched.
///   TF_BAD_PARAMETER: no step ends in that mode.
static inline tf_status_t motion_take(motion_t *motion, motion_scheme_t scheme,
                                      const tf_input_t *input, unsigned mode) {
  const motion_t before = *motion;
  tf_contact_t *contact = &motion->machine.machine.contact;
  tf_status_t status = motion_step(motion, scheme, input);
  const unsigned modes = motion->report.set;
  if (status >= 0 && motion->report.mode == mode) return status;
  if (status >= 0) status = TF_BAD_PARAMETER;
  for (unsigned i = TF_MODES; (modes >> mode & 1u) != 0 && i >= TF_STICK_PLUS &&
                              status == TF_BAD_PARAMETER;
       i--) {
    const unsigned to = i == TF_MODES ? mode : i;
    for (uint32_t attempt = 0; (modes >> to & 1u) != 0 && attempt < 64;
         attempt++) {
      *motion = before;
      motion->state.mode = (uint8_t)(attempt == 0 ? to : TF_PINNED);
      motion->state.seed = attempt;
      contact->rule = attempt == 0 ? TF_RULE_PERSIST : TF_RULE_RANDOM;
      contact->exit_threshold = to == TF_PINNED ? 0 : UINT64_MAX;
      if (motion_step(motion, scheme, input) < 0 || motion->report.mode != to)
        continue;
      motion->state.seed = before.state.seed;
      motion->state.mode = motion->report.mode = (uint8_t)mode;
      *contact = before.machine.machine.contact;
      return motion->report.status;
    }
  }
  *motion = before;
  return status;
}

/// An instant of a motion as a row.
#define MOTION_TIME(name, unit, value) double name;
#define MOTION_REAL(name, unit, value) tf_real_t name;
#define MOTION_VALUE(name, unit, value) .name = (value),
typedef struct {
  EACH_COLUMN(MOTION_TIME, MOTION_REAL, MOTION_REAL)
  uint8_t mode, set, choices;
  int8_t status;
} motion_row_t;

static inline motion_row_t motion_row(const motion_t *motion) {
  const tf_state_t *state = &motion->state;
  const tf_report_t *report = &motion->report;
  const double t = (double)state->tick * (double)motion->machine.machine.dt;
  const motion_row_t out = {
      .mode = report->mode,
      .set = report->set,
      .choices = report->choices,
      .status = (int8_t)report->status,
      EACH_COLUMN(MOTION_VALUE, MOTION_VALUE, MOTION_VALUE)};
  return out;
}

#endif
