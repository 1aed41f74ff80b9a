/// @file
/// A scene is a constant: parameters, tyre law, selection rule, start and
/// inputs; the scheme is the caller's choice. A build for one scene contains
/// only what that scene needs.
///
/// A running scene: what a program that steps in real time keeps from tick to
/// tick. The program itself calls tf_step or tf_step_located, so that a build
/// contains only the scheme that it calls:
///
///   if (!simulation.running) return;
///   tf_input_t input = tf_simulation_input(&simulation, scene);
///   tf_tally_count(&simulation.tally, simulation.state.tick,
///                  tf_step(&simulation.machine, &simulation.state, &input,
///                          &simulation.report));
///
/// Inputs that are set from outside hold for `deadman` ticks of the program's
/// clock: steps, and ticks that pass without one while the simulation runs
/// (tf_simulation_pass). While it stands, as a board in lockstep does, none
/// counts. Their alpha is that of the first of these steps, at whose end the
/// turntable has their omega0, and keeps it. Once they expire the inputs are
/// the safe ones, those of a machine that nothing drives (tf_input_default),
/// until they are set again.
#ifndef TWOFOLD_SIMULATION_H
#define TWOFOLD_SIMULATION_H

#include "twofold/status.h"
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

/// Steps that did not return TF_OK. All zero at the start.
typedef struct {
  uint64_t degraded;  ///< TF_DEGRADED
  uint64_t fell_back; ///< TF_FELL_BACK
  uint64_t coarse;    ///< TF_COARSE
  uint64_t stalled;   ///< TF_STALLED
  uint64_t refused;   ///< negative codes: the state is untouched
  uint64_t first;     ///< tick of the first of all these, if there is one
} tf_tally_t;

/// Counts one step.
/// tally: in/out. tick: in, of the state after the step. status: in, of it.
#define tf_tally_count TF_LINK(tf_tally_count)
TF_API void tf_tally_count(tf_tally_t *tally, uint64_t tick,
                           tf_status_t status);

/// Whose inputs a step has.
typedef enum {
  TF_INPUT_SCENE = 0, ///< those of the scene
  TF_INPUT_SET = 1,   ///< those set from outside
  TF_INPUT_SAFE = 2   ///< the safe ones: those from outside have expired
} tf_input_source_t;

typedef struct {
  tf_machine_t machine;
  tf_state_t state;
  tf_report_t report;        ///< of the last step, or of the start
  tf_input_t input;          ///< set from outside
  tf_input_source_t source;  ///< whose inputs the next step has
  tf_input_source_t stepped; ///< whose inputs the last step had
  uint32_t deadman; ///< ticks that inputs from outside hold; 0: without end
  uint32_t left;    ///< ticks that the present ones still hold
  uint32_t expired; ///< inputs that expired so, modulo 2^32
  tf_tally_t tally; ///< of the steps since tf_simulation_open
  bool running;     ///< whether the program steps at a tick
} tf_simulation_t;

/// Returns a simulation to the start of its scene (tf_scene_start).
/// simulation: in/out. The machine stays as it is, as do running and deadman;
///   the inputs are those of the scene afterwards.
/// scene: in. seed: in, of rule `random`.
/// Returns: TF_OK; TF_BAD_STATE (simulation untouched: no start with these
///   parameters).
#define tf_simulation_start TF_LINK(tf_simulation_start)
TF_API tf_status_t tf_simulation_start(tf_simulation_t *simulation,
                                       const tf_scene_t *scene, uint32_t seed);

/// Prepares the machine and starts the scene, running: tf_prepare, then
/// tf_simulation_start. deadman is 0: a program that takes inputs from a line
/// sets it.
/// simulation: out. scene, seed: in. params: in, those of the scene or altered.
/// Returns: TF_OK; TF_BAD_PARAMETER, TF_BAD_STATE (the simulation may be half
///   prepared and must not be used).
#define tf_simulation_open TF_LINK(tf_simulation_open)
TF_API tf_status_t tf_simulation_open(tf_simulation_t *simulation,
                                      const tf_scene_t *scene,
                                      const tf_params_t *params, uint32_t seed);

/// Sets the inputs from outside; they hold from the next step on, alpha for
/// that step alone.
/// simulation: in/out. input: in, checked by the step.
#define tf_simulation_set_input TF_LINK(tf_simulation_set_input)
TF_API void tf_simulation_set_input(tf_simulation_t *simulation,
                                    const tf_input_t *input);

/// Counts ticks without a step off the time that inputs from outside hold.
/// To be called before commands take effect.
/// simulation: in/out. ticks: in.
static inline void tf_simulation_pass(tf_simulation_t *simulation,
                                      uint32_t ticks) {
  if (!simulation->running) return;
  simulation->left -= ticks < simulation->left ? ticks : simulation->left;
}

/// Inputs of the next step: those of the scene at (tick + 1) dt, those set from
/// outside, or those of tf_input_default. To be called once for each step: this
/// is where its tick of the dead-man is counted.
/// simulation: in/out. scene: in.
#define tf_simulation_input TF_LINK(tf_simulation_input)
TF_API tf_input_t tf_simulation_input(tf_simulation_t *simulation,
                                      const tf_scene_t *scene);

TF_END_C

#endif
