/// @file
/// The command `run`, in its parts: what was asked for, the loop, the rows,
/// the progress line and the summary.
#ifndef TWOFOLD_CLI_RUN_H
#define TWOFOLD_CLI_RUN_H

#include <stdbool.h>
#include <stdint.h>

#include "events.h"
#include "host.h"
#include "setup.h"

/// How a row is written.
typedef enum {
  CLI_FORMAT_CSV,
  CLI_FORMAT_PLOTTER,
  CLI_FORMAT_FRAMES
} cli_format_t;

/// What moves: the machine and its state, with the digits that the compensated
/// scheme adds to both; other schemes leave those 0.
typedef struct {
  tf_compensated_t machine;
  tf_state_t state;
  tf_compensation_t carry;
} cli_body_t;

/// One step of a scheme.
typedef tf_status_t (*cli_step_t)(cli_body_t *body, const tf_input_t *input,
                                  tf_report_t *report);

/// How a run steps.
typedef struct {
  const char *name; ///< as on the command line
  uint8_t code;     ///< as in the schema frame
  cli_step_t step;
  unsigned laws;    ///< bit set of tf_tyre_law_t that it takes
  const char *idle; ///< name of a parameter that it leaves aside ...
  const char *why;  ///< ... and where: the end of "has no effect ..."
} cli_scheme_t;

#define CLI_SCHEMES 3
/// The first is the default.
extern const cli_scheme_t cli_schemes[CLI_SCHEMES];

/// Puts a body where the setup begins; the compensated scheme with all digits
/// of a start that was placed by its slip speed.
/// report: in/out, of tf_begin.
void cli_body_begin(cli_body_t *body, const cli_scheme_t *scheme,
                    const cli_setup_t *setup, tf_report_t *report);

/// Most steps of a run, and between two rows: counted exactly by a double.
#define CLI_MOST_STEPS 1000000000000000u

/// The command line of `run`, read and validated.
typedef struct {
  const tf_scene_t *scene;
  const cli_scheme_t *scheme;
  cli_settings_t settings;
  const char *select; ///< RULE[:SEED], NULL: the scene's own rule
  const char *out;    ///< path, NULL: standard output
  cli_format_t format;
  uint64_t every;         ///< steps a row, >= 1
  uint64_t listed;        ///< events told in detail
  bool real_time;         ///< a step waits for its time
  tf_real_t t_end;        ///< [s]
  const char *t_end_text; ///< as typed, NULL: the scene's own
} cli_run_args_t;

/// Reads the arguments behind `run`.
/// Returns: CLI_DONE, CLI_USAGE or CLI_REFUSED (complained).
int cli_run_args(cli_run_args_t *args, int argc, char *const argv[]);

/// Why a run ended.
typedef enum {
  CLI_ENDED,        ///< all steps were taken
  CLI_INTERRUPTED,  ///< by a signal
  CLI_STEP_REFUSED, ///< by the scheme
  CLI_NOT_WRITTEN   ///< the output failed
} cli_end_t;

/// A run while it goes on.
typedef struct {
  const cli_setup_t *setup;
  const cli_scheme_t *scheme;
  cli_format_t format;
  uint64_t every, steps;
  bool real_time;    ///< step n is taken n dt after the start
  double start;      ///< cli_now() at t = 0
  uint64_t late;     ///< steps that were done after the time of the next one
  double latest;     ///< by how much at most [s]
  uint64_t done;     ///< steps taken
  uint64_t written;  ///< the last row's step
  uint16_t sequence; ///< of the next frame
  cli_body_t body;
  tf_report_t report; ///< of the last step that was taken
  tf_status_t status; ///< of the last step that was tried
  cli_end_t end;
  cli_events_t events;
  uint64_t open_steps;   ///< with more than one possible future
  double open_since;     ///< time of the first of them [s]
  uint64_t degraded;     ///< steps without a consistent mode
  uint64_t coarse;       ///< located steps that missed their tolerance
  uint64_t fell_back;    ///< located steps taken by tf_step, none degraded
  double largest_h;      ///< |h| in stick or pinned [m/s]
  double largest_rest;   ///< residual [N]
  double seconds;        ///< wall time of the steps, output left out
  double output_seconds; ///< wall time of the output
  double idle_seconds;   ///< wall time spent waiting
  cli_output_t output;
} cli_run_t;

/// Time after so many steps, rounded once.
double cli_run_time(const cli_run_t *run, uint64_t steps);

/// Room for the longest row or header.
#define CLI_ROW_ROOM 512

/// A row of CSV in numbers: t r v omega h g F M.
#define CLI_CSV_COLUMNS 8
typedef struct {
  double column[CLI_CSV_COLUMNS];
  size_t columns; ///< known, the rest stays empty
  bool is_float;  ///< the type that the numbers have
  unsigned mode, choices;
} cli_csv_t;

/// Writes a row of CSV with its newline.
/// Returns: the length.
size_t cli_csv_row(const cli_csv_t *row, char out[CLI_ROW_ROOM]);

/// Writes the header of a format, which may be empty.
/// Returns: the length.
size_t cli_header(cli_format_t format, char out[CLI_ROW_ROOM]);

/// Writes one row with its newline.
/// Returns: the length.
size_t cli_row(cli_format_t format, tf_real_t t, const tf_state_t *state,
               const tf_report_t *report, char out[CLI_ROW_ROOM]);

/// How far the run has come, for a person who waits.
typedef struct {
  bool silent;    ///< rows go to the same terminal
  bool one_line;  ///< standard error is a terminal: the line is overwritten
  bool shown;     ///< a line stands there
  double started; ///< cli_now()
  double next;    ///< cli_now() of the next message
} cli_progress_t;
cli_progress_t cli_progress_start(double now, int output);
void cli_progress_poll(cli_progress_t *progress, double now,
                       const cli_run_t *run);
void cli_progress_clear(cli_progress_t *progress);

/// Tells what the run added up to, on standard error.
void cli_summary(const cli_run_t *run);

/// The command: argv[0] is the first argument behind `run`.
/// Returns: the exit code.
int cli_run(int argc, char *const argv[]);

#endif
