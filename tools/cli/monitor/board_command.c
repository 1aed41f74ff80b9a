// Commands to a board. Names and numbers are checked before anything is opened;
// ranges are checked by the board, which knows its parameters. A number is
// converted to the real type of the board when it is sent: it is rounded once,
// from its decimals.

#include "board_command.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../run/row.h"
#include "../setup/setup.h"
#include "../text/message.h"
#include "../text/number.h"

#define PATIENCE 3.0    // for an answer [s]
#define ANSWER_BYTES 8u // of every answer; one about a parameter has more

static int refuse(const char *text, const char *why) {
  return cli_message(CLI_USAGE, "--send %s: %s", text, why);
}

static int read_set(cli_board_command_t *command, const char *rest) {
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(rest, "=");
  const char *why = "";
  tf_real_t value = 0;
  (void)snprintf(name, sizeof name, "%.*s", (int)length, rest);
  const size_t i = cli_parameter_index(name);
  if (i == TF_PARAMETERS || rest[length] != '=') {
    return refuse(command->text,
                  "expected set:NAME=VALUE with the name of a "
                  "parameter ('twofold help run')");
  }
  command->index = (uint8_t)i;
  command->number[command->numbers++] = rest + length + 1;
  return cli_read_real(command->number[0], &value, &why)
             ? CLI_DONE
             : refuse(command->text, why);
}

static int read_select(cli_board_command_t *command, const char *rest) {
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(rest, ":");
  uint64_t seed = 0;
  unsigned i = 0;
  (void)snprintf(name, sizeof name, "%.*s", (int)length, rest);
  while (i < TF_RULES && strcmp(tf_rule_name(i), name) != 0) {
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
  command->index = (uint8_t)i;
  command->seed = (uint32_t)seed;
  return CLI_DONE;
}

// Four numbers separated by commas; cli_read_real takes one at a time.
static int read_input(cli_board_command_t *command, const char *rest) {
  for (command->numbers = 0; command->numbers < 4; command->numbers++) {
    char number[CLI_REAL_ROOM];
    const size_t length = strcspn(rest, ",");
    const char *why = "";
    tf_real_t value = 0;
    (void)snprintf(number, sizeof number, "%.*s", (int)length, rest);
    command->number[command->numbers] = rest;
    const bool last = command->numbers == 3;
    if (length >= sizeof number || !cli_read_real(number, &value, &why) ||
        (rest[length] == ',') == last) {
      return refuse(command->text,
                    "expected input:OMEGA0,R0,FORCE,TORQUE in numbers");
    }
    rest += length + 1;
  }
  // The speeds are constant, so the turntable's acceleration is 0.
  command->number[command->numbers++] = "0";
  return CLI_DONE;
}

static int read_count(cli_board_command_t *command, const char *rest) {
  const bool every = command->type == TF_UP_EVERY;
  uint64_t count = 0;
  if (!cli_read_whole(rest, every, UINT32_MAX, &count)) {
    return refuse(command->text,
                  every ? "expected every:STEPS, of one or more"
                        : "expected deadman:TICKS; 0: without end");
  }
  command->seed = (uint32_t)count;
  return CLI_DONE;
}

// A command with data has a reader of what stands behind its name.
static const struct {
  const char *name;
  uint8_t type;
  int (*read)(cli_board_command_t *command, const char *rest);
} forms[] = {{"describe", TF_UP_DESCRIBE, NULL},
             {"start", TF_UP_START, NULL},
             {"stop", TF_UP_STOP, NULL},
             {"reset", TF_UP_RESET, NULL},
             {"snapshot", TF_UP_SNAPSHOT, NULL},
             {"restore", TF_UP_RESTORE, NULL},
             {"clear", TF_UP_CLEAR, NULL},
             {"input", TF_UP_INPUT, NULL},
             {"set:", TF_UP_PARAMETER, read_set},
             {"select:", TF_UP_RULE, read_select},
             {"input:", TF_UP_INPUT, read_input},
             {"deadman:", TF_UP_DEADMAN, read_count},
             {"every:", TF_UP_EVERY, read_count}};

int cli_board_commands_add(cli_board_commands_t *commands, const char *text) {
  if (commands->count == CLI_BOARD_COMMANDS) {
    return refuse(text, "too many commands for one line");
  }
  cli_board_command_t *command = &commands->list[commands->count];
  commands->count++;
  *command = (cli_board_command_t){.text = text};
  cli_closest_t closest = cli_closest_to(text);
  for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
    const size_t length = strlen(forms[i].name);
    command->type = forms[i].type;
    const bool has_data = forms[i].read != NULL;
    if (strncmp(text, forms[i].name, length) == 0 &&
        (has_data || text[length] == '\0')) {
      return has_data ? forms[i].read(command, text + length) : CLI_DONE;
    }
    if (!has_data) {
      cli_closest_offer(&closest, forms[i].name);
    }
  }
  return cli_message(CLI_USAGE,
                     "--send %s: unknown command%s ('twofold help monitor' "
                     "lists them)",
                     text, closest.hint);
}

