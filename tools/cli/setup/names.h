/// @file
/// Names of laws and rules, as typed on the command line.
#ifndef TWOFOLD_CLI_NAMES_H
#define TWOFOLD_CLI_NAMES_H

#include <stddef.h>
#include <stdint.h>

#include "twofold.h"

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

/// Reads RULE[:SEED] of --select. Without SEED, seed is left as it is.
/// Returns: CLI_DONE, or CLI_USAGE after a message.
int cli_read_rule(const char *select, tf_rule_t *rule, uint32_t *seed);

#endif
