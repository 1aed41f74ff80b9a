/// @file
/// What happened to a board, as a file that `run --replay` reads: its schema,
/// the commands that took effect with the ticks at which they did, and the last
/// state, to compare with.
#ifndef TWOFOLD_CLI_SESSION_RECORD_H
#define TWOFOLD_CLI_SESSION_RECORD_H

#include "../host/output.h"
#include "../text/trailer.h"
#include "board_command.h"

typedef struct {
  cli_output_t output;
  cli_trailer_t trailer;
  bool is_open;
  bool has_schema; ///< the first one is written
  bool has_state;  ///< a state has come since the last command
  uint64_t tick;   ///< of that state
  size_t length;   ///< of its payload
  uint8_t state[TF_FRAME_PAYLOAD];
} cli_session_record_t;

/// Opens the file of --record.
int cli_session_record_open(cli_session_record_t *record, const char *path);

/// Takes note of a frame from the board.
void cli_session_record_frame(cli_session_record_t *record,
                              const tf_frame_t *frame);

/// Takes note of a command that took effect. tick: in, of its answer.
void cli_session_record_command(cli_session_record_t *record,
                                const cli_board_command_t *command,
                                bool is_float, uint64_t tick);

/// Closes the file.
/// Returns: code; CLI_STOPPED after a message if it was CLI_DONE.
int cli_session_record_close(cli_session_record_t *record, int code);

#endif
