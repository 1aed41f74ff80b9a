/// @file
/// A scene is a constant: parameters, tyre law, selection rule, start and
/// inputs. What a scene does not name is not in a build made for it alone. The
/// scheme is not its part: the caller chooses it by the function that it calls.
#ifndef TWOFOLD_SCENE_H
#define TWOFOLD_SCENE_H

#include "twofold/machine.h"

/// A knot of the turntable's speed, linear in between, constant outside.
typedef struct {
  tf_real_t t;      ///< [s]
  tf_real_t omega0; ///< [rad/s]
} tf_knot_t;
#define TF_SCENE_KNOTS 8

typedef struct {
  const char *name;
  const char *shows;      ///< one line
  const char *leaves_out; ///< one line
  tf_params_t params;
  tf_real_t r, omega, h; ///< start; v follows from h ...
  tf_real_t v;           ///< ... unless v_is_given
  bool v_is_given;
  tf_real_t t_end; ///< default length [s]
  uint8_t knots;   ///< 0: omega0 of the parameters throughout
  tf_knot_t profile[TF_SCENE_KNOTS];
} tf_scene_t;

/// Inputs of a scene for the step that ends at t.
/// Scheme: linear interpolation between knots.
/// scene: in.
/// machine: in, prepared from scene->params (or altered ones).
/// t: in [s], finite.
/// Returns: the inputs; alpha is the mean over the step.
/// Cost: at most 190 instructions; 8 knots. Stack: 144 B.
/// Memory: reentrant.
/// Claims: driven_profile_is_followed
#define tf_scene_input TF_LINK(tf_scene_input)
TF_API tf_input_t tf_scene_input(const tf_scene_t *scene,
                                 const tf_machine_t *machine, tf_real_t t);

/// The scenes that come with the project.
#define TF_SCENES 9
#define tf_scenes TF_LINK(tf_scenes)
TF_API_DATA const tf_scene_t *const tf_scenes[TF_SCENES];

#endif
