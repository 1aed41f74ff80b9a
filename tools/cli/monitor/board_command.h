/// Commands to a board: those of --send as frames, each after the answer to the
/// one before.
#pragma once

#include "../host/host.h"
#include "../run/session.h"
#include "receiver.h"

typedef struct {
  const char *text;         ///< as typed
  cli_session_row_t row[2]; ///< for a board in double, and for one in float
} cli_board_command_t;

typedef struct {
  cli_board_command_t list[CLI_SENDS + 1]; ///< the first is `describe`
  size_t count;
  size_t next;       ///< to be sent, or waiting for its answer
  double looked;     ///< cli_now() of the last cli_board_commands_send()
  bool waiting;      ///< for the answer to list[next]
  double deadline;   ///< cli_now() by which answer and schema must have come
  uint32_t session;  ///< that the last command named
  uint32_t sequence; ///< number of the next command
  uint32_t sent;     ///< number of the command whose answer is awaited
  uint64_t schemas;  ///< that had come when the board answered `describe`
  size_t refused;
  uint8_t key[TF_KEY_BYTES];
  cli_guard_t guard; ///< has the key, if there is one
} cli_board_commands_t;

/// Takes those of the command line, none or more, and the key.
/// commands: in/out, empty.
int cli_board_commands_open(cli_board_commands_t *commands,
                            const cli_args_t *args);

/// The line is a new one, on which no answer is awaited: with a key, the board
/// has to describe itself once more.
int cli_board_commands_again(cli_board_commands_t *commands);

/// Sends the next command, if there is one and no answer is awaited. Fails when
/// an answer or the requested schema is late; with a key, also when a heartbeat
/// is.
int cli_board_commands_send(cli_board_commands_t *commands,
                            const cli_receiver_t *receiver,
                            cli_source_t *source);

/// Where a frame is the answer that is awaited, prints the outcome of the
/// command on standard error, and records it if it changed the session.
void cli_board_commands_answer(cli_board_commands_t *commands,
                               const tf_frame_t *frame,
                               const cli_receiver_t *receiver,
                               cli_session_file_t *record);