int cli_read_send(void *to, const cli_given_t *given) {
  cli_args_t *args = to;
  cli_board_commands_t one = {.count = args->sends + 1}; // with `describe`
  CLI_TRY(cli_board_commands_add(&one, given->value));
  args->send[args->sends++] = given->value;
  return CLI_DONE;
}

static uint8_t *put_number(uint8_t *at, const char *text, bool is_float) {
  const float narrow = strtof(text, NULL);
  const double wide = strtod(text, NULL);
  uint32_t four = 0;
  uint64_t eight = 0;
  memcpy(&four, &narrow, sizeof four);
  memcpy(&eight, &wide, sizeof eight);
  return is_float ? tf_wire_put(at, four, 4) : tf_wire_put(at, eight, 8);
}

static uint8_t *put_data(uint8_t *at, const cli_board_command_t *command,
                         bool is_float) {
  if (command->type == TF_UP_PARAMETER || command->type == TF_UP_RULE) {
    *at++ = command->index;
  }
  for (size_t i = 0; i < command->numbers; i++) {
    at = put_number(at, command->number[i], is_float);
  }
  return command->type == TF_UP_RULE || command->type == TF_UP_DEADMAN ||
                 command->type == TF_UP_EVERY
             ? tf_wire_put(at, command->seed, 4)
             : at;
}

// Whether the board has described itself since it answered `describe`: a schema
// of before may have waited on the line, and name old numbers. It has the real
// type, the session and the numbers that are still free.
static bool is_described(const cli_board_commands_t *commands,
                         const cli_receiver_t *receiver) {
  return receiver->schemas > commands->schemas && receiver->session != 0;
}

size_t cli_board_commands_next(cli_board_commands_t *commands,
                               const cli_receiver_t *receiver, double now,
                               uint8_t *wire) {
  if (commands->waiting || commands->next == commands->count) {
    return 0;
  }
  const cli_board_command_t *command = &commands->list[commands->next];
  const bool asks = command->type == TF_UP_DESCRIBE;
  if (!asks && !is_described(commands, receiver)) {
    return 0;
  }
  if (!asks && (receiver->session != commands->session ||
                receiver->sequence > commands->sequence)) {
    commands->session = receiver->session;
    commands->sequence = receiver->sequence;
  }
  const uint8_t *end =
      put_data(wire + TF_COMMAND_AT, command, receiver->is_float);
  commands->waiting = true;
  commands->deadline = now + PATIENCE;
  commands->sent = commands->sequence;
  uint32_t next = commands->sequence;
  const size_t length = tf_command_seal(
      wire, command->type, (size_t)(end - wire) - TF_COMMAND_AT,
      commands->session, &next, 0, commands->has_key ? commands->key : NULL);
  if (!asks) {
    commands->sequence = next;
  }
  return length;
}

bool cli_board_commands_late(const cli_board_commands_t *commands,
                             const cli_receiver_t *receiver, double now) {
  const bool has_more = commands->next > 0 && commands->next < commands->count;
  return (commands->waiting ||
          (has_more && !is_described(commands, receiver))) &&
         now > commands->deadline;
}

