/// @file
/// A scene is a constant: parameters, tyre law, selection rule, start and
/// inputs; the scheme is the caller's choice. A build for one scene contains
/// only what that scene needs.
#ifndef TWOFOLD_SCENE_H
#define TWOFOLD_SCENE_H

#include "twofold/step.h"

TF_BEGIN_C

/// A knot of the turntable's speed, which is linear between knots and constant
/// before the first and after the last. Two knots at one time are a jump.
typedef struct {
  tf_real_t t, omega0; ///< [s], [rad/s]
} tf_knot_t;
#define TF_SCENE_KNOTS 8

typedef struct {
  const char *name;
  const char *shows;      ///< one line
  const char *leaves_out; ///< one line
  tf_params_t params;
  tf_real_t r, omega, h; ///< start; v follows from h, unless ...
  tf_real_t v;           ///< ... it is given
  bool v_is_given;
  tf_real_t t_end; ///< default length [s]
  uint8_t knots;   ///< 0: omega0 of the parameters throughout
  tf_knot_t profile[TF_SCENE_KNOTS];
} tf_scene_t;

/// Inputs of a scene for the step that ends at a tick, that is at tick dt; they
/// depend on nothing else. alpha is the mean over that step. A jump within it
/// is moved to its start. A knot that is tick dt but for rounding (2^-20 dt) is
/// not within a step. Tick 0: those of the start, with the alpha of the first
/// step.
/// scene: in. machine: in, from scene->params (or altered ones). tick: in; in
///   float exact up to 2^24.
#define tf_scene_input TF_LINK(tf_scene_input)
TF_API tf_input_t tf_scene_input(const tf_scene_t *scene,
                                 const tf_machine_t *machine, uint64_t tick);

/// Start of a scene: state, mode and report at tick 0, by tf_begin_with_slip
/// where the scene gives h, else by tf_begin, under the inputs of tick 0.
/// scene: in. machine: in, from scene->params (or altered ones).
/// seed: in, of rule `random`. state, report: out.
/// Returns: TF_OK; TF_BAD_STATE (nothing touched: there is no such start).
#define tf_scene_start TF_LINK(tf_scene_start)
TF_API tf_status_t tf_scene_start(const tf_scene_t *scene,
                                  const tf_machine_t *machine, uint32_t seed,
                                  tf_state_t *state, tf_report_t *report);

/// The scenes that come with the project.
#define TF_SCENES 9
#define tf_scenes TF_LINK(tf_scenes)
TF_API_DATA const tf_scene_t *const tf_scenes[TF_SCENES];

TF_END_C

#endif
