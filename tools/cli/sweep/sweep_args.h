/// @file
/// The command line of `sweep`.
#ifndef TWOFOLD_CLI_SWEEP_ARGS_H
#define TWOFOLD_CLI_SWEEP_ARGS_H

#include "../setup/drive.h"
#include "../setup/scheme.h"
#include "../setup/settings.h"
#include "../text/range.h"
#include "../text/shard.h"
#include "measure.h"

#define CLI_AXES 8

/// What is swept: a name of --set, or the seed of rule random.
typedef struct {
  char name[CLI_NAME_ROOM];
  cli_range_t range; ///< its text is NAME=A:B:N, as typed
  bool is_seed;      ///< not among the settings
  size_t setting;    ///< index in the settings
} cli_axis_t;

/// The command line, read and validated except for the machine.
typedef struct {
  const tf_scene_t *scene;
  const cli_scheme_t *scheme;
  cli_settings_t settings; ///< the axes are among them, under --over
  cli_drive_args_t drive_args;
  cli_drive_t drive;      ///< of those
  const char *select;     ///< RULE[:SEED], NULL: the scene's own rule
  const char *out;        ///< path, NULL: standard output
  tf_real_t t_end;        ///< [s]
  const char *t_end_text; ///< as typed, NULL: the scene's own
  cli_axis_t axis[CLI_AXES];
  size_t axes;
  uint64_t points; ///< product of the axes
  cli_measure_t measure[CLI_MEASURES];
  size_t measures;
  cli_shard_t shard;
  bool resume;
  bool json; ///< the summary
} cli_sweep_args_t;

/// Reads the arguments after `sweep`, and the table of --inputs.
/// args: out; its drive is to be freed, whatever is returned.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_sweep_args(cli_sweep_args_t *args, int argc, char *const argv[]);

#endif
