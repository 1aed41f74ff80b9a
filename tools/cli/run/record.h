/// @file
/// A run in progress: what it was asked to do, where it stands, and what it has
/// counted so far. The loop writes it, progress line and summary read it.
#ifndef TWOFOLD_CLI_RECORD_H
#define TWOFOLD_CLI_RECORD_H

#include "../host/lateness.h"
#include "../host/output.h"
#include "../live/live.h"
#include "../setup/inputs.h"
#include "../setup/scheme.h"
#include "events.h"
#include "replay.h"
#include "row.h"
#include "twofold.h"

/// Why a run ended.
typedef enum {
  CLI_ENDED,        ///< all steps were taken
  CLI_INTERRUPTED,  ///< by a signal
  CLI_STEP_REFUSED, ///< by the scheme
  CLI_NOT_REPLAYED, ///< the replay is not what the board did
  CLI_NOT_WRITTEN   ///< the output failed
} cli_end_t;

typedef struct {
  const cli_setup_t *setup;
  const cli_scheme_t *scheme;
  cli_drive_t drive;
  cli_replay_t replay; ///< its simulation has inputs that hold by a command
  bool replays;        ///< instead of driving the scene
  const cli_args_t *args;
  uint64_t steps;
  double start;             ///< cli_now() at t = 0
  uint64_t late;            ///< steps that ended after the time of the next one
  double latest;            ///< largest delay among them [s]
  double began;             ///< delay of the beginning of the last step [s]
  cli_lateness_t *lateness; ///< of all steps in real time, or NULL
  uint64_t first;           ///< steps taken before this run, by another one
  uint64_t done;            ///< steps taken, by both
  uint64_t written;         ///< step of the last row
  uint32_t sequence;        ///< of the next frame
  uint32_t hash;            ///< by which frames name the run
  cli_system_t system;
  tf_report_t report; ///< of the last step that was taken
  tf_status_t status; ///< of the last step that was tried
  cli_end_t end;
  cli_events_t events;
  cli_ambiguity_t ambiguity;
  tf_tally_t tally;        ///< of the steps that were taken
  double largest_h;        ///< |h| in stick or pinned [m/s]
  double largest_residual; ///< [N]
  double seconds;          ///< wall time of the steps without the output
  double output_seconds;   ///< wall time of the output
  double idle_seconds;     ///< wall time spent waiting
  cli_output_t output;
  cli_live_t *live;       ///< the picture, or NULL
  bool rowless;           ///< the terminal shows the picture in place of rows
  cli_output_t saved;     ///< of --save
  cli_output_t late_rows; ///< of --lateness
} cli_run_t;

/// The setup as it is in effect: commands of a replay change parameters, rule
/// and seed.
cli_setup_t cli_run_setup(const cli_run_t *run);

/// Room for an option of each parameter, the rule, and the terminating zero.
#define CLI_CHANGES_ROOM 1024

/// What commands of a replay have changed, as the options, each behind a space,
/// by which another run is of the same machine.
/// Returns: the length, 0: nothing.
size_t cli_run_changes(const cli_run_t *run, char out[CLI_CHANGES_ROOM]);

/// Time after the given number of steps, rounded once [s].
double cli_run_time(const cli_run_t *run, uint64_t steps);

/// Shows the state in the picture, if there is one.
void cli_run_show(const cli_run_t *run);

/// Counts a finished step, and makes its report the last one.
/// after: in, the report of the step; run->done counts the step already.
void cli_run_observe(cli_run_t *run, const tf_report_t *after);

/// Prints it on standard error, as one line. code: in, the exit code.
void cli_summary_json(const cli_run_t *run, int code);

/// Prints it on standard error; json: as cli_summary_json does, after the
/// reason of an early end. code: in, the exit code.
void cli_summary(const cli_run_t *run, bool json, int code);

// A run that goes on where another one stands: --save and --from.

/// Saves where a run stands in the open file of --save, with the parameters,
/// the rule and the inputs that commands of a replay have left in effect. The
/// rows up to it are on disk before: their output is closed, and where it
/// failed, no state is saved.
/// path: in, of --save, NULL: it is not asked for.
/// Returns: whether that is written, or not asked for.
bool cli_run_save(cli_run_t *run, const char *path);

/// Checks that a command line does not give the start or the seed, which a file
/// does.
/// option, path: in, of the file. seed: in, that of the file.
int cli_run_check_start(const cli_args_t *args, const cli_setup_t *setup,
                        const char *option, const char *path, uint32_t seed);

/// Puts a run where the file of --from says that another one stands.
/// run: in/out, at its start. setup: in/out, takes the seed.
int cli_run_go_on(cli_run_t *run, const cli_args_t *args, cli_setup_t *setup);

#endif
