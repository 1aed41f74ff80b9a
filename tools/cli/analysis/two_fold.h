/// @file
/// A two-fold as JSON.
#ifndef TWOFOLD_CLI_TWO_FOLD_H
#define TWOFOLD_CLI_TWO_FOLD_H

#include "../text/buffer.h"
#include "twofold.h"

/// Appends one two-fold as an object. margin: what every line begins with.
void cli_add_two_fold(cli_buffer_t *text, const tf_two_fold_t *at,
                      const char *margin);

#endif
