/// One row: an instant of the motion as text.
#pragma once

#include "../../columns.h"
#include "../host/output.h"
#include "../setup/args.h"

/// How a row is written.
typedef enum {
  CLI_FORMAT_CSV,
  CLI_FORMAT_FRAMES,
  CLI_FORMAT_JSON,
  CLI_FORMAT_PLOTTER,
  CLI_FORMAT_TELEPLOT,
  CLI_FORMATS
} cli_format_t;

/// Room for the longest row or header.
#define CLI_ROW_ROOM 1024

/// The numbers of a row of CSV.
#define CLI_CSV_NUMBERS(first, next) EACH_COLUMN(first, next, COLUMN_NONE)
#define CLI_CSV_UNIT(name, unit, value) #name " " unit
#define CLI_CSV_NEXT_UNIT(name, unit, value) ", " #name " " unit
#define CLI_CSV_INDEX(name, unit, value) CLI_CSV_##name,

/// The units, and how many numbers.
#define CLI_CSV_UNITS CLI_CSV_NUMBERS(CLI_CSV_UNIT, CLI_CSV_NEXT_UNIT)
enum { CLI_CSV_NUMBERS(CLI_CSV_INDEX, CLI_CSV_INDEX) CLI_CSV_COLUMNS };
extern const cli_quantity_t cli_csv_columns[CLI_CSV_COLUMNS];

typedef struct {
  double column[CLI_CSV_COLUMNS];
  bool is_float; ///< the numbers are floats
  unsigned mode, choices, set;
} cli_csv_t;

/// The form of a row. The modes are numbers where the tool draws numbers only.
typedef struct {
  const char *header; ///< the first line, may be empty
  /// Appends a row with its newlines.
  void (*row)(const cli_csv_t *row, cli_buffer_t *text);
} cli_stream_t;

/// By cli_format_t; frames are no text, and have none.
extern const cli_stream_t cli_streams[CLI_FORMATS];

/// The row of a state.
cli_csv_t cli_row(tf_real_t t, const tf_state_t *state,
                  const tf_report_t *report);

/// The last field of the first row of a record: another version of the protocol
/// has other commands.
#define CLI_TEXT_OF(number) #number
#define CLI_SCHEMA_OF(version) "schema of version " CLI_TEXT_OF(version)
#define CLI_RECORD_SCHEMA CLI_SCHEMA_OF(TF_FRAME_VERSION)