static const char *reason_of(int code, uint32_t number) {
  static const char *const reasons[] = {
      [-TF_ANSWER_UNKNOWN] = "the board does not know it",
      [-TF_ANSWER_LENGTH] = "its length is wrong",
      [-TF_ANSWER_EMPTY] = "nothing was saved",
      [-TF_ANSWER_FAR] = "dated too far ahead",
      [-TF_ANSWER_OLD] =
          "its number is used up: another host commands this board",
      [-TF_ANSWER_FOREIGN] = "the board was started anew",
      [-TF_ANSWER_TAG] = "its tag is not that of the board's key (--key)",
      [-TF_ANSWER_LINE] = "more than the line carries"};
  if (code == TF_ANSWER_OLD && number == UINT32_MAX) {
    return "all numbers of the session are used up: restart the board";
  }
  return code <= TF_ANSWER_UNKNOWN && code >= TF_ANSWER_LINE
             ? reasons[-code]
             : tf_status_name((tf_status_t)code);
}

// As an answer has them: a parameter, or what records ask of the line.
static void write_range(char *out, size_t room, const tf_frame_t *frame,
                        const cli_receiver_t *receiver) {
  const uint8_t *at = frame->payload + ANSWER_BYTES;
  const size_t R = receiver->is_float ? 4 : 8;
  const uint8_t index = frame->payload[7];
  out[0] = '\0';
  if (frame->payload[4] == TF_UP_EVERY && frame->length == ANSWER_BYTES + 12) {
    (void)snprintf(out, room,
                   "; it asks %" PRIu32 " bytes/s of %" PRIu32
                   ", a record every %" PRIu32 " steps",
                   (uint32_t)tf_wire_get(at + 4, 4),
                   (uint32_t)tf_wire_get(at + 8, 4),
                   (uint32_t)tf_wire_get(at, 4));
    return;
  }
  if (frame->length != ANSWER_BYTES + 3 * R || index >= TF_PARAMETERS) {
    return;
  }
  char number[3][CLI_REAL_ROOM]; // in effect, smallest, largest
  for (size_t i = 0; i < 3; i++) {
    (void)cli_write_number(number[i], cli_receiver_real(receiver, at + i * R),
                           receiver->is_float);
  }
  (void)snprintf(out, room, "; %s = %s, in [%s, %s]",
                 tf_parameter_ranges[index].name, number[0], number[1],
                 number[2]);
}

const char *cli_board_commands_answer(cli_board_commands_t *commands,
                                      const tf_frame_t *frame,
                                      const cli_receiver_t *receiver,
                                      cli_session_row_t *row) {
  const uint8_t *at = frame->payload;
  const cli_board_command_t *command = &commands->list[commands->next];
  if (!commands->waiting || frame->length < ANSWER_BYTES ||
      tf_wire_get(at, 4) != commands->sent || at[4] != command->type) {
    return NULL; // it answers another command, or another host
  }
  const int code = at[5] < 128 ? at[5] : at[5] - 256;
  char range[3 * CLI_REAL_ROOM + 32];
  write_range(range, sizeof range, frame, receiver);
  (void)cli_message(CLI_DONE, "%s: %s%s at step %" PRIu64 "%s%s", command->text,
                    code == 0 ? "took effect" : "refused, ",
                    code == 0 ? "" : reason_of(code, commands->sent),
                    frame->tick, range,
                    at[6] == TF_INPUT_SAFE ? "; inputs had expired" : "");
  if (command->type == TF_UP_DESCRIBE) {
    commands->schemas = receiver->schemas;
  }
  commands->refused += code != 0;
  commands->waiting = false;
  commands->next++;
  if (code != 0 || command->type == TF_UP_DESCRIBE) {
    return NULL;
  }
  *row = (cli_session_row_t){.tick = frame->tick, .type = command->type};
  row->length =
      (uint8_t)(put_data(row->data, command, receiver->is_float) - row->data);
  return command->text;
}
