// Commands to a board. Names and numbers are checked before anything is opened;
// ranges are checked by the board, which knows its parameters. The real type of
// the board is not known yet, so a number is converted to both: it is rounded
// once, from its decimals.

#include "board_command.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PATIENCE 3.0    // for an answer [s]
#define SILENCE 5.0     // of heartbeats, which come each second [s]
#define LOOK 0.2        // more between two looks is a pause of this program [s]
#define ANSWER_BYTES 8u // of every answer; one about a parameter has more

static void add(cli_session_row_t *row, uint64_t value, size_t bytes) {
  (void)tf_wire_put(row->data + row->length, value, bytes);
  row->length = (uint8_t)(row->length + bytes);
}

static void add_whole(cli_board_command_t *command, uint64_t value,
                      size_t bytes) {
  add(&command->row[false], value, bytes);
  add(&command->row[true], value, bytes);
}

static bool add_number(cli_board_command_t *command, const char *text,
                       const char **why) {
  const float narrow = strtof(text, NULL);
  const double wide = strtod(text, NULL);
  uint32_t four = 0;
  uint64_t eight = 0;
  tf_real_t value = 0;
  memcpy(&four, &narrow, sizeof four);
  memcpy(&eight, &wide, sizeof eight);
  add(&command->row[false], eight, sizeof eight);
  add(&command->row[true], four, sizeof four);
  return cli_read_real(text, &value, why);
}

// Each of these reads what stands behind the name of a command.
// Returns: what is wrong with it, or NULL.

static const char *read_set(cli_board_command_t *command, const char *rest) {
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(rest, "=");
  const char *why = "";
  (void)snprintf(name, sizeof name, "%.*s", (int)length, rest);
  const size_t i = cli_number_index(name);
  if (i >= TF_PARAMETERS || rest[length] != '=') {
    return "expected set:NAME=VALUE with the name of a parameter ('twofold "
           "help run')";
  }
  add_whole(command, i, 1);
  return add_number(command, rest + length + 1, &why) ? NULL : why;
}

static const char *read_select(cli_board_command_t *command, const char *rest) {
  char name[CLI_NAME_ROOM];
  const size_t length = strcspn(rest, ":");
  uint64_t seed = 0;
  unsigned i = 0;
  (void)snprintf(name, sizeof name, "%.*s", (int)length, rest);
  while (i < TF_RULES && strcmp(tf_rule_name(i), name) != 0) i++;
  const bool seed_is_good =
      rest[length] == '\0' ||
      cli_read_whole(rest + length + 1, 0, UINT32_MAX, &seed);
  add_whole(command, i, 1);
  add_whole(command, seed, 4);
  return i < TF_RULES && seed_is_good
             ? NULL
             : "expected select:RULE[:SEED] with one of persist, slip+, slip-, "
               "random";
}

static const char *read_input(cli_board_command_t *command, const char *rest) {
  for (int i = 0; i < 4; i++) {
    char number[CLI_REAL_ROOM];
    const size_t length = strcspn(rest, ",");
    const char *why = "";
    (void)snprintf(number, sizeof number, "%.*s", (int)length, rest);
    if (length >= sizeof number || !add_number(command, number, &why) ||
        (rest[length] == ',') == (i == 3))
      return "expected input:OMEGA0,R0,FORCE,TORQUE in numbers";
    rest += length + 1;
  }
  // The speeds are constant, so the turntable's acceleration is 0.
  const char *why = "";
  (void)add_number(command, "0", &why);
  return NULL;
}

static const char *read_count(cli_board_command_t *command, const char *rest) {
  const bool every = command->row->type == TF_UP_EVERY;
  uint64_t count = 0;
  const bool good = cli_read_whole(rest, every, UINT32_MAX, &count);
  add_whole(command, count, 4);
  return good    ? NULL
         : every ? "expected every:STEPS, of one or more"
                 : "expected deadman:TICKS; 0: without end";
}

