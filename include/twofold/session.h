/// @file
/// A running scene: what a program that steps in real time keeps from tick to
/// tick. The program itself calls tf_step or tf_step_located, so that a build
/// contains only the scheme that it calls:
///
///   tf_input_t input = tf_session_input(&session, scene);
///   if (session.running)
///     tf_tally_count(&session.tally, session.state.tick,
///                    tf_step(&session.machine, &session.state, &input,
///                            &session.report));
#ifndef TWOFOLD_SESSION_H
#define TWOFOLD_SESSION_H

#include "twofold/scene.h"
#include "twofold/step.h"
#include "twofold/tally.h"

typedef struct {
  tf_machine_t machine;
  tf_state_t state;
  tf_report_t report; ///< of the last step, or of the start
  tf_input_t input;   ///< set from outside; used if input_is_set
  bool input_is_set;  ///< false: the inputs are those of the scene
  tf_tally_t tally;   ///< of the steps since tf_session_open
  bool running;       ///< whether the program steps at a tick
} tf_session_t;

/// Returns a session to the start of its scene. The machine stays as it is.
/// Scheme: tf_scene_start.
/// session: in/out, machine prepared; input_is_set is false afterwards, running
///   stays.
/// scene: in. seed: in, of rule `random`.
/// Returns: TF_OK; TF_BAD_STATE (session untouched: the start is impossible
///   with these parameters).
/// Cost: at most 640 instructions. Stack: 1008 B.
/// Memory: caller's, reentrant.
/// Claims: session_is_the_run_of_the_command_line
#define tf_session_start TF_LINK(tf_session_start)
TF_API tf_status_t tf_session_start(tf_session_t *session,
                                    const tf_scene_t *scene, uint32_t seed);

/// Prepares the machine and starts the scene, running.
/// Scheme: tf_prepare, then tf_session_start.
/// session: out.
/// scene: in. params: in, those of the scene or altered ones. seed: in.
/// Returns: TF_OK; TF_BAD_PARAMETER, TF_BAD_STATE (the session may be half
///   prepared and must not be used).
/// Cost: at most 1800 instructions. Stack: 1008 B.
/// Memory: caller's, reentrant.
/// Claims: session_is_the_run_of_the_command_line
#define tf_session_open TF_LINK(tf_session_open)
TF_API tf_status_t tf_session_open(tf_session_t *session,
                                   const tf_scene_t *scene,
                                   const tf_params_t *params, uint32_t seed);

/// Inputs of the next step.
/// Scheme: those set from outside if input_is_set; else those of the scene at
///   (tick + 1) dt.
/// session: in. scene: in.
/// Returns: the inputs.
/// Cost: at most 220 instructions. Stack: 176 B.
/// Memory: reentrant.
/// Claims: session_is_the_run_of_the_command_line
#define tf_session_input TF_LINK(tf_session_input)
TF_API tf_input_t tf_session_input(const tf_session_t *session,
                                   const tf_scene_t *scene);

#endif
