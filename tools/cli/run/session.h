/// What happened to a board, as a file of `monitor --record` that
/// `run --replay` reads: the schema, the commands that took effect, inputs that
/// expired, and the last state, by which a replay is found to be the same
/// throughout.
#pragma once

#include "../host/output.h"
#include "twofold.h"

/// A frame of the session.
typedef struct {
  uint64_t tick;
  uint8_t type, length;
  uint8_t data[TF_FRAME_PAYLOAD]; ///< of a command without its session and tag
} cli_session_row_t;

/// The file while it is written.
typedef struct {
  cli_output_t output;
  bool is_open;
  uint64_t rows;
  uint32_t crc;
  cli_session_row_t state; ///< the last one since the last command, or length 0
} cli_session_file_t;

int cli_session_open(cli_session_file_t *file, const char *path,
                     cli_begin_t how);

/// Takes note of a frame from the board.
void cli_session_frame(cli_session_file_t *file, const tf_frame_t *frame);

/// Takes note of a command that took effect. text: in, as typed.
void cli_session_command(cli_session_file_t *file, const cli_session_row_t *row,
                         const char *text);

/// Returns: as cli_output_end.
int cli_session_close(cli_session_file_t *file, int code);

/// The file as it was read.
typedef struct {
  const char *name;
  uint32_t hash; ///< CRC-32 of its lines
  cli_session_row_t schema;
  cli_session_row_t *rows; ///< from the heap, the caller's to free
  size_t count, room;
} cli_session_t;

/// Reads a whole file. session: in/out, empty. path: in, kept.
int cli_session_read(cli_session_t *session, const char *path);
