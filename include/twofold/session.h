/// @file
/// A scene under way: what a program that steps in real time keeps between two
/// ticks. The program calls tf_step or tf_step_located itself, so that a build holds
/// the one scheme that it names:
///
///   tf_input_t input = tf_session_input(&session, scene);
///   if (session.running)
///     tf_step(&session.machine, &session.state, &input, &session.report);
#ifndef TWOFOLD_SESSION_H
#define TWOFOLD_SESSION_H

#include "twofold/scene.h"
#include "twofold/step.h"

typedef struct {
  tf_machine_t machine;
  tf_state_t state;
  tf_report_t report; ///< of the last step, or of the start
  tf_input_t input;   ///< from outside, where driven
  bool driven;        ///< false: the scene has the inputs
  bool running;       ///< whether the program steps at a tick
} tf_session_t;

/// Puts a session at the start of its scene. The machine stays as it is.
/// Scheme: tf_speed_for_slip where the scene gives h, then tf_begin.
/// session: in/out, machine prepared; driven is false afterwards, running
///   stays.
/// scene: in. seed: in, of rule `random`.
/// Returns: TF_OK; TF_BAD_STATE (session untouched: the start is impossible
///   with these parameters).
/// Cost: at most 620 instructions. Stack: 1008 B.
/// Memory: caller's, reentrant.
/// Claims: session_is_the_run_of_the_command_line
#define tf_session_start TF_LINK(tf_session_start)
TF_API tf_status_t tf_session_start(tf_session_t *session,
                                    const tf_scene_t *scene, uint32_t seed);

/// Prepares the machine, puts it at the start and lets it run.
/// Scheme: none.
/// session: out.
/// scene: in. params: in, those of the scene or altered ones. seed: in.
/// Returns: TF_OK; TF_BAD_PARAMETER, TF_BAD_STATE (session untouched or half
///   prepared: not to be used).
/// Cost: at most 1800 instructions. Stack: 1008 B.
/// Memory: caller's, reentrant.
/// Claims: session_is_the_run_of_the_command_line
#define tf_session_open TF_LINK(tf_session_open)
TF_API tf_status_t tf_session_open(tf_session_t *session,
                                   const tf_scene_t *scene,
                                   const tf_params_t *params, uint32_t seed);

/// Inputs of the next step.
/// Scheme: from outside where driven; else of the scene at (tick + 1) dt.
/// session: in. scene: in.
/// Returns: the inputs.
/// Cost: at most 220 instructions. Stack: 176 B.
/// Memory: reentrant.
/// Claims: session_is_the_run_of_the_command_line
#define tf_session_input TF_LINK(tf_session_input)
TF_API tf_input_t tf_session_input(const tf_session_t *session,
                                   const tf_scene_t *scene);

#endif
