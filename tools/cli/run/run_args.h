/// @file
/// The command line of `run`.
#ifndef TWOFOLD_CLI_RUN_ARGS_H
#define TWOFOLD_CLI_RUN_ARGS_H

#include "../setup/drive.h"
#include "../setup/scheme.h"
#include "../setup/settings.h"
#include "row.h"

/// The command line, read and validated.
typedef struct {
  const tf_scene_t *scene;
  const cli_scheme_t *scheme;
  cli_settings_t settings;
  const char *select; ///< RULE[:SEED], NULL: the scene's own rule
  const char *out;    ///< path, NULL: standard output
  const char *from;   ///< path of a state to go on from, or NULL
  const char *save;   ///< path that the last state goes to, or NULL
  const char *replay; ///< path of a record, or NULL
  bool json;          ///< the summary is for programs
  bool provenance;    ///< the rows begin with comments: what they are of
  cli_drive_args_t drive;
  cli_format_t format;
  uint64_t every;         ///< steps between two rows, >= 1
  uint64_t listed;        ///< number of events that the summary lists
  bool live;              ///< a picture in the terminal
  bool real_time;         ///< every step waits for its time on the clock
  bool priority;          ///< of real time, with locked memory
  const char *lateness;   ///< path of its histogram, or NULL
  tf_real_t t_end;        ///< [s]
  const char *t_end_text; ///< as typed, NULL: the scene's own
} cli_run_args_t;

/// Reads the arguments after `run`.
/// Returns: CLI_DONE; after a message CLI_USAGE or CLI_REFUSED.
int cli_run_args(cli_run_args_t *args, int argc, char *const argv[]);

#endif
