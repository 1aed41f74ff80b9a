/// @file
/// Where frames come from: a file, a pipe, a terminal or serial device.
#ifndef TWOFOLD_CLI_SOURCE_H
#define TWOFOLD_CLI_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
  const char *name;
  int descriptor;
  bool is_device; ///< a terminal: its end is a loss, not an end
  int error;      ///< errno of what went wrong, or 0
} cli_source_t;

/// What a read found.
typedef enum {
  CLI_SOURCE_BYTES, ///< at least one
  CLI_SOURCE_QUIET, ///< none within the time
  CLI_SOURCE_END,   ///< of a file or a pipe
  CLI_SOURCE_GONE   ///< the device was taken away, or an error
} cli_source_found_t;

/// Opens a path, or standard input where it is "-". A terminal is made raw.
/// baud: 0 leaves the speed as it is. both_ways: commands are to be sent.
/// Returns: whether it is open; else error is set (EINVAL: no such speed).
bool cli_source_open(cli_source_t *source, const char *path, uint64_t baud,
                     bool both_ways);

/// Waits for bytes, at most so many milliseconds.
/// count: out, how many there are.
cli_source_found_t cli_source_read(cli_source_t *source, uint8_t *bytes,
                                   size_t room, int milliseconds,
                                   size_t *count);

/// Sends bytes; waits up to a second for room.
/// Returns: whether all were taken.
bool cli_source_write(cli_source_t *source, const uint8_t *bytes,
                      size_t length);

/// Closes what was opened.
void cli_source_close(cli_source_t *source);

#endif
