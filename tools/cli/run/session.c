// Lines of CSV: tick, type and payload of a frame of docs/PROTOCOL.md, and for
// a person the command as typed. The first row is the schema, so the file says
// what it belongs to in the words of the board. That inputs expired is a row,
// too: when they did depends on the board's clock. What was refused did nothing
// and is left out. The last line counts the rows: a file that is cut off would
// be a session of fewer commands.

#include "session.h"

#include <ctype.h>

#include "row.h"

#define HEADER "tick,type,data,command"
#define LINE_ROOM 1024
#define SCHEMA_LEAST 29 // bytes, before its step and names

static size_t last_line(uint64_t rows, uint32_t crc, char out[LINE_ROOM]) {
  return (size_t)snprintf(
      out, LINE_ROOM, "# %" PRIu64 " rows, crc32 %08" PRIx32 "\n", rows, crc);
}

static void put_line(cli_session_file_t *file, const char *line,
                     size_t length) {
  file->crc = cli_crc(file->crc, line, length);
  (void)cli_output_lines(&file->output, line, length);
}

static size_t print_row(const cli_session_row_t *row, const char *text,
                        char line[LINE_ROOM]) {
  int at = snprintf(line, LINE_ROOM, "%" PRIu64 ",%02x,", row->tick,
                    (unsigned)row->type);
  for (size_t i = 0; i < row->length; i++)
    at += snprintf(line + at, 3, "%02x", (unsigned)row->data[i]);
  at += snprintf(line + at, LINE_ROOM - (size_t)at, ",%.64s\n", text);
  return (size_t)at;
}

static void put_row(cli_session_file_t *file, const cli_session_row_t *row,
                    const char *text) {
  char line[LINE_ROOM];
  put_line(file, line, print_row(row, text, line));
  file->rows++;
  file->state.length = 0;
}

int cli_session_open(cli_session_file_t *file, const char *path,
                     cli_begin_t how) {
  static const char head[] =
      "# Record of a board's session, for 'twofold run SCENE "
      "--replay'.\n" HEADER "\n";
  CLI_TRY(cli_output_begin(&file->output, "--record", path, how));
  file->is_open = true;
  put_line(file, head, sizeof head - 1);
  return CLI_DONE;
}

void cli_session_frame(cli_session_file_t *file, const tf_frame_t *frame) {
  const bool begins = file->rows == 0;
  if (!file->is_open) return;
  cli_session_row_t row = {
      .tick = frame->tick, .type = frame->type, .length = frame->length};
  memcpy(row.data, frame->payload, frame->length);
  if (frame->type == (begins ? TF_DOWN_SCHEMA : TF_DOWN_EXPIRED))
    put_row(file, &row, begins ? CLI_RECORD_SCHEMA : "inputs expired");
  else if (frame->type == TF_DOWN_STATE && !begins)
    file->state = row;
}

void cli_session_command(cli_session_file_t *file, const cli_session_row_t *row,
                         const char *text) {
  if (file->is_open) put_row(file, row, text);
}

int cli_session_close(cli_session_file_t *file, int code) {
  char line[LINE_ROOM];
  if (!file->is_open) return code;
  if (file->state.length > 0) put_row(file, &file->state, "state");
  if (code == CLI_DONE)
    put_line(file, line, last_line(file->rows, file->crc, line));
  return cli_output_end(&file->output, code);
}

static int no_record(const cli_lines_t *lines) {
  return cli_usage("%s:%lu: not from 'monitor --record'", lines->name,
                   lines->line);
}

static int cut_off(const cli_lines_t *lines) {
  return cli_refuse("%s: cut off or changed: no last line counts its rows",
                    lines->name);
}

// A line is a row if it is what would be written of it. Returns: the command as
// typed; NULL: it is none.
static const char *read_row(const char *line, cli_session_row_t *row) {
  char again[LINE_ROOM] = "";
  char *at = NULL;
  *row = (cli_session_row_t){.tick = strtoull(line, &at, 10)};
  row->type = *at == ',' ? (uint8_t)strtoul(at + 1, &at, 16) : 0;
  at += *at == ',';
  while (row->length < TF_FRAME_PAYLOAD && isxdigit((unsigned char)at[0]) &&
         isxdigit((unsigned char)at[1])) {
    const char byte[3] = {at[0], at[1], '\0'};
    row->data[row->length++] = (uint8_t)strtoul(byte, NULL, 16);
    at += 2;
  }
  const char *text = *at == ',' ? at + 1 : at;
  again[print_row(row, text, again) - 1] = '\0';
  return row->tick < TF_LINK_TICKS && strcmp(line, again) == 0 ? text : NULL;
}

static int take_row(cli_session_t *session, const cli_lines_t *lines,
                    const char *line, bool begins) {
  cli_session_row_t row;
  const char *text = read_row(line, &row);
  if (text == NULL || (row.type == TF_DOWN_SCHEMA) != begins ||
      (begins && row.length < SCHEMA_LEAST))
    return no_record(lines);
  if (begins) {
    session->schema = row;
    if (strcmp(text, CLI_RECORD_SCHEMA) == 0) return CLI_DONE;
    return cli_refuse("%s: '%s', here it is '" CLI_RECORD_SCHEMA
                      "': record the session again",
                      session->name, text);
  }
  cli_session_row_t *rows =
      cli_grow(session->rows, session->count, &session->room, sizeof *rows);
  if (rows == NULL) return cli_stop("%s: out of memory", session->name);
  session->rows = rows;
  session->rows[session->count++] = row;
  return CLI_DONE;
}

// The last line has to be that of the lines before it, and the last one.
static int read_lines(cli_session_t *session, cli_lines_t lines) {
  char line[LINE_ROOM], last[LINE_ROOM];
  uint64_t rows = 0; // with the schema
  bool has_header = false, is_whole = false;
  while (cli_next_line(&lines, line, sizeof line)) {
    if (strlen(line) != lines.length) return no_record(&lines);
    if (is_whole) return cut_off(&lines);
    last[last_line(rows, session->hash, last) - 1] = '\0';
    is_whole = strcmp(line, last) == 0;
    if (is_whole) continue;
    session->hash = cli_crc(session->hash, line, lines.length);
    session->hash = cli_crc(session->hash, "\n", 1);
    if (line[0] == '#') continue;
    if (has_header)
      CLI_TRY(take_row(session, &lines, line, rows++ == 0));
    else if (strcmp(line, HEADER) != 0)
      return no_record(&lines);
    has_header = true;
  }
  if (rows == 0) return no_record(&lines);
  return is_whole ? CLI_DONE : cut_off(&lines);
}

int cli_session_read(cli_session_t *session, const char *path) {
  cli_lines_t lines = {.name = path};
  char *text = NULL;
  CLI_TRY(cli_read_text("--replay ", path, SIZE_MAX - 1, &text, &lines.size));
  lines.text = text;
  session->name = path;
  const int code = read_lines(session, lines);
  free(text);
  return code;
}
