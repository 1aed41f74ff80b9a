/// A run in progress: what it was asked to do, where it stands, and what it has
/// counted so far. The loop writes it, progress line and summary read it.
#pragma once

#include "../live/live.h"
#include "events.h"
#include "session.h"

// What a board did, from a record of `monitor --record`: each command takes
// effect after the step at which it did there, by the functions that the board
// calls, so the motion has the board's bits.

typedef struct {
  cli_session_t session; ///< its rows are the caller's to free
  size_t next;           ///< row to come
  tf_simulation_t simulation;
  tf_link_t link;
  uint32_t sequence;
  uint64_t commands;  ///< that took effect
  uint64_t states;    ///< that were compared
  const char *failed; ///< why the replay is not the simulation, or NULL
} cli_replay_t;

/// Reads a record. replay: in/out, empty. path: in, kept. setup: in/out, takes
/// the board's scheme where none is chosen.
int cli_replay_read(cli_replay_t *replay, const char *path, cli_setup_t *setup);

/// Begins it at the start of a setup, which takes the seed of the board, and
/// has to be of its machine, scheme and number type.
/// steps: out, how many the record has.
int cli_replay_begin(cli_replay_t *replay, cli_setup_t *setup, uint64_t *steps);

/// Applies what is due before the next step of a system, and finds the inputs
/// of that step.
/// report: in/out, of the last step; where a command puts another state in the
/// place of the one that it led to, that of the other state.
/// Returns: whether there is a next step; not where replay->failed is set.
bool cli_replay_next(cli_replay_t *replay, motion_t *system,
                     const tf_scene_t *scene, tf_report_t *report,
                     tf_input_t *input);

/// Room for the text of a file.
#define CLI_STATE_BYTES 8192

/// Where a run stands, and from which another run goes on bit for bit.
typedef struct {
  tf_state_t state;
  tf_compensation_t compensation;
  tf_report_t report;   ///< of the last step, or of the start
  uint32_t inputs;      ///< cli_inputs_hash of what drove it
  tf_simulation_t held; ///< its inputs by a command, and how long they hold;
                        ///< none under TF_INPUT_SCENE
  uint32_t hash;        ///< CRC-32 of the text that it was read from
} cli_stand_t;

/// Writes it as text. setup: in, whose machine and scene it belongs to.
size_t cli_state_print(const cli_stand_t *stand, const cli_setup_t *setup,
                       char out[CLI_STATE_BYTES]);

/// Reads it from text. The machine, the profile of the scene, the scheme and
/// the number type have to be those with which it was written, bit for bit.
/// text: in/out, size bytes and a zero behind them; it is cut into lines.
/// setup: in/out, its parameters, which need not be prepared; it takes the
/// scheme of the text where none is chosen.
int cli_state_parse(cli_stand_t *stand, const char *path, char *text,
                    size_t size, cli_setup_t *setup);

/// Reads it from a file, likewise.
int cli_state_read(cli_stand_t *stand, const char *path, cli_setup_t *setup);

#define CLI_LATENESS_BINS 10000u ///< [us]; the last one counts what is later

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
  cli_stand_t from; ///< where it starts, under --from
  cli_drive_t drive;
  cli_replay_t replay; ///< its simulation has inputs that hold by a command
  bool replays;        ///< instead of driving the scene
  const cli_args_t *args;
  uint64_t steps;
  double start;  ///< cli_now() at t = 0
  uint64_t late; ///< steps that ended after the time of the next one
  double latest; ///< largest delay among them [s]
  double began;  ///< delay of the beginning of the last step [s]
  /// Steps in real time by how late they began and ended: bins of 1 us, as
  /// cyclictest of rt-tests prints them.
  uint64_t began_late[CLI_LATENESS_BINS + 1], ended_late[CLI_LATENESS_BINS + 1];
  uint64_t first;     ///< steps taken before this run, by another one
  uint64_t done;      ///< steps taken, by both
  uint64_t written;   ///< step of the last row
  bool glance;        ///< the rows are for a person who looks
  motion_t system;    ///< after the last step that was taken
  tf_status_t status; ///< of the last step that was tried
  cli_end_t end;
  cli_events_t events;
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

/// Time after the given number of steps, rounded once [s].
static inline double cli_run_time(const cli_run_t *run, uint64_t steps) {
  return (double)steps * (double)run->setup->machine.dt;
}

/// What its rows are of, as cli_provenance.
size_t cli_run_provenance(const cli_run_t *run, const char *units,
                          char lines[CLI_PROVENANCE_ROOM]);

/// Writes what comes before the rows, a row of where it stands, and what comes
/// after them. What fails to be written sets run->end.
void cli_rows_begin(cli_run_t *run);
void cli_rows_add(cli_run_t *run);
void cli_rows_end(cli_run_t *run);

/// Writes the schema and the layouts of its frames.
void cli_rows_schema(cli_run_t *run);

/// Prints it on standard error; json: as one line, after the reason of an early
/// end. code: in, the exit code.
void cli_summary(const cli_run_t *run, bool json, int code);
