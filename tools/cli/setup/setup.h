/// @file
/// From a scene and the settings of the command line to a machine that is
/// ready to step. Every command that takes SCENE and --set goes through here,
/// so names, ranges and messages are the same in all of them.
#ifndef TWOFOLD_CLI_SETUP_H
#define TWOFOLD_CLI_SETUP_H

#include <stdbool.h>
#include <stdint.h>

#include "settings.h"
#include "twofold.h"

/// The initial values that --set knows.
enum {
  CLI_START_R,
  CLI_START_V,
  CLI_START_OMEGA,
  CLI_START_H,
  CLI_START_PHI,
  CLI_STARTS
};
typedef struct {
  const char *name, *unit;
} cli_start_t;
extern const cli_start_t cli_starts[CLI_STARTS];

/// A scene with its settings applied.
typedef struct {
  const tf_scene_t *scene;
  tf_params_t params;
  const cli_setting_t *set_param[TF_PARAMETERS]; ///< NULL where not given
  tf_real_t start[CLI_STARTS];
  const cli_setting_t *set_start[CLI_STARTS]; ///< NULL where not given
  uint32_t seed;                              ///< of rule random
  tf_machine_t machine;
  tf_input_t input;   ///< at t = 0
  tf_state_t state;   ///< at t = 0, begun
  bool v_from_h;      ///< v was computed from the slip speed h
  tf_report_t report; ///< of tf_begin
} cli_setup_t;

/// Applies the scene, then every setting in its order, then the rule.
/// settings: in, kept. select: RULE[:SEED] or NULL for the scene's own.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_setup_read(cli_setup_t *setup, const tf_scene_t *scene,
                   const cli_settings_t *settings, const char *select);

/// The setting of a parameter, NULL where it was not given or the name is none.
const cli_setting_t *cli_setup_setting(const cli_setup_t *setup,
                                       const char *parameter);

/// Prepares the machine.
/// Returns: CLI_DONE, or CLI_REFUSED after a message with value and range.
int cli_setup_machine(cli_setup_t *setup);

/// Checks the initial values that were set, each by itself.
/// Returns: CLI_DONE; after a message CLI_USAGE (h and v both given) or
/// CLI_REFUSED.
int cli_setup_check_starts(const cli_setup_t *setup);

/// Computes the initial state and begins it.
/// Returns: CLI_DONE; after a message CLI_USAGE (h and v both given) or
/// CLI_REFUSED.
int cli_setup_start(cli_setup_t *setup);

/// Reports on standard error which settings have no effect in this scene.
/// unused, why: in, a parameter that the scheme does not use, and the end of
/// the message "... has no effect".
void cli_setup_notes(const cli_setup_t *setup, const char *unused,
                     const char *why);

#endif
