/// From a scene and the settings of the command line to a machine that is
/// ready to step. Every command that takes SCENE and --set goes through here,
/// so names, ranges and messages are the same in all of them.
#pragma once

#include "../../motion.h"
#include "../text/text.h"

/// A name, and the unit of what it names.
typedef struct {
  const char *name, *unit;
} cli_quantity_t;

// The settings of a command line: NAME=VALUE pairs, still as text.

#define CLI_NAME_ROOM 16 ///< of the longest name, with its terminating zero
#define CLI_SETTINGS 64  ///< of a command line: more than there are names

typedef struct {
  cli_given_t given;        ///< "--set" or "--dt", and what followed it
  char name[CLI_NAME_ROOM]; ///< left of '='
  const char *value;        ///< right of '='
} cli_setting_t;

/// All settings in the order in which they were given, no name twice.
typedef struct {
  size_t count;
  cli_setting_t list[CLI_SETTINGS];
} cli_settings_t;

/// Splits NAME=VALUE and appends it. A name that was given before is refused:
/// which of the two values is meant cannot be known.
int cli_settings_add(cli_settings_t *settings, const cli_given_t *given);

/// Likewise the setting of an option that implies the name: --dt VALUE.
int cli_settings_add_named(cli_settings_t *settings, const cli_given_t *given,
                           const char *name, const char *value);

/// The setting of a name, NULL where it was not given.
const cli_setting_t *cli_settings_find(const cli_settings_t *settings,
                                       const char *name);

/// The numbers that --set sets: the parameters, and behind them the start.
enum { CLI_R = TF_PARAMETERS, CLI_V, CLI_OMEGA, CLI_H, CLI_PHI, CLI_NUMBERS };

/// Name, unit and range of a number, and where it is: a parameter in
/// tf_params_t, another one in motion_start_t.
const tf_parameter_range_t *cli_number(size_t index);

/// Index of the number of a name, CLI_NUMBERS where there is none.
size_t cli_number_index(const char *name);

/// A scene with its settings applied.
typedef struct {
  const tf_scene_t *scene;
  tf_params_t params;
  motion_start_t start;
  const cli_setting_t *set[CLI_NUMBERS]; ///< NULL where not given
  uint32_t seed;                         ///< of rule random
  motion_scheme_t scheme;                ///< MOTION_SCHEMES: not chosen
  tf_machine_t machine;
  tf_input_t input; ///< at t = 0
  motion_t motion;  ///< at t = 0, begun
} cli_setup_t;

/// Applies the scene, then every setting in its order, then the rule.
/// settings: in, kept. select: RULE[:SEED] or NULL for the scene's own.
int cli_setup_read(cli_setup_t *setup, const tf_scene_t *scene,
                   const cli_settings_t *settings, const char *select);

/// The first setting of the start, NULL where none was given.
const cli_setting_t *cli_setup_start_set(const cli_setup_t *setup);

/// Prepares the machine; checks the initial values that were set, each by
/// itself; does so, computes the initial state and begins it.
int cli_setup_machine(cli_setup_t *setup);
int cli_setup_check_starts(const cli_setup_t *setup);
int cli_setup_start(cli_setup_t *setup);

/// Chooses the scheme where none is, moreau, or in float at short steps
/// compensated, with a note. It has to take the law.
/// file: in, the state or the record that may have given it, for a note where
/// it is not the usual one; NULL: there is none.
int cli_setup_scheme(cli_setup_t *setup, const char *file);

/// Largest number of steps of a run, and between two rows: a double holds every
/// integer up to it.
#define CLI_MAX_STEPS 1000000000000000u

/// When a run ends, by --t-end or the scene; and the number of its steps.
tf_real_t cli_end_of(const tf_scene_t *scene, const cli_range_t *t_end);
int cli_count_steps(const cli_setup_t *setup, const cli_range_t *t_end,
                    uint64_t *steps);

/// Notes which settings have no effect in this scene and scheme.
void cli_setup_notes(const cli_setup_t *setup);

/// CRC-32 of all of a scene that a motion depends on, with what the command
/// line has changed: parameters, law, rule, start, profile.
uint32_t cli_scene_hash(const cli_setup_t *setup);

/// The CRC-32 of the bytes before and of a text as printf writes it.
uint32_t cli_crc_of(uint32_t before, const char *format, ...) CLI_PRINTF(2, 3);

/// Writes four lines that begin with #: what program, scene and settings the
/// rows are of, how they were computed (how: in), units of the columns.
#define CLI_PROVENANCE_ROOM 1024
size_t cli_provenance(const cli_setup_t *setup, const char *how,
                      const char *units, char out[CLI_PROVENANCE_ROOM]);

/// What each parameter is, in words.
extern const char *const cli_parameter_about[TF_PARAMETERS];

tf_real_t cli_parameter(const tf_params_t *params, size_t index);

static inline bool cli_is_in(const tf_parameter_range_t *range,
                             tf_real_t value) {
  return value >= range->low && value <= range->high;
}

/// What a value has to be to lie in a range, for messages: "must lie in ...".
const char *cli_must(const tf_parameter_range_t *range);

/// The first parameter out of its range. One that the law does not use may be
/// 0, which means "none". Returns: TF_PARAMETERS where there is none.
size_t cli_parameter_out(const tf_params_t *params);

/// Whether a parameter may have a value, its range apart: one that counts has
/// no fraction, which the core would cut off.
bool cli_parameter_fits(size_t index, tf_real_t value);

/// Sets law, rest or rule by its name.
/// what: in, one of these words. given: in, for the message.
int cli_set_word(tf_params_t *params, const char *what,
                 const cli_given_t *given, const char *name);

/// Writes a set of modes, bits TF_MODE_BIT: their names in a fixed order, with
/// `|` between them. Returns: out.
#define CLI_SET_ROOM 40
const char *cli_write_set(char out[CLI_SET_ROOM], unsigned set);

/// Stick does not include pinned.
static inline bool cli_is_stick(unsigned mode) {
  return mode == TF_STICK_PLUS || mode == TF_STICK_MINUS;
}

/// The stick for a sign of g, and the sign of g of a stick.
static inline unsigned cli_stick_mode(double g) {
  return g < 0 ? TF_STICK_MINUS : TF_STICK_PLUS;
}
static inline double cli_stick_sign(unsigned mode) {
  return mode == TF_STICK_MINUS ? -1 : 1;
}
