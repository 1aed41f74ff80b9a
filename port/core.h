/// @file
/// The simulator within one translation unit, for one scene or for all.
///
/// For one scene, SCENE_HEADER names a header of constants that
/// tools/board/constants/constants.c wrote: the prepared machine, the state in
/// which the motion starts, the inputs. The constants are local to this
/// translation unit, and so is every function of the core; the compiler
/// propagates the constants through them and removes what the scene does not
/// use, down to the branches of a step. Without SCENE_HEADER all scenes are
/// here; the one that a number in another object (port/choice.c) names is
/// prepared at run time.
///
/// Both compute the bits that the library computes.
#ifndef TWOFOLD_PORT_CORE_H
#define TWOFOLD_PORT_CORE_H

#define TF_API_STATIC

// The headers declare functions of other schemes, which are not defined here.
#pragma GCC diagnostic ignored "-Wunused-function"

// Before the public headers, see there.
#include "../src/num/rounding.h"
#include "twofold/compensated.h"
#include "twofold/link.h"
#include "twofold/located.h"
#include "twofold/simulation.h"
#include "twofold/step.h"
#ifdef SCENE_HEADER
#include SCENE_HEADER
#endif
// The located scheme steps a machine of another dt where it falls back.
#if defined(SCENE_HEADER) && !defined(UPLINK) && !defined(SCHEME_LOCATED)
#define TF_STEP_MACHINE(c) ((void)(c), &scene_machine)
#define TF_STEP_PINS (scene_machine.contact.stick_kappa > 0)
#endif
// Without a profile and without commands the turntable is steady.
#if defined(SCENE_HEADER) && !defined(UPLINK)
#define TF_STEP_TURN(u, time) \
  (scene_constants.knots > 0 ? (u)->alpha * (time) : 0)
#endif

#ifdef BOARD_SMALL
// Where flash is short, the parts of a step stay functions: half the size.
#include "../src/num/kernel.h"
#undef TF_INLINE
#define TF_INLINE static
#endif

// Room by room. Names local to a file are unique in all of src/, so any order
// would do. A program contains one scheme beside tf_step at most.
// NOLINTBEGIN(bugprone-suspicious-include): one translation unit on purpose.
#include "../src/num/kernel.c"
#include "../src/num/status.c"
#ifdef SCHEME_LOCATED
#include "../src/num/polynomial.c"
#endif

#include "../src/friction/codim2.c"
#include "../src/friction/contact.c"
#include "../src/friction/contacts.c"
#include "../src/friction/joint.c"
#include "../src/friction/quadrant.c"
#include "../src/friction/select.c"
#include "../src/friction/tyre.c"
#include "../src/friction/zeros.c"
#include "../src/model/machine.c"
#include "../src/model/rest_motion.c"
#include "../src/moreau/balanced.c"
#include "../src/moreau/begin.c"
#include "../src/moreau/codim2_end.c"
#ifdef SCHEME_COMPENSATED
#include "../src/moreau/compensated.c"
#endif
#include "../src/moreau/mode_end.c"
#include "../src/moreau/rare_end.c"
#include "../src/moreau/report.c"
#include "../src/moreau/split.c"
#include "../src/moreau/step.c"

#ifdef SCHEME_LOCATED
#include "../src/event/event.c"
#include "../src/event/located.c"
#include "../src/event/taylor.c"
#include "../src/event/transition.c"
#endif

#include "../src/link/command.c"
#include "../src/link/frame.c"
#include "../src/link/link.c"
#include "../src/link/telemetry.c"
#include "../src/link/text.c"
#include "../src/scene/scenes.c"
#include "../src/scene/simulation.c"
// NOLINTEND(bugprone-suspicious-include)

/// The parameters of a scene as this firmware runs it: at dt = 1 / SCENE_RATE,
/// where it has a rate of its own.
static inline tf_params_t scene_params(const tf_scene_t *scene) {
  tf_params_t params = scene->params;
#ifdef SCENE_RATE
  params.dt = TF_R(1.0) / SCENE_RATE;
#endif
  return params;
}

// scene_begin puts the scene that runs at its start. Returns: whether it could.
#ifdef SCENE_HEADER

#define SCENE_MACHINE (&scene_machine)
#define SCENE (&scene_constants)

static inline bool scene_begin(tf_state_t *state, tf_report_t *report) {
  *state = scene_start;
  *report = scene_start_report;
  return true;
}

#else

/// Which of tf_scenes runs.
extern const uint8_t chosen_scene;

static tf_machine_t scene_machine;

#define SCENE_MACHINE ((const tf_machine_t *)&scene_machine)
#define SCENE (tf_scenes[chosen_scene])

static inline bool begin_given_scene(const tf_scene_t *scene, tf_state_t *state,
                                     tf_report_t *report) {
  const tf_params_t params = scene_params(scene);
  return tf_prepare(&scene_machine, &params, 0) == TF_OK &&
         tf_scene_start(scene, &scene_machine, 1, state, report) == TF_OK;
}

static inline bool scene_begin(tf_state_t *state, tf_report_t *report) {
  return begin_given_scene(SCENE, state, report);
}

#endif

// The scheme, by its number in the schema frame. Moreau-Jean where none is
// named.
#if defined(SCHEME_LOCATED)
#define SCHEME 1
#define scheme_step tf_step_located
static inline bool scheme_begin(void) { return true; }
#elif defined(SCHEME_COMPENSATED)
#ifdef UPLINK
#error \
    "commands change the machine but not its compensated form: no UPLINK here"
#endif
#define SCHEME 2
static tf_compensated_t scheme_machine;
static tf_compensation_t scheme_compensation;

static inline bool scheme_begin(void) {
  const tf_params_t params = scene_params(SCENE);
  return tf_prepare_compensated(&scheme_machine, &params, 0) == TF_OK;
}

static inline tf_status_t scheme_step(const tf_machine_t *machine,
                                      tf_state_t *state,
                                      const tf_input_t *input,
                                      tf_report_t *report) {
  (void)machine;
  return tf_step_compensated(&scheme_machine, state, &scheme_compensation,
                             input, report);
}
#else
#define SCHEME 0
#define scheme_step tf_step
static inline bool scheme_begin(void) { return true; }
#endif

/// The inputs of the step that ends after so many steps.
static inline tf_input_t scene_input(uint32_t steps) {
  return tf_scene_input(SCENE, SCENE_MACHINE, steps);
}

#endif
