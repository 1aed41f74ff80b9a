/// @file
/// What the commands that look at a machine without running it share:
/// singularities, regions, design and atlas.
#ifndef TWOFOLD_CLI_ANALYSIS_H
#define TWOFOLD_CLI_ANALYSIS_H

#include "buffer.h"
#include "host.h"
#include "setup.h"

/// What a command takes as --r and --omega.
typedef enum {
  CLI_TAKES_NOTHING,
  CLI_TAKES_POINT, ///< one number each
  CLI_TAKES_GRID   ///< A:B:N each
} cli_takes_t;

/// A value, or N of them from A to B, both included.
typedef struct {
  const char *text; ///< as typed, NULL: not given
  tf_real_t from, to;
  uint64_t count;
} cli_range_t;

/// One of the commands, ready to write.
typedef struct {
  const char *command;
  cli_takes_t takes;
  const tf_scene_t *scene;
  cli_settings_t settings;
  const char *out; ///< path, NULL: standard output
  cli_range_t r, omega;
  cli_setup_t setup; ///< machine and input at t = 0
  cli_output_t output;
} cli_analysis_t;

/// Reads the command line and prepares the machine. Where finds_kappa, a scene
/// without kappa is no obstacle: the command will find one.
/// Returns: CLI_DONE, CLI_USAGE or CLI_REFUSED (complained).
int cli_analysis_read(cli_analysis_t *a, const char *command, cli_takes_t takes,
                      bool finds_kappa, int argc, char *const argv[]);

/// "--set NAME=VALUE" where the name was set, else "scene NAME": whom to blame.
typedef struct {
  const char *option, *text;
} cli_culprit_t;
cli_culprit_t cli_analysis_culprit(const cli_analysis_t *a, const char *name);

/// Refuses a law without a jump at h = 0, or (with needs_moment) one without a
/// moment in stick. Returns: CLI_DONE or CLI_REFUSED (complained).
int cli_analysis_needs_jump(const cli_analysis_t *a, bool needs_moment);

/// Writes one text and closes.
/// Returns: CLI_DONE or CLI_STOPPED (complained).
int cli_analysis_write(cli_analysis_t *a, const char *text, size_t length);

/// Room for a row of a grid.
#define CLI_GRID_ROOM 768

/// Writes one row with its newline into out. length: out.
/// Returns: CLI_DONE, or another code (complained), which ends the grid.
typedef int (*cli_grid_row_t)(const cli_analysis_t *a, tf_real_t r,
                              tf_real_t omega, char out[CLI_GRID_ROOM],
                              size_t *length);

/// Writes header and rows, omega inner, r outer, and closes.
/// Returns: CLI_DONE, CLI_STOPPED (complained), or what a row returned.
int cli_analysis_grid(cli_analysis_t *a, const char *header,
                      cli_grid_row_t row);

/// One two-fold as a JSON object; margin stands before every line of it.
void cli_add_two_fold(cli_buffer_t *text, const tf_two_fold_t *at,
                      const char *margin);

/// The help page of one of the commands, NULL where it is none of them.
const char *cli_analysis_page(const char *command);

/// The commands: argv[0] is the first argument behind the name.
/// Returns: the exit code.
int cli_singularities(int argc, char *const argv[]);
int cli_regions(int argc, char *const argv[]);
int cli_design(int argc, char *const argv[]);
int cli_atlas(int argc, char *const argv[]);

#endif
