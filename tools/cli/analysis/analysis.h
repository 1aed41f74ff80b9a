/// @file
/// What the commands share that examine a machine without running it:
/// singularities, regions, design and atlas.
#ifndef TWOFOLD_CLI_ANALYSIS_H
#define TWOFOLD_CLI_ANALYSIS_H

#include "../host/output.h"
#include "../setup/args.h"
#include "../setup/setup.h"
#include "../text/buffer.h"

/// One of the commands, ready to compute and write.
typedef struct {
  const cli_args_t *args;
  cli_setup_t setup; ///< machine and input at t = 0
  cli_output_t output;
} cli_analysis_t;

/// Prepares the machine. finds_kappa: the command computes kappa, so a scene
/// without kappa is not refused.
int cli_analysis_begin(cli_analysis_t *a, const cli_args_t *args,
                       bool finds_kappa);

/// Where a value came from: "--set NAME=VALUE" if it was set, otherwise "scene
/// NAME".
typedef struct {
  const char *option, *text;
} cli_origin_t;
cli_origin_t cli_analysis_origin(const cli_analysis_t *a, const char *name);

/// Refuses a law without a jump at h = 0, or (with needs_moment) one without a
/// moment in stick.
int cli_analysis_needs_jump(const cli_analysis_t *a, bool needs_moment);

/// Refuses what kappa and k2 cannot be designed for: a law without a moment in
/// stick, mu = 0, and a gamma whose sine or cosine nearly vanishes.
int cli_analysis_check_design(const cli_analysis_t *a);

/// Begins an object of JSON: version, commit and number type of this program,
/// scene, hash of the parameters, and the units of what follows, as members of
/// an object.
void cli_analysis_begin_json(const cli_analysis_t *a, const char *units,
                             cli_buffer_t *text);

#endif
