/// @file
/// Names of laws and rules, as typed on the command line; parameters; groups of
/// modes.
#ifndef TWOFOLD_CLI_NAMES_H
#define TWOFOLD_CLI_NAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "twofold.h"

/// A name, and the unit of what it names.
typedef struct {
  const char *name, *unit;
} cli_quantity_t;

/// Index of a parameter in tf_parameter_ranges, TF_PARAMETERS where no
/// parameter has that name.
size_t cli_parameter_index(const char *name);

/// Value of a parameter, by its index.
tf_real_t cli_parameter(const tf_params_t *params, size_t index);

/// Prints a line for a parameter: name, range, unit, and the laws that use it
/// where not all do; and such a line for each parameter.
void cli_print_range(size_t parameter);
void cli_print_ranges(void);

/// Whether a parameter may have a value, its range apart: one that counts has
/// no fraction, which the core would cut off.
bool cli_parameter_fits(size_t index, tf_real_t value);

/// Finds a law by its name.
/// option, text: in, for the message. name: in, as typed.
/// Returns: CLI_DONE, or CLI_USAGE after a message with the closest name.
int cli_find_law(const char *option, const char *text, const char *name,
                 tf_tyre_law_t *law);

/// Finds a law of rest by its name, likewise.
int cli_find_rest(const char *option, const char *text, const char *name,
                  tf_rest_law_t *rest);

/// Finds a rule by its name, likewise.
int cli_find_rule(const char *option, const char *text, const char *name,
                  tf_rule_t *rule);

/// Finds a built-in scene. place, besides: in, for the message, before it and
/// at its end.
int cli_find_scene(const char *place, const char *name, const char *besides,
                   const tf_scene_t **scene);

/// Reads RULE[:SEED] of --select. Without SEED, seed is left as it is.
int cli_read_rule(const char *select, tf_rule_t *rule, uint32_t *seed);

/// Groups of modes, for the commands that follow a motion.
static inline bool cli_is_slip(unsigned mode) { return mode <= TF_SLIP_MINUS; }

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

#endif
