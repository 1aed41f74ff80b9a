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
  command->index = (uint8_t)i;
  command->number[command->numbers++] = rest + length + 1;
  return cli_read_real(command->number[0], &value, &why)
             ? CLI_DONE
             : refuse(command->text, why);
}

static int read_select(cli_board_command_t *command, const char *rest) {
  const size_t length = strcspn(rest, ":");
  uint64_t seed = 0;
  unsigned i = 0;
  while (i < TF_RULES && !is_name(tf_rule_name(i), rest, length)) {
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
  // The speeds are constant, so the turntable's acceleration is 0.
  command->number[command->numbers++] = "0";
  return CLI_DONE;
}

static int read_deadman(cli_board_command_t *command, const char *rest) {
  uint64_t steps = 0;
  if (!cli_read_whole(rest, 0, UINT32_MAX, &steps)) {
    return refuse(command->text, "expected deadman:TICKS; 0: without end");
  }
  command->seed = (uint32_t)steps;
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
             {"deadman:", TF_UP_DEADMAN, read_deadman}};

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
    if (forms[i].read != NULL && strncmp(text, forms[i].name, length) == 0) {
      return forms[i].read(command, text + length);
    }
    if (forms[i].read == NULL && strcmp(text, forms[i].name) == 0) {
      return CLI_DONE;
    }
    if (forms[i].read == NULL) {
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
  const int code = cli_board_commands_add(&one, given->value);
  if (code == CLI_DONE) {
    args->send[args->sends++] = given->value;
  }
  return code;
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

static uint8_t *put_data(uint8_t *at, const cli_board_command_t *command,
                         bool is_float) {
  if (command->type == TF_UP_PARAMETER || command->type == TF_UP_RULE) {
    *at++ = command->index;
  }
  for (size_t i = 0; i < command->numbers; i++) {
    at = put_number(at, command->number[i], is_float);
  }
  return command->type == TF_UP_RULE || command->type == TF_UP_DEADMAN
             ? tf_wire_put(at, command->seed, 4)
             : at;
}

// Whether the board has described itself since it was asked to. That tells the
// real type, the session and the numbers that are still free.
static bool is_described(const cli_board_commands_t *commands,
                         const cli_receiver_t *receiver) {
  return receiver->schemas > commands->schemas && receiver->session != 0;
}

// After the last number the board has another session, so that number would be
// new again there: it is used up by a command that is refused for its length,
// and those to come wait for the new session.
static size_t renew_session(cli_board_commands_t *commands, double now,
                            uint8_t *wire) {
  uint32_t last = UINT32_MAX;
  if (commands->renews) {
    return 0;
  }
  commands->renews = true;
  commands->deadline = now + PATIENCE;
  wire[TF_COMMAND_AT] = 0;
  return tf_command_seal(wire, TF_UP_STOP, 1, commands->session, &last, 0,
                         commands->has_key ? commands->key : NULL);
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
  if (asks) {
    commands->schemas = receiver->schemas;
  } else if (receiver->session != commands->session ||
             receiver->sequence > commands->sequence) {
    commands->session = receiver->session;
    commands->sequence = receiver->sequence;
    commands->renews = false;
  }
  if (!asks && commands->sequence == UINT32_MAX) {
    return renew_session(commands, now, wire);
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
  return (commands->waiting || commands->renews ||
          (has_more && !is_described(commands, receiver))) &&
         now > commands->deadline;
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
    case TF_ANSWER_OLD:
      return "its number is used up: another host commands this board";
    case TF_ANSWER_FOREIGN:
      return "the board was started anew";
    case TF_ANSWER_TAG:
      return "its tag is not that of the board's key (--key)";
    default:
      return tf_status_name((tf_status_t)code);
  }
}

// Value and range of a parameter, as an answer has them.
static void write_range(char *out, size_t room, const tf_frame_t *frame,
                        const cli_receiver_t *receiver) {
  const uint8_t *at = frame->payload + ANSWER_BYTES;
  const size_t R = receiver->is_float ? 4 : 8;
  const uint8_t index = frame->payload[7];
  out[0] = '\0';
  if (frame->length != ANSWER_BYTES + 3 * R || index >= TF_PARAMETERS) {
    return;
  }
  char value[CLI_REAL_ROOM], low[CLI_REAL_ROOM], high[CLI_REAL_ROOM];
  (void)cli_write_number(value, cli_receiver_real(receiver, at),
                         receiver->is_float);
  (void)cli_write_number(low, cli_receiver_real(receiver, at + R),
                         receiver->is_float);
  (void)cli_write_number(high, cli_receiver_real(receiver, at + 2 * R),
                         receiver->is_float);
  (void)snprintf(out, room, "; %s = %s, in [%s, %s]",
                 tf_parameter_ranges[index].name, value, low, high);
}

const cli_board_command_t *cli_board_commands_answer(
    cli_board_commands_t *commands, const tf_frame_t *frame,
    const cli_receiver_t *receiver) {
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
                    code == 0 ? "" : reason_of(code), frame->tick, range,
                    at[6] == TF_INPUT_SAFE ? "; inputs had expired" : "");
  commands->refused += code != 0;
  commands->waiting = false;
  commands->next++;
  return code == 0 ? command : NULL;
}

// A record is CSV: tick, type and payload of a frame of docs/PROTOCOL.md, and
// for a person the command as typed. The first row is the schema, so the
// record says what it belongs to in the words of the board. That inputs expired
// is a row too: when they did depends on the board's clock. Of the states
// the last one is kept: a replay that ends in its bits was the same throughout.
// What was refused did nothing and is left out. The last line counts the rows:
// a record that is cut off would be a session of fewer commands.

#define ROW_ROOM (2 * TF_FRAME_PAYLOAD + 128)

static void put(cli_session_record_t *record, const char *lines, size_t length,
                uint64_t rows) {
  cli_trailer_add(&record->trailer, lines, length, rows);
  (void)cli_output_lines(&record->output, lines, length);
}

static void put_row(cli_session_record_t *record, uint64_t tick, uint8_t type,
                    const uint8_t *data, size_t length, const char *text) {
  char row[ROW_ROOM];
  size_t at = (size_t)snprintf(row, sizeof row, "%" PRIu64 ",%02x,", tick,
                               (unsigned)type);
  for (size_t i = 0; i < length; i++) {
    at +=
        (size_t)snprintf(row + at, sizeof row - at, "%02x", (unsigned)data[i]);
  }
  at += (size_t)snprintf(row + at, sizeof row - at, ",%.64s\n", text);
  if (type == TF_DOWN_SCHEMA) {
    record->trailer.run = cli_crc(0, row, at - 1);
  }
  put(record, row, at, 1);
}

int cli_session_record_open(cli_session_record_t *record, const char *path) {
  static const char title[] =
      "# Record of a board's session, for 'twofold run SCENE --replay'.\n";
  static const char header[] = "tick,type,data,command\n";
  const int code = cli_output_begin(&record->output, "--record", path, false);
  record->is_open = code == CLI_DONE;
  if (record->is_open) {
    (void)cli_output_lines(&record->output, title, sizeof title - 1);
    put(record, header, sizeof header - 1, 0);
  }
  return code;
}

void cli_session_record_frame(cli_session_record_t *record,
                              const tf_frame_t *frame) {
  if (!record->is_open) {
    return;
  }
  if (frame->type == TF_DOWN_SCHEMA && !record->has_schema) {
    put_row(record, frame->tick, frame->type, frame->payload, frame->length,
            CLI_RECORD_SCHEMA);
    record->has_schema = true;
  }
  if (frame->type == TF_DOWN_EXPIRED && record->has_schema) {
    record->has_state = false;
    put_row(record, frame->tick, frame->type, frame->payload, frame->length,
            "inputs expired");
  }
  if (frame->type != TF_DOWN_STATE || !record->has_schema) {
    return;
  }
  memcpy(record->state, frame->payload, frame->length);
  record->tick = frame->tick;
  record->length = frame->length;
  record->has_state = true;
}

void cli_session_record_command(cli_session_record_t *record,
                                const cli_board_command_t *command,
                                bool is_float, uint64_t tick) {
  uint8_t data[TF_FRAME_PAYLOAD];
  if (!record->is_open || command->type == TF_UP_DESCRIBE) {
    return;
  }
  record->has_state = false;
  const size_t length = (size_t)(put_data(data, command, is_float) - data);
  put_row(record, tick, command->type, data, length, command->text);
}

int cli_session_record_close(cli_session_record_t *record, int code) {
  if (!record->is_open) {
    return code;
  }
  if (record->has_state) {
    put_row(record, record->tick, TF_DOWN_STATE, record->state, record->length,
            "state");
  }
  if (code == CLI_DONE) {
    char line[CLI_TRAILER_ROOM];
    (void)cli_output_lines(
        &record->output, line,
        cli_trailer_line(&record->trailer, &cli_whole_shard, line));
  }
  return cli_output_end(&record->output, code);
}
