// Commands to a board. Names and numbers are checked before anything is opened;
// ranges are checked by the board, which knows its parameters. A number is
// converted to the real type of the board when it is sent: it is rounded once,
// from its decimals.

#include "board_command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../setup/names.h"
#include "../text/closest.h"
#include "../text/message.h"
#include "../text/number.h"

#define PATIENCE 3.0 // for an answer [s]

static const struct {
  const char *name;
  uint8_t type;
} plain[] = {{"describe", TF_UP_DESCRIBE}, {"start", TF_UP_START},
             {"stop", TF_UP_STOP},         {"reset", TF_UP_RESET},
             {"snapshot", TF_UP_SNAPSHOT}, {"restore", TF_UP_RESTORE},
             {"clear", TF_UP_CLEAR},       {"input", TF_UP_INPUT}};
#define PLAIN (sizeof plain / sizeof plain[0])

static int refuse(const char *text, const char *why) {
  return cli_message(CLI_USAGE, "--send %s: %s", text, why);
}

// Whether the first `length` characters of the text are the name.
static bool is_name(const char *name, const char *text, size_t length) {
  return strlen(name) == length && strncmp(name, text, length) == 0;
}

static int read_set(cli_board_command_t *command, const char *rest) {
  const size_t length = strcspn(rest, "=");
  const char *why = "";
  tf_real_t value = 0;
  unsigned i = 0;
  while (i < TF_PARAMETERS &&
         !is_name(tf_parameter_ranges[i].name, rest, length)) {
    i++;
  }
  if (i == TF_PARAMETERS || rest[length] != '=') {
    return refuse(command->text,
                  "expected set:NAME=VALUE with the name of a "
                  "parameter ('twofold help run')");
  }
  command->type = TF_UP_PARAMETER;
  command->index = (uint8_t)i;
  command->number[0] = rest + length + 1;
  return cli_read_real(command->number[0], &value, &why)
             ? CLI_DONE
             : refuse(command->text, why);
}

static int read_select(cli_board_command_t *command, const char *rest) {
  const size_t length = strcspn(rest, ":");
  uint64_t seed = 0;
  unsigned i = 0;
  while (i < TF_RULES && !is_name(cli_rule_name((tf_rule_t)i), rest, length)) {
    i++;
  }
  const bool seed_is_good =
      rest[length] == '\0' ||
      cli_read_whole(rest + length + 1, 0, UINT32_MAX, &seed);
  if (i == TF_RULES || !seed_is_good) {
    return refuse(command->text,
                  "expected select:RULE[:SEED] with one of persist, slip+, "
                  "slip-, random");
  }
  command->type = TF_UP_RULE;
  command->index = (uint8_t)i;
  command->seed = (uint32_t)seed;
  return CLI_DONE;
}

// Four numbers separated by commas; cli_read_real takes one at a time.
static int read_input(cli_board_command_t *command, const char *rest) {
  command->type = TF_UP_INPUT;
  for (command->numbers = 0; command->numbers < 4; command->numbers++) {
    char number[CLI_REAL_ROOM];
    const size_t length = strcspn(rest, ",");
    const char *why = "";
    tf_real_t value = 0;
    (void)snprintf(number, sizeof number, "%.*s",
                   (int)(length < sizeof number ? length : sizeof number - 1),
                   rest);
    command->number[command->numbers] = rest;
    const bool last = command->numbers == 3;
    if (length >= sizeof number || !cli_read_real(number, &value, &why) ||
        (rest[length] == ',') == last) {
      return refuse(command->text,
                    "expected input:OMEGA0,R0,FORCE,TORQUE in numbers");
    }
    rest += length + 1;
  }
  return CLI_DONE;
}

int cli_board_commands_add(cli_board_commands_t *commands, const char *text) {
  if (commands->count == CLI_BOARD_COMMANDS) {
    return refuse(text, "too many commands for one line");
  }
  cli_board_command_t *command = &commands->list[commands->count];
  commands->count++;
  *command = (cli_board_command_t){.text = text};
  for (size_t i = 0; i < PLAIN; i++) {
    if (strcmp(text, plain[i].name) == 0) {
      command->type = plain[i].type;
      return CLI_DONE;
    }
  }
  if (strncmp(text, "set:", 4) == 0) {
    return read_set(command, text + 4);
  }
  if (strncmp(text, "select:", 7) == 0) {
    return read_select(command, text + 7);
  }
  if (strncmp(text, "input:", 6) == 0) {
    return read_input(command, text + 6);
  }
  cli_closest_t closest = cli_closest_to(text);
  for (size_t i = 0; i < PLAIN; i++) {
    cli_closest_offer(&closest, plain[i].name);
  }
  const cli_hint_t hint = cli_closest_hint(&closest);
  return cli_message(CLI_USAGE,
                     "--send %s: unknown command%s%s%s ('twofold help "
                     "monitor' lists them)",
                     text, hint.before, hint.name, hint.after);
}

