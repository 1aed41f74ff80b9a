// A record is CSV: tick, type and payload of a frame of docs/PROTOCOL.md, and
// for a person the command as typed. The first row is the schema, so the record
// says what it belongs to in the words of the board, and of which version of
// the protocol it is. Of the states the last one is kept: a replay that ends in
// its bits was the same throughout. What was refused did nothing and is left
// out. The last line counts the rows: a record that is cut off would be a
// session of fewer commands.

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "../run/row.h"
#include "../text/message.h"
#include "board_command.h"

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
    cli_trailer_name(&record->trailer, row, at - 1);
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
  const size_t length = cli_board_command_data(command, is_float, data);
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
