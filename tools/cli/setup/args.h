/// What a command line gives: a member for each option, whichever commands take
/// it. The table of options fills it and has the usual values; what was not
/// given is 0 otherwise. And the commands, which get it.
#pragma once

#include "inputs.h"

#define CLI_AXES 8     ///< of a sweep, at most
#define CLI_COLUMNS 32 ///< columns of a sweep, at most
#define CLI_SENDS 15   ///< commands to a board, at most

/// What is swept: a name of --set, or the seed of rule random.
typedef struct {
  const char *name;
  cli_range_t range; ///< its text is NAME=A:B:N, as typed
  bool is_seed;      ///< not among the settings
  size_t setting;    ///< index in the settings
} cli_axis_t;

/// Paths are NULL where they were not given; "-" is standard output.
typedef struct {
  const char *command; ///< its name
  const tf_scene_t *scene;
  const char *source; ///< of monitor: a file or a device

  // The machine and its motion.
  cli_settings_t settings; ///< axes are among them, under --over
  const char *select;      ///< RULE[:SEED], NULL: the scene's own rule
  cli_range_t t_end;       ///< one number; text NULL: the scene's own [s]
  const char *inputs;      ///< a table, NULL: none
  unsigned between;        ///< between its rows: 1 linear, or CLI_NOT_GIVEN
  cli_range_t r, omega;    ///< a point or a grid; of tyre r is the angle

  // What is written.
  const char *out;
  uint64_t every;  ///< steps between two rows
  uint64_t listed; ///< number of events that the summary lists
  cli_shard_t shard;

  // Of run, and of monitor.
  const char *from, *save; ///< states: to go on from, and the last one
  const char *replay, *record;
  const char *lateness; ///< histogram
  uint64_t baud;        ///< 0: unchanged
  const char *key;
  const char *send[CLI_SENDS];
  size_t sends;

  // Of sweep.
  cli_axis_t axis[CLI_AXES];
  size_t axes;
  uint64_t points; ///< product of the axes
  uint64_t jobs;   ///< processes; 0: one a processor
  unsigned measure[CLI_COLUMNS];
  size_t measures;

  double accuracy; ///< of a step of moreau; 0: not estimated

  // Of diverge.
  const char *exits, *returns, *branches;
  double size;              ///< unit: that of the mechanism; 0: not given
  double spread;            ///< sizes are drawn from [size / spread, size]
  double patience;          ///< longest cycle [s]
  double refinement;        ///< dt / step near the two-fold
  double fine;              ///< 1 / error of a step of noise at h = g = 0
  double grid;              ///< of --exhaustive: time between two exits [s]
  uint64_t samples, cycles; ///< cycles: of each sample, at most
  uint64_t depth, nodes;    ///< bounds of --exhaustive
  uint64_t seed;            ///< < 2^32

  // Words and switches of all of them.
  unsigned scheme;     ///< motion_scheme_t; MOTION_SCHEMES: none
  unsigned format;     ///< cli_format_t; of monitor CLI_NOT_GIVEN: no rows
  unsigned summary;    ///< 1: for programs
  unsigned mechanism;  ///< cli_mechanism_t
  unsigned codim2;     ///< cli_codim2_choice_t
  bool provenance;     ///< the rows begin with comments: what they are of
  bool resume, header; ///< goes on with what is there; a header in each shard
  bool real_time, priority, live;
  bool follow, quiet;
  bool glance; ///< nobody asked for a format
  bool exhaustive;
} cli_args_t;

// The commands that take options. A check is of options that need or exclude
// each other, and sets what depends on others; a reader is of the value of one
// option, or of a positional argument.

int cli_singularities(const cli_args_t *args);
int cli_regions(const cli_args_t *args);
int cli_design(const cli_args_t *args);
int cli_atlas(const cli_args_t *args);
int cli_analysis_check(cli_args_t *args);
int cli_tyre(const cli_args_t *args);
int cli_run(const cli_args_t *args);
int cli_run_check(cli_args_t *args);
int cli_monitor(const cli_args_t *args);
int cli_monitor_check(cli_args_t *args);
int cli_read_send(cli_args_t *args, const cli_given_t *given);
int cli_diverge(const cli_args_t *args);
int cli_diverge_check(cli_args_t *args);
int cli_sweep(const cli_args_t *args);
int cli_sweep_check(cli_args_t *args);
int cli_read_over(cli_args_t *args, const cli_given_t *given);
int cli_read_outcome(cli_args_t *args, const cli_given_t *given);
