/// @file
/// The rows of `monitor` as text, in the forms that plotting tools document.
#ifndef TWOFOLD_CLI_STREAM_H
#define TWOFOLD_CLI_STREAM_H

#include "../run/row.h"
#include "../text/options.h"

/// Room for the longest row.
#define CLI_STREAM_ROOM 1024

/// A form. The modes are numbers where the tool draws numbers only.
typedef struct {
  const char *name;   ///< on the command line
  const char *header; ///< the first line, may be empty
  /// Writes a row with its newlines.
  size_t (*row)(const cli_csv_t *row, char out[CLI_STREAM_ROOM]);
} cli_stream_t;

/// csv     as `twofold run` writes them: files, also for PlotJuggler
/// plotter label:value pairs on a line: the Arduino IDE's serial plotter
/// teleplot name:milliseconds:value§unit|g, one a line: Teleplot, over UDP
/// json    an object a line, seconds in "timestamp": PlotJuggler, over UDP
#define CLI_STREAMS 4
extern const cli_stream_t cli_streams[CLI_STREAMS];

#define CLI_AS_CSV 1 ///< as the arguments have it

/// Read --as and --csv into the arguments.
int cli_read_as(void *args, const cli_given_t *given);
int cli_read_csv(void *args, const cli_given_t *given);

#endif
