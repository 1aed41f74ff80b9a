/// Commands to a board: those of --send as frames, each after the answer to the
/// one before. And what happened to it, as a file that `run --replay` reads.
#pragma once

#include "../host/output.h"
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
  uint64_t schemas;  ///< that had come when the board was asked for one
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
/// Returns: the command if it took effect, else NULL.
const cli_board_command_t *cli_board_commands_answer(
    cli_board_commands_t *commands, const tf_frame_t *frame,
    const cli_receiver_t *receiver);

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

int cli_session_record_open(cli_session_record_t *record, const char *path);

void cli_session_record_frame(cli_session_record_t *record,
                              const tf_frame_t *frame);

/// Takes note of a command that took effect. tick: in, of its answer.
void cli_session_record_command(cli_session_record_t *record,
                                const cli_board_command_t *command,
                                bool is_float, uint64_t tick);

/// Returns: as cli_output_end.
int cli_session_record_close(cli_session_record_t *record, int code);