// A command with data has a reader of what stands behind its name.
static const struct {
  const char *name;
  uint8_t type;
  const char *(*read)(cli_board_command_t *command, const char *rest);
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

static int refuse(const char *text, const char *why) {
  return cli_message(CLI_USAGE, "--send %s: %s", text, why);
}

static int read_command(cli_board_command_t *command, const char *text) {
  cli_closest_t closest = cli_closest_to(text);
  for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
    const size_t length = strlen(forms[i].name);
    const bool has_data = forms[i].read != NULL;
    *command = (cli_board_command_t){
        text, {{.type = forms[i].type}, {.type = forms[i].type}}};
    if (strncmp(text, forms[i].name, length) == 0 &&
        (has_data || text[length] == '\0')) {
      const char *why = has_data ? forms[i].read(command, text + length) : NULL;
      return why == NULL ? CLI_DONE : refuse(text, why);
    }
    if (!has_data) cli_closest_offer(&closest, forms[i].name);
  }
  return cli_message(CLI_USAGE,
                     "--send %s: unknown command%s ('twofold help monitor' "
                     "lists them)",
                     text, closest.hint);
}

int cli_read_send(cli_args_t *args, const cli_given_t *given) {
  cli_board_command_t command;
  if (args->sends == CLI_SENDS)
    return refuse(given->value, "too many commands for one line");
  args->send[args->sends++] = given->value;
  return read_command(&command, given->value);
}

int cli_board_commands_open(cli_board_commands_t *commands,
                            const cli_args_t *args) {
  // The schema has to be known before any command, and that the board has the
  // key before anything.
  if (args->sends > 0 || args->key != NULL)
    (void)read_command(&commands->list[commands->count++], "describe");
  for (size_t i = 0; i < args->sends; i++)
    (void)read_command(&commands->list[commands->count++], args->send[i]);
  if (args->key == NULL) return CLI_DONE;
  const char *wrong = cli_read_key(args->key, commands->key);
  commands->guard.key = commands->key;
  return wrong == NULL
             ? cli_board_commands_again(commands)
             : cli_message(CLI_USAGE, "--key %s: %s", args->key, wrong);
}

int cli_board_commands_again(cli_board_commands_t *commands) {
  cli_board_command_t *first = &commands->list[0];
  if (commands->guard.key == NULL) return CLI_DONE;
  if (!cli_guard_begin(&commands->guard, commands->key))
    return cli_message(CLI_STOPPED, "--key: the system has no random numbers");
  for (int real = 0; real < 2; real++) {
    memcpy(first->row[real].data, commands->guard.nonce, TF_NONCE_BYTES);
    first->row[real].length = TF_NONCE_BYTES;
  }
  if (commands->next < commands->count) return CLI_DONE;
  commands->next = 0;
  commands->count = commands->count > 0;
  return CLI_DONE;
}

int cli_board_commands_send(cli_board_commands_t *commands,
                            const cli_receiver_t *receiver,
                            cli_source_t *source) {
  uint8_t wire[TF_FRAME_SIZE(TF_FRAME_PAYLOAD)];
  const double now = cli_now();
  if (commands->guard.vouched)
    commands->guard.silent += fmin(now - commands->looked, LOOK);
  commands->looked = now;
  if (commands->guard.forged)
    return cli_message(CLI_STOPPED, "%s: " CLI_FORGED, source->name);
  if (commands->guard.silent > SILENCE)
    return cli_message(CLI_STOPPED, "%s: " CLI_SILENT, source->name);
  if (commands->next == commands->count) return CLI_DONE;
  const cli_board_command_t *command = &commands->list[commands->next];
  const cli_session_row_t *row = &command->row[receiver->is_float];
  const bool asks = row->type == TF_UP_DESCRIBE;
  // A schema from before `describe` may have waited on the line, and name old
  // numbers. It has the real type, the session and the numbers still free.
  const bool described =
      receiver->schemas > commands->schemas && receiver->session != 0;
  if (commands->waiting || !(asks || described)) {
    if (now > commands->deadline && commands->guard.key != NULL &&
        !commands->guard.vouched)
      return cli_message(CLI_STOPPED, "%s: " CLI_NOT_VOUCHED, source->name);
    return now <= commands->deadline
               ? CLI_DONE
               : cli_message(CLI_STOPPED,
                             "--send %s: no answer; does the board take "
                             "commands?",
                             command->text);
  }
  if (!asks && (receiver->session != commands->session ||
                receiver->sequence > commands->sequence)) {
    commands->session = receiver->session;
    commands->sequence = receiver->sequence;
  }
  commands->waiting = true;
  commands->deadline = now + PATIENCE;
  commands->sent = commands->sequence;
  uint32_t next = commands->sequence;
  memcpy(wire + TF_COMMAND_AT, row->data, row->length);
  const size_t length =
      tf_command_seal(wire, row->type, row->length, commands->session, &next, 0,
                      commands->guard.key);
  if (!asks) commands->sequence = next;
  return cli_source_write(source, wire, length)
             ? CLI_DONE
             : cli_message(CLI_STOPPED, "%s: %s", source->name,
                           strerror(source->error));
}

