/// Commands to a board: those of --send as frames, each after the answer to the
/// one before.
#pragma once

#include "../run/session.h"
#include "../setup/args.h"
#include "receiver.h"

#define CLI_BOARD_COMMANDS (CLI_SENDS + 1) ///< with the first, `describe`

typedef struct {
  const char *text;      ///< as typed
  uint8_t type;          ///< tf_type_t
  uint8_t index;         ///< of a parameter, or a rule
  uint32_t seed;         ///< of a rule, or the ticks of `deadman`
  const char *number[5]; ///< as typed, converted in the real type of the board
  size_t numbers;
} cli_board_command_t;

typedef struct {
  cli_board_command_t list[CLI_BOARD_COMMANDS];
  size_t count;
  size_t next;       ///< to be sent, or waiting for its answer
  bool waiting;      ///< for the answer to list[next]
  double deadline;   ///< cli_now() by which answer and schema must have come
  uint32_t session;  ///< that the last command named
  uint32_t sequence; ///< number of the next command
  uint32_t sent;     ///< number of the command whose answer is awaited
  uint64_t schemas;  ///< that had come when the board answered `describe`
  size_t refused;
  bool has_key;
  uint8_t key[TF_KEY_BYTES];
} cli_board_commands_t;

int cli_board_commands_add(cli_board_commands_t *commands, const char *text);

/// Makes the frame of the next command, if no answer is awaited.
/// wire: out, TF_FRAME_SIZE(TF_FRAME_PAYLOAD).
/// Returns: its length, or 0.
size_t cli_board_commands_next(cli_board_commands_t *commands,
                               const cli_receiver_t *receiver, double now,
                               uint8_t *wire);

/// Whether an answer, or the schema that was asked for, has not come in time.
bool cli_board_commands_late(const cli_board_commands_t *commands,
                             const cli_receiver_t *receiver, double now);

/// Takes an answer and prints the outcome of the command on standard error.
/// row: out, the command, if it took effect and changed the session.
/// Returns: its text then, else NULL.
const char *cli_board_commands_answer(cli_board_commands_t *commands,
                                      const tf_frame_t *frame,
                                      const cli_receiver_t *receiver,
                                      cli_session_row_t *row);
