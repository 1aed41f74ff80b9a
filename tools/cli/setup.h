/// @file
/// From a scene and the settings of the command line to a machine that is
/// ready to step. Every command that takes SCENE and --set goes through here,
/// so a name, a range and a complaint are the same in all of them.
#ifndef TWOFOLD_CLI_SETUP_H
#define TWOFOLD_CLI_SETUP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold.h"

/// The longest name that --set knows, with its terminating zero.
#define CLI_NAME_ROOM 16
/// How many settings one command line may hold: more than there are names.
#define CLI_SETTINGS 64

/// One setting as typed, kept for the complaint.
typedef struct {
  const char *option;       ///< "--set" or "--dt"
  const char *text;         ///< what followed it
  char name[CLI_NAME_ROOM]; ///< left of '='
  const char *value;        ///< right of '='
} cli_setting_t;

/// All settings in the order in which they were given, no name twice.
typedef struct {
  size_t count;
  cli_setting_t list[CLI_SETTINGS];
} cli_settings_t;

/// Splits NAME=VALUE and appends it.
/// option: "--set". text: in, kept.
/// Returns: CLI_DONE or CLI_USAGE (complained), also where the name was given
/// before: of two values one is a mistake, and which one cannot be known.
int cli_settings_add(cli_settings_t *settings, const char *option,
                     const char *text);

/// Appends a setting whose option says its name: --dt VALUE.
/// Returns: CLI_DONE or CLI_USAGE (complained).
int cli_settings_add_named(cli_settings_t *settings, const char *option,
                           const char *name, const char *value);

/// What a state may start from, by name.
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
  bool placed;        ///< its v follows from h
  tf_report_t report; ///< of tf_begin
} cli_setup_t;

/// Takes a word for the name of the scene.
/// scene: in/out, NULL before the first.
/// Returns: CLI_DONE, or CLI_USAGE where there is no such scene or it is the
/// second (complained, with the closest name).
int cli_take_scene(const tf_scene_t **scene, const char *word);

/// Whether a scene was given. Returns: CLI_DONE or CLI_USAGE (complained).
int cli_need_scene(const tf_scene_t *scene, const char *command);

/// Names for people: laws and rules in the order of their enums.
const char *cli_law_name(tf_tyre_law_t law);
const char *cli_rule_name(tf_rule_t rule);

/// Takes over the scene, then every setting in its order, then the rule.
/// settings: in, kept. select: RULE[:SEED] or NULL for the scene's own.
/// Returns: CLI_DONE or CLI_USAGE (complained).
int cli_setup_read(cli_setup_t *setup, const tf_scene_t *scene,
                   const cli_settings_t *settings, const char *select);

/// Prepares the machine.
/// Returns: CLI_DONE or CLI_REFUSED (complained, with value and range).
int cli_setup_machine(cli_setup_t *setup);

/// Places and begins the state.
/// Returns: CLI_DONE, CLI_USAGE (h and v both given) or CLI_REFUSED.
int cli_setup_start(cli_setup_t *setup);

/// Says on standard error which settings are without effect in this scene.
/// idle, why: in, a parameter that the scheme leaves aside, and since when.
void cli_setup_notes(const cli_setup_t *setup, const char *idle,
                     const char *why);

#endif