static const char *reason_of(int code, uint32_t number) {
  static const char *const reasons[] = {
      [-TF_ANSWER_UNKNOWN] = "unknown to the board",
      [-TF_ANSWER_LENGTH] = "of a wrong length",
      [-TF_ANSWER_EMPTY] = "nothing was saved",
      [-TF_ANSWER_FAR] = "dated too far ahead",
      [-TF_ANSWER_OLD] =
          "its number is used up: another host commands this board",
      [-TF_ANSWER_FOREIGN] = "the board restarted",
      [-TF_ANSWER_TAG] = "its tag is not that of the board's key (--key)",
      [-TF_ANSWER_LINE] = "more than the line carries"};
  if (code == TF_ANSWER_OLD && number == UINT32_MAX)
    return "all numbers of the session are used up: restart the board";
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
                   "; it needs %" PRIu32 " of %" PRIu32
                   " bytes/s, a record every %" PRIu32 " steps",
                   (uint32_t)tf_wire_get(at + 4, 4),
                   (uint32_t)tf_wire_get(at + 8, 4),
                   (uint32_t)tf_wire_get(at, 4));
    return;
  }
  if (frame->length != ANSWER_BYTES + 3 * R || index >= TF_PARAMETERS) return;
  char number[3][CLI_REAL_ROOM]; // in effect, smallest, largest
  for (size_t i = 0; i < 3; i++) {
    (void)decimal_write(number[i], cli_receiver_real(receiver, at + i * R),
                        receiver->is_float);
  }
  (void)snprintf(out, room, "; %s = %s, in [%s, %s]",
                 tf_parameter_ranges[index].name, number[0], number[1],
                 number[2]);
}

void cli_board_commands_answer(cli_board_commands_t *commands,
                               const tf_frame_t *frame,
                               const cli_receiver_t *receiver,
                               cli_session_file_t *record) {
  const uint8_t *at = frame->payload;
  const cli_board_command_t *command = &commands->list[commands->next];
  cli_session_row_t row = command->row[receiver->is_float];
  if (!commands->waiting || frame->type != TF_DOWN_ANSWER ||
      frame->length < ANSWER_BYTES || tf_wire_get(at, 4) != commands->sent ||
      at[4] != row.type)
    return; // it answers another command, or another host
  const int code = at[5] < 128 ? at[5] : at[5] - 256;
  char range[3 * CLI_REAL_ROOM + 32];
  write_range(range, sizeof range, frame, receiver);
  (void)cli_message(CLI_DONE, "%s: %s%s at step %" PRIu64 "%s%s", command->text,
                    code == 0 ? "took effect" : "refused, ",
                    code == 0 ? "" : reason_of(code, commands->sent),
                    frame->tick, range,
                    at[6] == TF_INPUT_SAFE ? "; inputs had expired" : "");
  commands->refused += code != 0;
  commands->waiting = false;
  commands->next++;
  if (row.type == TF_UP_DESCRIBE) {
    commands->schemas = receiver->schemas;
  } else if (code == 0) {
    row.tick = frame->tick;
    cli_session_command(record, &row, command->text);
  }
}
