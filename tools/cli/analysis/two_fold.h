/// @file
/// A two-fold as JSON.
#ifndef TWOFOLD_CLI_TWO_FOLD_H
#define TWOFOLD_CLI_TWO_FOLD_H

#include "../text/buffer.h"
#include "twofold.h"

/// The units of its members, for cli_analysis_begin_json(). K, J1, J2 and the
/// eigenvalues are in the paper's time.
#define CLI_TWO_FOLD_UNITS                                               \
  "\"r\": \"m\", \"v\": \"m/s\", \"omega\": \"rad/s\", \"g\": \"m/s\", " \
  "\"lambda\": \"N\", \"time_scale\": \"kg m^2\", \"physical\": \"m/s^3\""

/// Appends one two-fold as an object. margin: what every line begins with.
void cli_add_two_fold(cli_buffer_t *text, const tf_two_fold_t *at,
                      const char *margin);

#endif