static uint8_t *put_number(uint8_t *at, const char *text, bool is_float) {
  if (is_float) {
    const float value = strtof(text, NULL);
    uint32_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    return tf_wire_put(at, bits, 4);
  }
  const double value = strtod(text, NULL);
  uint64_t bits = 0;
  memcpy(&bits, &value, sizeof bits);
  return tf_wire_put(at, bits, 8);
}

static uint8_t *put_payload(uint8_t *at, const cli_board_command_t *command,
                            bool is_float) {
  if (command->type == TF_UP_PARAMETER) {
    *at++ = command->index;
    return put_number(at, command->number[0], is_float);
  }
  if (command->type == TF_UP_RULE) {
    *at++ = command->index;
    return tf_wire_put(at, command->seed, 4);
  }
  for (size_t i = 0; i < command->numbers; i++) {
    at = put_number(at, command->number[i], is_float);
  }
  // The speeds are constant, so the turntable's acceleration is 0.
  return command->numbers > 0 ? put_number(at, "0", is_float) : at;
}

size_t cli_board_commands_next(cli_board_commands_t *commands,
                               const cli_receiver_t *receiver, double now,
                               uint8_t *wire) {
  if (commands->waiting || commands->next == commands->count) {
    return 0;
  }
  const cli_board_command_t *command = &commands->list[commands->next];
  // The schema tells the real type of the board; `describe` asks for it.
  if (!receiver->has_schema && command->type != TF_UP_DESCRIBE) {
    return 0;
  }
  const uint8_t *end =
      put_payload(wire + TF_FRAME_AT, command, receiver->is_float);
  commands->waiting = true;
  commands->deadline = now + PATIENCE;
  return tf_frame_seal(wire, command->type, (size_t)(end - wire) - TF_FRAME_AT,
                       &commands->sequence, 0);
}

static const char *reason_of(int code) {
  switch (code) {
    case TF_ANSWER_UNKNOWN:
      return "the board does not know it";
    case TF_ANSWER_LENGTH:
      return "its length is wrong";
    case TF_ANSWER_EMPTY:
      return "nothing was saved";
    case TF_ANSWER_FAR:
      return "dated too far ahead";
    default:
      return tf_status_name((tf_status_t)code);
  }
}

void cli_board_commands_answer(cli_board_commands_t *commands,
                               const tf_frame_t *frame,
                               const cli_receiver_t *receiver) {
  const uint8_t *at = frame->payload;
  if (!commands->waiting || frame->length < 5 ||
      tf_wire_get(at, 2) != (uint16_t)(commands->sequence - 1u)) {
    return; // it answers another host, or a command that timed out
  }
  const cli_board_command_t *command = &commands->list[commands->next];
  const int code = at[3] < 128 ? at[3] : at[3] - 256;
  char range[3 * CLI_REAL_ROOM + 32] = "";
  const size_t R = receiver->is_float ? 4 : 8;
  if (frame->length == 5 + 3 * R && at[4] < TF_PARAMETERS) {
    char value[CLI_REAL_ROOM], low[CLI_REAL_ROOM], high[CLI_REAL_ROOM];
    (void)cli_write_number(value, cli_receiver_real(receiver, at + 5),
                           receiver->is_float);
    (void)cli_write_number(low, cli_receiver_real(receiver, at + 5 + R),
                           receiver->is_float);
    (void)cli_write_number(high, cli_receiver_real(receiver, at + 5 + 2 * R),
                           receiver->is_float);
    (void)snprintf(range, sizeof range, "; %s = %s, in [%s, %s]",
                   tf_parameter_ranges[at[4]].name, value, low, high);
  }
  (void)cli_message(CLI_DONE, "%s: %s%s at step %" PRIu64 "%s", command->text,
                    code == 0 ? "took effect" : "refused, ",
                    code == 0 ? "" : reason_of(code), frame->tick, range);
  commands->refused += code != 0;
  commands->waiting = false;
  commands->next++;
}
