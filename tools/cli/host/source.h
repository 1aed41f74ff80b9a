/// A source of frames: a file, a pipe, a terminal or a serial device; and the
/// key of a board that takes only tagged commands.
#pragma once

#include "twofold.h"

typedef struct {
  const char *name;
  int descriptor;
  bool is_device; ///< a terminal: its end means that it was unplugged
  int error;      ///< errno of the failure, or 0
} cli_source_t;

typedef enum {
  CLI_SOURCE_BYTES, ///< at least one byte
  CLI_SOURCE_QUIET, ///< no byte within the time allowed
  CLI_SOURCE_END,   ///< end of a file or a pipe
  CLI_SOURCE_GONE   ///< the device was unplugged, or an error
} cli_source_found_t;

/// Opens a path, or standard input for "-". A terminal is put into raw mode.
/// baud: 0 leaves the speed as it is. both_ways: commands will be sent, too.
/// Returns: whether it is open; otherwise error is set (EINVAL: unknown speed).
bool cli_source_open(cli_source_t *source, const char *path, uint64_t baud,
                     bool both_ways);

/// Waits for bytes, at most the given number of milliseconds.
/// count: out, number of bytes read.
cli_source_found_t cli_source_read(cli_source_t *source, uint8_t *bytes,
                                   size_t room, int milliseconds,
                                   size_t *count);

/// Sends bytes; waits up to a second for room in the line's buffer.
/// Returns: whether all were sent.
bool cli_source_write(cli_source_t *source, const uint8_t *bytes,
                      size_t length);

void cli_source_close(cli_source_t *source);

/// Reads a key from a file, for an argument would stand in the list of
/// processes: 32 hexadecimal digits, with nothing behind them but white space.
/// The file's owner alone may read it.
/// Returns: NULL; or what is wrong with the file.
const char *cli_read_key(const char *path, uint8_t key[TF_KEY_BYTES]);
