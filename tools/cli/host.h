/// @file
/// What the program needs of POSIX: a clock, the wish to stop, a file that
/// tells the truth about its writes.
#ifndef TWOFOLD_CLI_HOST_H
#define TWOFOLD_CLI_HOST_H

#include <stdbool.h>
#include <stddef.h>

/// Seconds of a clock that never goes back.
double cli_now(void);

/// Waits; a signal ends it early.
void cli_sleep(int milliseconds);

/// Waits until cli_now() has reached a time; a wish to stop ends it early.
void cli_wait_until(double time);

/// Whether a descriptor is a terminal.
bool cli_is_terminal(int descriptor);

/// Occupies closed standard descriptors, so that no opened file takes their
/// number and receives messages; writing to them still fails.
void cli_guard_descriptors(void);

/// From now on SIGINT and SIGTERM ask for a stop (the second one kills), and a
/// closed pipe or a full file quota is an error of write, not a signal.
void cli_catch_signals(void);

/// Whether a stop was asked for.
bool cli_stop_asked(void);

/// Rows on their way to a file, in whole lines.
#define CLI_OUTPUT_ROOM 65536
typedef struct {
  const char *name; ///< for messages
  int descriptor;
  int error;      ///< errno of the first failure, 0 while all is well
  double flushed; ///< cli_now() of the last flush
  char last;      ///< byte that ends a row: newline unless set otherwise
  size_t used;
  char buffer[CLI_OUTPUT_ROOM];
} cli_output_t;

/// Opens a file for writing, or standard output where path is NULL or "-".
/// Returns: whether it is open; else error is set.
bool cli_output_open(cli_output_t *output, const char *path);

/// Opens it for a command: from now on signals are caught as by
/// cli_catch_signals. option: that named the path, for the complaint.
/// Returns: CLI_DONE or CLI_STOPPED (complained).
int cli_output_begin(cli_output_t *output, const char *option,
                     const char *path);

/// Closes it for a command. Returns: CLI_DONE or CLI_STOPPED (complained).
int cli_output_end(cli_output_t *output);

/// What went wrong, in words; output->error is not 0.
const char *cli_output_reason(const cli_output_t *output);

/// Appends one or more whole lines, at most CLI_OUTPUT_ROOM bytes.
/// Returns: whether all is well so far; once false, nothing more is written.
bool cli_output_lines(cli_output_t *output, const char *lines, size_t length);

/// Hands everything to the system.
/// Returns: as above.
bool cli_output_flush(cli_output_t *output);

/// Flushes, asks the disk to hold it, and closes (not standard output).
/// Returns: as above.
bool cli_output_close(cli_output_t *output);

#endif
