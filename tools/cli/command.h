/// @file
/// Commands from `monitor` to a board: what --send says, as frames, one after
/// the other, each after the answer to the one before.
#ifndef TWOFOLD_CLI_COMMAND_H
#define TWOFOLD_CLI_COMMAND_H

#include "picture.h"

#define CLI_COMMANDS 16 ///< that one command line may hold

typedef struct {
  const char *text;      ///< as typed
  uint8_t type;          ///< tf_type_t
  uint8_t index;         ///< of a parameter, or a rule
  uint32_t seed;         ///< of a rule
  const char *number[4]; ///< as typed, read in the real type of the board
  size_t numbers;
} cli_command_t;

typedef struct {
  cli_command_t list[CLI_COMMANDS];
  size_t count;
  size_t next;       ///< to be sent, or waited for
  bool waiting;      ///< for the answer to list[next]
  double deadline;   ///< cli_now() by which it must be there
  uint16_t sequence; ///< of the next frame that goes up
  size_t refused;
} cli_commands_t;

/// Reads one --send.
/// Returns: CLI_DONE or CLI_USAGE (complained).
int cli_commands_add(cli_commands_t *commands, const char *text);

/// Makes the frame of the next command, if it is its turn.
/// wire: out, TF_FRAME_SIZE(TF_FRAME_PAYLOAD).
/// Returns: its length, or 0.
size_t cli_commands_next(cli_commands_t *commands, const cli_picture_t *picture,
                         double now, uint8_t *wire);

/// Takes an answer and tells on standard error what became of the command.
void cli_commands_answer(cli_commands_t *commands, const tf_frame_t *frame,
                         const cli_picture_t *picture);

#endif
