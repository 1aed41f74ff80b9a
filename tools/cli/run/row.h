/// @file
/// One row: an instant of the motion as text.
#ifndef TWOFOLD_CLI_ROW_H
#define TWOFOLD_CLI_ROW_H

#include <stdbool.h>
#include <stddef.h>

#include "../setup/args.h"
#include "twofold.h"

/// How a row is written.
typedef enum {
  CLI_FORMAT_CSV,
  CLI_FORMAT_PLOTTER,
  CLI_FORMAT_FRAMES
} cli_format_t;

/// Room for the longest row or header.
#define CLI_ROW_ROOM 1024

/// A row of CSV in numbers: t r v omega h g F M.
#define CLI_CSV_COLUMNS 8
#define CLI_CSV_HEADER "t,r,v,omega,h,g,F,M,mode,choices\n"
#define CLI_CSV_UNITS "t s, r m, v m/s, omega rad/s, h m/s, g m/s, F N, M N m"
typedef struct {
  double column[CLI_CSV_COLUMNS];
  size_t columns; ///< how many are known; the others stay empty
  bool is_float;  ///< the numbers are floats
  unsigned mode, choices;
} cli_csv_t;

/// Names and units of those columns.
extern const cli_quantity_t cli_csv_columns[CLI_CSV_COLUMNS];

/// The forms of a row. The modes are numbers where the tool draws numbers only;
/// what a frame does not carry is left out, or left empty in CSV.
///   csv      files, also for PlotJuggler
///   plotter  "r:0.18 v:1.2 omega:-1.037 h:1e-10 g:0.05 mode:3 choices:1", for
///            the plotter of the Arduino IDE: a board's labels
///   teleplot name:milliseconds:value§unit|g, one a line: Teleplot, over UDP
///   json     an object a line, seconds in "timestamp": PlotJuggler, over UDP
typedef struct {
  const char *header; ///< the first line, may be empty
  /// Writes a row with its newlines.
  size_t (*row)(const cli_csv_t *row, char out[CLI_ROW_ROOM]);
} cli_stream_t;

/// In the order of cli_format_t, but for frames, and of --as.
extern const cli_stream_t cli_streams[];

/// Writes one row with its newline. format: CSV or PLOTTER.
size_t cli_row(cli_format_t format, tf_real_t t, const tf_state_t *state,
               const tf_report_t *report, char out[CLI_ROW_ROOM]);

/// Room for the frames of one call.
#define CLI_FRAMES_ROOM (4 * TF_FRAME_SIZE(TF_FRAME_PAYLOAD))

/// Writes what comes before the first row: schema and layouts.
/// tick: in, of the first row. sequence: in/out, of the frames.
size_t cli_frames_header(const cli_setup_t *setup, const cli_scheme_t *scheme,
                         uint64_t tick, uint32_t *sequence,
                         uint8_t out[CLI_FRAMES_ROOM]);

/// Writes a row: state and report. source: in, whose inputs the step had.
size_t cli_frames_row(uint32_t *sequence, const tf_state_t *state,
                      const tf_report_t *report, tf_input_source_t source,
                      uint8_t out[CLI_FRAMES_ROOM]);

/// Writes what comes after the last row: a heartbeat with the counts of the
/// run. A run has no clock that ticks, so its times are 0.
/// steps: in, that this run took. late: in, of these in real time.
size_t cli_frames_end(uint32_t *sequence, uint64_t tick, uint64_t steps,
                      uint64_t late, const tf_tally_t *tally,
                      uint8_t out[CLI_FRAMES_ROOM]);

/// The last field of the first row of a record: another version of the protocol
/// has other commands.
#define CLI_TEXT_OF(number) #number
#define CLI_SCHEMA_OF(version) "schema of version " CLI_TEXT_OF(version)
#define CLI_RECORD_SCHEMA CLI_SCHEMA_OF(TF_FRAME_VERSION)

#endif
